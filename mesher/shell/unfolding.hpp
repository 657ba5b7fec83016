#pragma once
/// Second-order elements that curved sides fold, mended. Internal.

#include <cstddef>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille {

/// Moves midside nodes until no element folds (see second_order.hpp): first those inside faces along their
/// surface; where that does not help, towards the middle of the straight side, by as small a share as helps,
/// those inside faces first, then those on CAD edges, for all faces that share them. The nodes off the
/// geometry are listed in `mesh.off_geometry`. With all sides straight an element whose scaled Jacobian is
/// positive does not fold: what still folds are quads that are inverted or have no area.
/// \return the quads that still fold, ascending. Linear in the mesh, and in the elements that fold.
std::vector<std::size_t> unfold(const MeshedFaces& meshed, const ShellNumbering& numbering,
                                Midsides& midsides, ShellMesh& mesh, const ExecutionContext& context);

}  // namespace quadrille
