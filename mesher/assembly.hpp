#pragma once
/// Faces put together into one conforming mesh. Internal.

#include <optional>
#include <vector>

#include "geometry/cad_shape.hpp"
#include "mesher/edge_sampling.hpp"
#include "mesher/face_mesher.hpp"
#include "mesher/mesh_types.hpp"

namespace quadrille {

/// Numbers the nodes (CAD vertices, edges, then face by face), and adds midside nodes on the geometry at
/// second order. Nodes that no quad uses are left out.
ShellMesh assemble(const CadShape& shape, const BoundaryNodes& nodes,
                   const std::vector<std::optional<FaceMesh>>& faces,
                   std::vector<ShellMesh::FaceStatus> statuses, const MeshOptions& options,
                   ExecutionContext& context);

}  // namespace quadrille
