#pragma once
/// Meshes one face, from its boundary nodes to improved quads. Internal.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_chart.hpp"
#include "mesher/faces/point_placement.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// The quads of one face, ready for assembly. The first `nodes.size()` points lie on the boundary.
struct FaceMesh {
  std::vector<Vector3> points;
  std::vector<Vector2> uv;
  std::vector<char> pole;                      ///< (n) 1 = the point is a pole: its uv is one of many
  std::vector<std::array<int, 4>> quads;       ///< counter-clockwise about the face's normal in the model
  std::vector<int> nodes;                      ///< indices into BoundaryNodes::points
  double q_min = 0;                            ///< lowest q of the quads
  bool grid = false;                           ///< the face was meshed as a grid, see face_grid.hpp
  std::shared_ptr<const FaceSurface> surface;  ///< surface that uv refer to; null = the face's own
  /// (n) distance of each point from the surface, where quads on it would be inverted; empty = all lie on it.
  /// Otherwise no point inside the face moves any more.
  std::vector<double> off;
};

/// The meshes of the faces; empty = not meshed.
using FaceMeshes = IdVector<FaceId, std::optional<FaceMesh>>;

/// How a face is meshed.
struct FaceRecipe {
  /// Which nodes may leave the surface, as a last resort.
  enum class Off {
    none,
    where_inverted,  ///< those of inverted quads
    as_triangles     ///< likewise, on triangles that were not paired
  };
  ChartKind chart = ChartKind::own;             ///< plane that the face is triangulated in
  bool mapped = true;                           ///< mesh the face as a grid if its outline allows
  bool clean_up = true;                         ///< do topological clean-up
  double refusal = PlacementOptions().refusal;  ///< least distance between points, see PlacementOptions
  int fineness = 1;                             ///< divides the spacing of inner points
  Off off = Off::none;                          ///< which nodes may leave the surface
};

/// Triangulates, recombines and improves a face in one attempt. Throws FaceProblem.
FaceMesh mesh_face(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes,
                   const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
                   ExecutionContext& context);

}  // namespace quadrille
