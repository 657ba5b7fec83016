#pragma once
/// Meshes a face for which no remedy is left, with nodes off its surface. Internal.

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
/// space. Nodes leave the surface only at quads that would be inverted, except with the last, which is not
/// taken for faces longer than `reach` whose curves cross.
/// \param problem why the face has no mesh; thrown if none of them works
/// \param reach the largest distance of a node from the surface, model units
/// \return the mesh, with its distances in FaceMesh::off
FaceMesh mesh_off_surface(const CadShape& shape, const FaceProblem& problem, const BoundaryNodes& nodes,
                          const SizingField& field, double reach, const MeshOptions& options,
                          ExecutionContext& context);

}  // namespace quadrille
