#pragma once
/// Says what is wrong with a face whose quads stay inverted, and where. Internal.

#include <vector>

#include "mesher/faces/face_chart.hpp"
#include "mesher/faces/face_problem.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// The problem of inverted quads, with the edges that they and the quads around them touch.
/// \param inverted indices of the quads, at least one
FaceProblem inverted_problem(const CadShape& shape, FaceId face, const FaceChart& chart,
                             const BoundaryNodes& nodes, const FaceMesh& mesh,
                             const std::vector<int>& inverted);

}  // namespace quadrille
