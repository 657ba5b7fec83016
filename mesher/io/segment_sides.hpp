#pragma once
/// The sides of shell elements that lie on CAD edges. Internal.

#include <vector>

#include "mesher/io/output_mesh.hpp"

namespace quadrille {

/// A side of an element on a segment. Side k runs from corner k of the element to corner k + 1.
struct SegmentSide {
  int segment = 0;
  int shell = 0;
  int side = 0;         ///< from 0
  bool forward = true;  ///< whether the side runs in the segment's direction
};

/// The element sides that lie on segments of the mesh, ascending by segment, then by element. Inner edges
/// have two or more elements per segment. O(n + s log s) for n elements and s segments.
std::vector<SegmentSide> segment_sides(const OutputMesh& mesh);

/// The CAD entities that bound faces and edges, signed by direction; each appears once per direction.
struct EntityBoundaries {
  std::vector<std::vector<int>> faces;  ///< by index in OutputMesh::entities(2): edges; -7 = Edge7 reversed
  std::vector<std::vector<int>> edges;  ///< by index in entities(1): first vertex, minus last vertex
};

/// Entities without a number bound nothing and have no boundaries. O(n + s log s) as above.
EntityBoundaries entity_boundaries(const OutputMesh& mesh);

}  // namespace quadrille
