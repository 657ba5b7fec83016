#pragma once
/// How far a mesh deviates from the surface that it was made from. Internal.

#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/remesh.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

/// Measures the distances in both directions, and the areas.
/// \param patches (triangles of the surface) the face of each triangle, from 0. \param face_numbers (faces of
/// the surface) the number of each in the mesh. O(n log n).
RemeshFidelity measure_fidelity(const TriangleMesh& surface, const std::vector<int>& patches,
                                const SurfaceLocator& locator, const ShellMesh& mesh,
                                const std::vector<int>& face_numbers);

}  // namespace quadrille
