#pragma once
/// Repairs second-order elements that fold because of their curved sides. Internal.

#include <cstddef>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille {

/// Moves midside nodes until no element folds (see second_order.hpp): toward the middle of the straight side,
/// by as little as helps, those inside faces first, then those on CAD edges, for all faces that share them.
/// Nodes off the geometry are listed in `mesh.off_geometry`. With straight sides an element with a positive
/// scaled Jacobian does not fold, so only inverted quads and quads without area still fold in the end.
/// \return the quads that still fold, ascending. Linear in the mesh and in the number of elements that fold.
std::vector<std::size_t> unfold(const MeshedFaces& meshed, const ShellNumbering& numbering,
                                const Midsides& midsides, ShellMesh& mesh, const ExecutionContext& context);

}  // namespace quadrille
