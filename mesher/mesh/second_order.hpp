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

/// (dx/dxi) x (dx/deta) at a point of the reference square [-1, 1]^2.
Vector3 area_vector(const CurvedQuad& element, double xi, double eta);

/// Puts the midsides halfway between the corners.
void straighten(CurvedQuad& element);

/// \param quad an element of a mesh of order 2.
CurvedQuad curved_quad(const ShellMesh& mesh, std::size_t quad);

/// Element `quad` with its midside nodes halfway between the corners. The mesh may be of any order.
CurvedQuad straight_quad(const ShellMesh& mesh, std::size_t quad);

/// A lower bound of the Jacobian over the whole element, divided by the mean Jacobian of the quad with
/// straight sides. Positive = the element is valid everywhere, not only at the nodes. On a curved surface the
/// Jacobian is the vector (dx/dxi) x (dx/deta). It is measured along three normals, and the least counts: the
/// normal of the quad with straight sides, the normal at the element's center, and that of the element's
/// vector area. Thus an element is valid if its normal deviates from each of them by less than 90 degrees.
/// CalculiX, which expands shells along their nodes' normals, refuses no such element. For straight sides the
/// three coincide, and the bound is the exact minimum, positive exactly where the scaled Jacobian is.
/// Otherwise it is the least Bernstein coefficient. If that is not positive, subdivision sharpens it until it
/// is within 1e-3 of the minimum or certainly not positive. Based on: Johnen, Remacle, Geuzaine, Geometrical
/// validity of curvilinear finite elements (2013).
double jacobian_bound(const CurvedQuad& element);

/// A lower bound of jacobian_bound() that costs far less. It is equal for straight sides, and positive for
/// most elements with nearly straight sides.
double quick_jacobian_bound(const CurvedQuad& element);

/// Whether the element is invalid somewhere: jacobian_bound() does not exceed rounding errors.
bool folds(const CurvedQuad& element);

}  // namespace quadrille
