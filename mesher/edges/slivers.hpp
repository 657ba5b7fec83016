#pragma once
/// Faces so narrow that they become edges, whatever the number of their own edges. Internal.

#include <array>
#include <memory>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// A face that is narrower than a given width everywhere, as two chains of edges that lie along each other: a
/// loop between two ends, or the two loops of a ring. A tube along a seam has no such chains; it vanishes.
struct Sliver {
  /// Edges that lie along each other from end to end.
  struct Pair {
    EdgeId edge;    ///< keeps its nodes
    EdgeId other;   ///< shares them
    bool reversed;  ///< the two run in opposite directions
  };
  FaceId face;
  std::vector<Pair> pairs;
  std::vector<std::array<VertexId, 2>> ties;  ///< vertices inside the chains that face each other
  /// Vertices at the two sides of short edges, which must share a node for the pairs to fit.
  std::vector<std::array<VertexId, 2>> joints;
  std::vector<EdgeId> rims;  ///< edges at the ends of a tube, which must become points
};

/// The slivers among the used faces whose vertices all face each other, see divided_at_slivers().
/// \param width model units. Edges shorter than this count as short.
std::vector<Sliver> find_slivers(const CadShape& shape, const FaceFlags& used, double width);

/// A copy of the shape whose slivers have vertices that face each other: where a vertex of one chain faces
/// the inside of an edge, that edge is in two pieces. Pieces keep the number of the edge; the new vertices
/// come after the model's own. Null if there is nothing to divide.
std::shared_ptr<const CadShape> divided_at_slivers(const CadShape& shape, const FaceFlags& used,
                                                   double width);

}  // namespace quadrille
