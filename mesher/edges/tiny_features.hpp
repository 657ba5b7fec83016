#pragma once
/// Edges treated as points and slivers treated as edges. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// What is left out of the mesh because it is too small. Indices are CAD numbers minus 1.
struct TinyFeatures {
  std::vector<int> vertices;          ///< (vertices) the vertex whose node this one shares; usually itself
  std::vector<char> collapsed_edges;  ///< (edges) 1 = both ends share a node, the edge has no segments
  std::vector<int> edges;             ///< (edges) the edge whose nodes this one shares; usually itself
  std::vector<char> reversed_edges;   ///< (edges) 1 = it runs in the opposite direction to that edge
  std::vector<char> merged_faces;     ///< (faces) 1 = the face vanishes

  /// Whether both ends of an edge share a node.
  bool closed(const CadEdge& edge) const { return end(edge.first_vertex) == end(edge.last_vertex); }
  /// The vertex (from 1) whose node a vertex (from 1) shares; 0 for vertex 0.
  int end(int vertex) const { return vertex > 0 ? vertices[vertex - 1] + 1 : 0; }
};

/// Which faces become edges besides those narrower than the given length.
struct SliverLimits {
  double reach = 0;                         ///< largest distance between the face's two edges
  const std::vector<char>* kept = nullptr;  ///< (faces) 1 = must not become an edge; null = any may
};

/// Whether an edge's curve stays within `reach` of another one's, at samples between its ends.
bool lies_along(const CadEdge& edge, const CadEdge& other, double reach);

/// Marked edges and edges shorter than `length` become points. Then a face left with two edges that have the
/// same ends and are less than `length` apart becomes an edge, and a face left with no edges vanishes.
/// \param used (faces) 1 = the face is meshed. \param collapse (edges) 1 = marked \param length model units;
/// 0 = marked edges only. \param slivers further faces that may become edges.
TinyFeatures find_tiny_features(const CadShape& shape, const std::vector<char>& used,
                                const std::vector<char>& collapse, double length,
                                const SliverLimits& slivers = {});

}  // namespace quadrille
