#pragma once
/// Large triangulations in an order in which neighbors are near each other in memory. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A mesh in another order; the elements are the same ones.
struct RenumberedMesh {
  TriangleMesh mesh;
  std::vector<int> old_point;  ///< by point of `mesh`: its index before
};

/// Whether the mesh is large enough to be worth it, and its points or triangles do not lie in memory as they
/// lie in space. Looks at a sample: constant time.
bool is_scattered(const TriangleMesh& mesh);

/// Triangles in the order of a space-filling curve, points in the order in which
/// triangles use them first; points that no triangle uses are left out. Deterministic. Time: linear. Indices
/// must have been checked.
RenumberedMesh order_by_place(const TriangleMesh& mesh, const ExecutionContext& context = {});

/// The same for quads: puts them along the curve and numbers their points anew, but for the first `fixed`.
/// \return the index that each point had before. All points are to be used.
std::vector<int> order_by_place(const std::vector<Vector3>& points, std::size_t fixed,
                                std::vector<std::array<int, 4>>& quads, const ExecutionContext& context = {});

}  // namespace quadrille
