#pragma once
/// Faces put together into one conforming mesh. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// Numbers the nodes (CAD vertices, edges, then face by face), and adds midside nodes on the geometry at
/// second order. Nodes that no quad uses are left out.
ShellMesh assemble(const CadShape& shape, const BoundaryNodes& nodes,
                   const std::vector<std::optional<FaceMesh>>& faces, std::vector<ShellMesh::Face> statuses,
                   const MeshOptions& options, ExecutionContext& context);

/// Says on each face how many of its midside nodes are off the geometry, and how far.
void note_off_geometry(ShellMesh& mesh);

}  // namespace quadrille
