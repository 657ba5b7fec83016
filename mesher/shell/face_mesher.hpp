#pragma once
/// One face from its boundary nodes to improved quads. Internal.

#include <array>
#include <memory>
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

/// The quads of one face, ready to be assembled. Points: those on the boundary first, `nodes.size()` of them.
struct FaceMesh {
  std::vector<Vector3> points;
  std::vector<Vector2> uv;
  std::vector<char> pole;                 ///< (n) 1 = uv is one of many
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise seen against the face's normal in the model
  std::vector<int> nodes;                 ///< indices into BoundaryNodes::points
  double q_min = 0;
  bool grid = false;                           ///< see face_grid.hpp
  std::shared_ptr<const FaceSurface> surface;  ///< what uv are parameters of; null = the face's own surface
};

/// How a face is meshed.
struct FaceRecipe {
  ChartKind chart = ChartKind::own;
  bool mapped = true;                           ///< a regular grid where the face is one
  bool clean_up = true;                         ///< of the topology
  double refusal = PlacementOptions().refusal;  ///< between points, see PlacementOptions
  int fineness = 1;                             ///< its points are so many times as fine as asked for
};

/// Triangulates, recombines and improves one face, once. \param face from 0. Throws FaceProblem.
FaceMesh mesh_face(const CadShape& shape, int face, const FaceChart& chart, const BoundaryNodes& nodes,
                   const SizingField& field, const MeshOptions& options, const FaceRecipe& recipe,
                   ExecutionContext& context);

}  // namespace quadrille
