#pragma once
/// Meshes faces for which no remedy is left, with nodes off their surfaces and edges. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_problem.hpp"
#include "mesher/options.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// Quads that are subdivided from valid triangles are valid if their nodes need not lie on the surface. Takes
/// the first of these that leaves no quad inverted and no node further than `reach` from the surface: the
/// usual quads, those of the triangles alone (each in its own charts), and triangles that span the loops in
/// space. Nodes leave the surface only at quads that would be inverted, except with the last, whose triangles
/// must face one way.
/// \param problem why the face has no mesh; thrown if none of them works
/// \param reach the largest distance of a node from the surface, model units
/// \param inverted_too returns the last of them with inverted quads rather than throw
/// \return the mesh, with its distances in FaceMesh::off
FaceMesh mesh_off_surface(const CadShape& shape, const FaceProblem& problem, const BoundaryNodes& nodes,
                          const SizingField& field, double reach, bool inverted_too,
                          const MeshOptions& options, ExecutionContext& context);

/// Moves the nodes of the inverted quads of a face so that no quad is inverted there, those on its edges too,
/// with the faces beside it. Vertices stay. \param nodes,meshes changed only where that succeeds; the edges
/// with moved nodes become BoundaryNodes::Edge::kept, and the distances are in BoundaryNodes::off and
/// FaceMesh::off. \param reach the largest distance of a node from its place, model units
/// \return whether the face and those beside it then have no inverted quads
bool unfold_with_edges(const CadShape& shape, FaceId face, double reach, BoundaryNodes& nodes,
                       FaceMeshes& meshes, const ExecutionContext& context);

}  // namespace quadrille
