#pragma once
/// Assembles the meshes of the faces into one conforming mesh. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// Numbers the nodes (CAD vertices, CAD edges, then face by face), and at second order adds midside nodes on
/// the geometry. Boundary nodes that no quad uses are left out. Throws Error (failure) if an element of
/// second order folds even with straight sides.
ShellMesh assemble(const CadShape& shape, const BoundaryNodes& nodes, const FaceMeshes& faces,
                   std::vector<ShellMesh::Face> statuses, const MeshOptions& options,
                   ExecutionContext& context);

/// Records in each face's entry and note how many of its nodes are off the geometry, and how far.
void note_off_geometry(ShellMesh& mesh);

}  // namespace quadrille
