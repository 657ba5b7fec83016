#pragma once
/// Checks of all invariants of meshes. Tests call them after each stage.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Each function returns a sentence for each violation (at most 20), with the indices concerned; empty =
/// valid.

/// Checks: indices in range, no repeated node in an element, finite points, at most two triangles per side,
/// consistent orientation, no unused point, no triangle without area, as many tags as triangles or none.
QUADRILLE_API std::vector<std::string> validate(const TriangleMesh& mesh);

/// The same for quads. `require_convex` also requires positive scaled Jacobians.
QUADRILLE_API std::vector<std::string> validate(const QuadMesh& mesh, bool require_convex = false);

/// Checks: only quads; indices in range; no unused, repeated or coincident node (within 1e-9 of the
/// diagonal); positive scaled Jacobians; consistent orientation in each face; each side has one midside node;
/// second-order elements have a positive Jacobian everywhere; segments are sides; segments and corners are
/// listed once. In meshes with segments, each side that is not a segment has exactly two elements, of the
/// same face, or of faces between which quads cross smooth edges. \param closed require that every side has
/// at least two elements (a watertight shell).
QUADRILLE_API std::vector<std::string> validate(const ShellMesh& mesh, bool closed = false);

}  // namespace quadrille
