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

/// The triangles that quads of half their size are made of, and what lies round them.
struct PatchTriangles {
  /// A side at the boundary, with the node in its middle.
  struct Side {
    int a = -1, b = -1;  ///< points here
    int middle = -1;     ///< node of the whole
    Vector3 place;       ///< of that node
  };
  int patch = 0;               ///< of the surface, from 0
  TriangleMesh mesh;           ///< points on the boundary first
  std::vector<int> nodes;      ///< (points on the boundary) nodes of the whole
  std::vector<double> angles;  ///< (points on the boundary) that the face fills there, radians
  std::vector<Side> sides;     ///< of the boundary
};

/// The quads of a face.
struct PatchQuads {
  int patch = 0;                          ///< of the surface, from 0
  std::vector<Vector3> points;            ///< on the surface
  int off_surface = 0;                    ///< how many are not, since quads would be turned over
  std::vector<Vector2> places;            ///< (points) as SmoothingSurface::move() takes them
  std::vector<int> nodes;                 ///< (points) node of the whole; -1 = of this face alone
  std::vector<std::array<int, 4>> quads;  ///< the way round that the triangles have
};

/// The surface that the faces lie on.
struct PatchSurface {
  const SmoothingSurface& surface;  ///< a TriangulatedSurface, cut along the curves
  const SurfaceLocator& locator;    ///< of the same triangles
};

/// One face of the surface. Points are found by the tree of boxes: a walk from triangle to triangle ends
/// where long and narrow ones lie side by side, as those of cylinders in files of CAD systems do.
class PatchOfSurface : public SmoothingSurface {
 public:
  PatchOfSurface(const PatchSurface& on, int patch) : on_(on), patch_(patch) {}
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override;

 private:
  const PatchSurface on_;
  int patch_;
};

/// Pairs the triangles, cleans up, splits each quad into four and each triangle into three, and smooths, on
/// the surface. Throws Error (cancelled).
PatchQuads quads_on_patch(PatchTriangles triangles, const PatchSurface& on, const RecombineOptions& recombine,
                          const ImproveOptions& improve, ExecutionContext& context);

}  // namespace quadrille
