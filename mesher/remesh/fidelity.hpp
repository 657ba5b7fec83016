#pragma once
/// How far a mesh deviates from the surface that it was made from. Internal.

#include <map>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/remesh.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

double area_of(const TriangleMesh& mesh);

/// Measures the distances in both directions, the area of the mesh, and the volumes if the surface is closed;
/// not the surface's area. \param patches (triangles of the surface) the face of each triangle, from 0.
/// \param patch_of_face face number in the mesh -> face of the surface. O(n log n).
RemeshFidelity measure_fidelity(const TriangleMesh& surface, const std::vector<int>& patches,
                                const SurfaceLocator& locator, const ShellMesh& mesh,
                                const std::map<int, int>& patch_of_face);

}  // namespace quadrille
