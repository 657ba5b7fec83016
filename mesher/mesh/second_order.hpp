#pragma once
/// Eight-node (serendipity) quads.

#include <array>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The nodes of one eight-node quad: corners counter-clockwise, midside k between corners k and k + 1.
struct CurvedQuad {
  std::array<Vector3, 4> corners, midsides;
};

/// \param quad an element of a mesh of order 2.
CurvedQuad curved_quad(const ShellMesh& mesh, std::size_t quad);

/// Element `quad` with its midside nodes halfway between the corners; of a mesh of any order.
CurvedQuad straight_quad(const ShellMesh& mesh, std::size_t quad);

/// A lower bound of the Jacobian over the whole element, divided by the mean Jacobian of the quad with
/// straight sides; positive = valid everywhere, not at the nodes alone. On a curved surface the Jacobian is
/// the vector (dx/dxi) x (dx/deta), measured along three normals, the least counting: that of the quad with
/// straight sides, that at the element's center, and that of the element's vector area. An element is thus
/// valid if its normal turns by less than a right angle from each of them; CalculiX, which expands shells
/// along their nodes' normals, refuses no such element. For straight sides the three are one, and the bound
/// is the least value, positive exactly where the scaled Jacobian is. Else it is the least Bernstein
/// coefficient, sharpened by subdivision where it is not positive: within 1e-3 of the least value or
/// certainly not positive. Based on: Johnen, Remacle, Geuzaine, Geometrical validity of curvilinear finite
/// elements (2013).
double jacobian_bound(const CurvedQuad& element);

/// A lower bound of jacobian_bound(), far cheaper; as good where sides are straight, and positive for most
/// elements whose sides are nearly so.
double quick_jacobian_bound(const CurvedQuad& element);

/// Whether the element is not valid everywhere: jacobian_bound() is not positive by more than rounding
/// errors.
bool folds(const CurvedQuad& element);

}  // namespace quadrille
