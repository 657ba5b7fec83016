#pragma once
/// One face from its boundary nodes to improved quads. Internal.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/options.hpp"

namespace quadrille {

/// The quads of one face, ready to be assembled. Points: those on the boundary first, `nodes.size()` of them.
struct FaceMesh {
  std::vector<Vector3> points;
  std::vector<Vector2> uv;
  std::vector<char> pole;                 ///< (n) 1 = uv is one of many
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise seen against the face's normal in the model
  std::vector<int> nodes;                 ///< indices into BoundaryNodes::points
  int inverted = 0;                       ///< quads with scaled Jacobian <= 0
  double q_min = 0;
  std::string note;                            ///< "grid" (see face_grid.hpp), or which fallback was taken
  std::shared_ptr<const FaceSurface> surface;  ///< what uv are parameters of; null = the face's own surface
  double seconds = 0;
};

/// Triangulates, recombines and improves one face.
/// \param fineness how many times as many segments as asked for the boundary has. Where the face fails, its
/// points are tried as fine; from 4 on, it is tried with parametric curves made anew, and as it is seen from
/// above. Throws Error (failure) naming the face.
FaceMesh mesh_face(const CadShape& shape, int face, const BoundaryNodes& nodes, const SizingField& field,
                   const MeshOptions& options, int fineness, ExecutionContext& context);

}  // namespace quadrille
