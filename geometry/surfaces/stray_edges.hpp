#pragma once
/// Edges that run far out of their model because of a damaged number in the file.

#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

struct StrayEdge {
  int edge = 0;         ///< CadEdge::number
  double distance = 0;  ///< largest distance from the bounding box of the surfaces
  double span = 0;      ///< diagonal of that box
  /// "Edge7 runs 9998 mm away from the model's surfaces, ...".
  std::string sentence() const;
};

/// The edges of the used faces that leave the bounding box of the model's surfaces by more than ten of its
/// diagonals. No size suits them: their length is not a length of the part.
/// Time: some ten evaluations per long edge.
std::vector<StrayEdge> stray_edges(const CadShape& shape, const FaceFlags& used);

}  // namespace quadrille
