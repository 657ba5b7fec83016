#pragma once
/// Edges that a damaged number has thrown far out of their model.

#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

struct StrayEdge {
  int edge = 0;         ///< from 1
  double distance = 0;  ///< from the surfaces' box
  double span = 0;      ///< that box's diagonal
  /// "Edge7 runs 9998 mm away from the model's surfaces, ...".
  std::string sentence() const;
};

/// The edges of the faces used that leave the model's box, which is that of its surfaces, by ten of its
/// diagonals and more. No size suits them: their length is no length of the part. \param used (faces) 1 =
/// wanted. Some ten evaluations an edge.
std::vector<StrayEdge> stray_edges(const CadShape& shape, const std::vector<char>& used);

}  // namespace quadrille
