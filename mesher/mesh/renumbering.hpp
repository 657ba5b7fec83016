#pragma once
/// Reorders large meshes so that neighbors are near each other in memory. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A reordered mesh with the same elements.
struct RenumberedMesh {
  TriangleMesh mesh;           ///< points, triangles and tags; `fixed` is not carried over
  std::vector<int> old_point;  ///< for each point of `mesh`, its index in the original mesh
};

/// Orders triangles along a space-filling curve, and points by their first use in a triangle. Points that no
/// triangle uses are left out. Deterministic. Time: linear. Indices must have been checked.
RenumberedMesh order_by_place(const TriangleMesh& mesh, const ExecutionContext& context = {});

/// The same for quads: orders them along the curve and renumbers their points, except the first `fixed` ones.
/// Other points that no quad uses are left out. \return the index that each point had before.
std::vector<int> order_by_place(const std::vector<Vector3>& points, std::size_t fixed,
                                std::vector<std::array<int, 4>>& quads, const ExecutionContext& context = {});

}  // namespace quadrille
