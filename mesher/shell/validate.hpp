#pragma once
/// Checks of every invariant; tests call them after each stage.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Each returns the violated invariants, one sentence each with the indices concerned (at most 20); empty =
/// valid.

/// Indices in range, no repeated node in an element, manifold (at most two triangles a side), oriented alike,
/// no unused point, no triangle of area zero.
QUADRILLE_API std::vector<std::string> validate(const TriangleMesh& mesh);

/// As for triangles; `require_convex` asks for positive scaled Jacobians too.
QUADRILLE_API std::vector<std::string> validate(const QuadMesh& mesh, bool require_convex = false);

/// All quads; indices in range; no unused, repeated or coincident node (within 1e-9 of the diagonal); each
/// side that is not on a CAD edge has exactly two elements of the same face, oriented alike; positive scaled
/// Jacobians; midside nodes shared, second-order elements with a positive Jacobian everywhere; each side on a
/// CAD edge is listed once in `segments`; corners listed once. \param closed ask that every side have at
/// least two elements (a watertight shell).
QUADRILLE_API std::vector<std::string> validate(const ShellMesh& mesh, bool closed = false);

}  // namespace quadrille
