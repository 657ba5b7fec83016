#pragma once
/// The sides of shell elements that lie on CAD edges. Internal.

#include <vector>

#include "mesher/io/output_mesh.hpp"

namespace quadrille {

/// Side k of an element runs from its corner k to corner k + 1.
struct SegmentSide {
  int segment = 0;
  int shell = 0;
  int side = 0;         ///< from 0
  bool forward = true;  ///< the element runs it in the segment's direction
};

/// The sides of all elements that are segments of the mesh, ascending by segment, then by element. Inner
/// edges have two or more elements a segment. O(n + s log s) for n elements and s segments.
std::vector<SegmentSide> segment_sides(const OutputMesh& mesh);

/// Which CAD entities bound which, with the sign of their direction, each once in a direction.
struct EntityBoundaries {
  std::vector<std::vector<int>> faces;  ///< by index in OutputMesh::faces(): edges, -7 = Edge7 run backwards
  std::vector<std::vector<int>> edges;  ///< by index in OutputMesh::edges(): first vertex, minus the last
};

/// Entities without a number bound none, and have none that bound them. O(n + s log s) as above.
EntityBoundaries entity_boundaries(const OutputMesh& mesh);

}  // namespace quadrille
