#pragma once
/// Eight-node (serendipity) quads.

#include <array>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A lower bound of the Jacobian determinant over the whole element, divided by its mean; positive = the
/// element is valid everywhere, not at the nodes alone. On a curved surface the Jacobian is measured along
/// the element's mean normal. The bound is the least Bernstein coefficient, sharpened by subdivision where it
/// is not positive; within 1e-3 of the least value or certainly not positive. Based on: Johnen, Remacle,
/// Geuzaine, Geometrical validity of curvilinear finite elements (2013). \param corners counter-clockwise
/// \param midsides between corner k and k + 1
double jacobian_bound(const std::array<Vector3, 4>& corners, const std::array<Vector3, 4>& midsides);

/// The bound for element `quad` of a second-order mesh.
double jacobian_bound(const ShellMesh& mesh, std::size_t quad);

}  // namespace quadrille
