#pragma once
/// Quads on one face of a triangulated surface. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

/// The triangles of a face, from which quads of half their size are made, and the face's boundary.
struct PatchTriangles {
  /// A side on the boundary, with the node at its middle.
  struct Side {
    int a = -1, b = -1;  ///< points of `mesh`
    int middle = -1;     ///< node of the whole mesh at the middle of the side
    Vector3 place;       ///< position of that node
  };
  int patch = 0;               ///< face of the surface, from 0
  TriangleMesh mesh;           ///< points on the boundary come first
  std::vector<int> nodes;      ///< (points on the boundary) nodes of the whole mesh
  std::vector<double> angles;  ///< (points on the boundary) angle that the face fills there, radians
  std::vector<Side> sides;     ///< sides on the boundary
};

/// The quads of a face.
struct PatchQuads {
  int patch = 0;                          ///< face of the surface, from 0
  std::vector<Vector3> points;            ///< points on the surface, but for `off_surface` of them
  int off_surface = 0;                    ///< number of points moved off the surface to avoid inverted quads
  std::vector<Vector2> places;            ///< (points) parameters as in SmoothingSurface::move()
  std::vector<int> nodes;                 ///< (points) node of the whole mesh; -1 = inside this face
  std::vector<std::array<int, 4>> quads;  ///< oriented as the triangles are
};

/// The surface that the faces lie on.
struct PatchSurface {
  const SmoothingSurface& surface;  ///< a TriangulatedSurface, cut along the curves
  const SurfaceLocator& locator;    ///< finds points on the same triangles
};

/// One face of the surface. Points are also found by the tree of boxes, because a walk from triangle to
/// triangle gets stuck among long narrow triangles side by side, such as those of cylinders in CAD exports.
class PatchOfSurface : public SmoothingSurface {
 public:
  PatchOfSurface(const PatchSurface& on, int patch) : on_(on), patch_(patch) {}
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override;

 private:
  const PatchSurface on_;
  int patch_;
};

/// Pairs the triangles, cleans up, splits each quad into four quads and each triangle into three, and smooths
/// them on the surface. Throws Error (cancelled).
PatchQuads quads_on_patch(PatchTriangles triangles, const PatchSurface& on, const RecombineOptions& recombine,
                          const ImproveOptions& improve, ExecutionContext& context);

}  // namespace quadrille
