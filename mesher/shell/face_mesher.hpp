#pragma once
/// Meshes one face, from its boundary nodes to improved quads. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_chart.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/options.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// How a face is meshed.
struct FaceRecipe {
  ChartKind chart = ChartKind::own;             ///< plane that the face is triangulated in
  bool mapped = true;                           ///< mesh the face as a grid if its outline allows
  bool clean_up = true;                         ///< do topological clean-up
  double refusal = PlacementOptions().refusal;  ///< least distance between points, see PlacementOptions
  int fineness = 1;                             ///< divides the spacing of inner points
  bool pair = true;                             ///< pair the triangles; else each becomes three quads
  bool leaves_surface = false;                  ///< nodes of inverted quads may leave the surface
  double reach = 0;                             ///< how far they may then move
  bool inverted_too = false;                    ///< also return a mesh that keeps inverted quads
};

/// Meshes a face in one attempt: tries candidates (a grid, rings round its holes, neither; quads cut in four,
/// quads of the final size) as far as FaceJudge has doubts, and returns the best. Throws FaceProblem if none
/// of them is valid.
FaceMesh mesh_face(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes,
                   const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
                   ExecutionContext& context);

/// The problem of inverted quads, with the edges that they and the quads around them touch.
/// \param inverted indices of the quads, at least one
FaceProblem inverted_problem(const CadShape& shape, FaceId face, const FaceChart& chart,
                             const BoundaryNodes& nodes, const FaceMesh& mesh,
                             const std::vector<int>& inverted);

}  // namespace quadrille
