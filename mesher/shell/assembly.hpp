#pragma once
/// Assembles the meshes of the faces into one conforming mesh. Internal.

#include "mesher/edges/edge_sampling.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille {

/// Numbers the nodes (CAD vertices, CAD edges, then face by face), and at second order adds midside nodes on
/// the geometry. Boundary nodes that no quad uses are left out. Throws Error (failure) if an element of
/// second order folds even with straight sides.
/// \param order 1 or 2. `faces` of the result stays empty.
ShellMesh assemble(const ShellGeometry& geometry, const BoundaryNodes& nodes, const FaceMeshes& faces,
                   int order, ExecutionContext& context);

/// Records in each face's entry and note how many of its nodes are off the geometry, and how far.
void note_off_geometry(ShellMesh& mesh);

}  // namespace quadrille
