#pragma once
/// Finds what forces sides shorter than half the least size. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Names, for each quad of the mesh with a side shorter than half of mesh.size_min, the CAD edge or face that
/// forces it: an edge shorter than the least size that has a side of the quad, else the quad's face. One
/// entry for each edge and face, those with the most quads first. Nothing if size_min is 0. Linear in the
/// mesh.
std::vector<ShellMesh::ShortSides> short_sides(const CadShape& shape, const ShellMesh& mesh);

}  // namespace quadrille
