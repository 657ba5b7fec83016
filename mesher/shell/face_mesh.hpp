#pragma once
/// The finished quads of one face. Internal.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/base/vector.hpp"
#include "geometry/cad/ids.hpp"
#include "geometry/surfaces/mesh_surface.hpp"

namespace quadrille {

/// The quads of one face, ready for assembly. The first `nodes.size()` points lie on the boundary.
struct FaceMesh {
  std::vector<Vector3> points;
  std::vector<Vector2> uv;                     ///< (n) parameters on the surface
  std::vector<char> pole;                      ///< (n) 1 = the point is a pole: its uv is one of many
  std::vector<std::array<int, 4>> quads;       ///< counter-clockwise about the face's normal in the model
  std::vector<int> nodes;                      ///< indices into BoundaryNodes::points
  bool grid = false;                           ///< the face was meshed as a grid, see face_grid.hpp
  std::shared_ptr<const MeshSurface> surface;  ///< surface that uv refer to; null = the face's own
  std::vector<Vector3> normals;  ///< (n) unit normals, if faces are taken as one (crossed_edges.hpp)
  /// (n) distance of each point from the surface, where quads on it would be inverted; empty = all lie on it.
  /// Otherwise no point inside the face moves any more.
  std::vector<double> off;
};

/// The meshes of the faces; empty = not meshed.
using FaceMeshes = IdVector<FaceId, std::optional<FaceMesh>>;

}  // namespace quadrille
