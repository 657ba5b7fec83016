#pragma once
/// Gives faces the mesh of other faces, moved, and lists the pairs of nodes. Internal.

#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/matching.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesh.hpp"
#include "mesher/shell/midsides.hpp"

namespace quadrille {

/// Copies the meshes of matched faces to their partners, as far as the former have one. The boundary nodes
/// are those of the partner's own edges. Throws Error (failure, subject "match") where it has no such node.
void copy_faces(const CadShape& shape, const Matches& matches, const BoundaryNodes& nodes, FaceMeshes& faces);

/// Lists the nodes of each pair that has them, in ShellMesh::matches, and moves midside nodes exactly to the
/// images of their partners. Throws Error (failure, subject "match") if two nodes lie further apart than the
/// tolerance of their pair allows.
void list_matches(const Matches& matches, const BoundaryNodes& nodes, const ShellNumbering& numbering,
                  ShellMesh& mesh);

}  // namespace quadrille
