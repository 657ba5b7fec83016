#pragma once
/// Edges that are taken as points and slivers that are taken as edges. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// What is left out of the mesh because it is too small. Indices are CAD numbers minus 1.
struct TinyFeatures {
  std::vector<int> vertices;          ///< (vertices) the vertex whose node this one shares; itself as a rule
  std::vector<char> collapsed_edges;  ///< (edges) 1 = both ends share a node, the edge has no segments
  std::vector<int> edges;             ///< (edges) the edge whose nodes this one shares; itself as a rule
  std::vector<char> reversed_edges;   ///< (edges) 1 = it runs against that one
  std::vector<char> merged_faces;     ///< (faces) 1 = nothing is left of the face

  bool closed(const CadEdge& edge) const { return end(edge.first_vertex) == end(edge.last_vertex); }
  /// The vertex (from 1) whose node a vertex (from 1) shares; 0 = none.
  int end(int vertex) const { return vertex > 0 ? vertices[vertex - 1] + 1 : 0; }
};

/// Which faces become edges beside those below the length given.
struct SliverLimits {
  double reach = 0;                         ///< their two edges lie within this of each other
  const std::vector<char>* kept = nullptr;  ///< (faces) 1 = not this one; null = any
};

/// Whether an edge's curve stays nearer than `reach` to another's, at samples between its ends.
bool lies_along(const CadEdge& edge, const CadEdge& other, double reach);

/// Edges marked for it, and edges shorter than `length`, become points; faces between two edges that are then
/// left with the same ends, less than `length` apart, become edges, and faces without edges vanish. \param
/// used (faces) 1 = the face is meshed. \param collapse (edges) 1 = marked \param length model units; 0 =
/// none. \param slivers further faces that may become edges.
TinyFeatures find_tiny_features(const CadShape& shape, const std::vector<char>& used,
                                const std::vector<char>& collapse, double length,
                                const SliverLimits& slivers = {});

}  // namespace quadrille
