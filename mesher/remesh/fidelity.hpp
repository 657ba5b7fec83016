#pragma once
/// How far a mesh is from the surface that it was made of. Internal.

#include <map>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/remesh.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

double area_of(const TriangleMesh& mesh);

/// Distances both ways, and areas and volumes but the surface's area. \param patches (triangles of the
/// surface). \param patch_of_face of the mesh. O(n log n).
RemeshFidelity measure_fidelity(const TriangleMesh& surface, const std::vector<int>& patches,
                                const SurfaceLocator& locator, const ShellMesh& mesh,
                                const std::map<int, int>& patch_of_face);

}  // namespace quadrille
