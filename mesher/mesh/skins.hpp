#pragma once
/// Whether a shell with thickness has valid skins.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The CAD faces with elements that turn over on a skin, ascending; none if the mesh has no thicknesses.
/// Solvers that turn shells into solid elements, such as CalculiX, refuse these elements. A skin is half the
/// thickness away along the nodal normals: at each node the mean normal of the elements around it that differ
/// by less than 20 degrees. Each element is looked at in the four points of 2 x 2 Gauss integration.
QUADRILLE_API std::vector<int> faces_with_bad_skins(const ShellMesh& mesh);

/// One sentence that names such faces and says what to do; empty if there are none.
QUADRILLE_API std::string bad_skins_sentence(const std::vector<int>& faces);

}  // namespace quadrille
