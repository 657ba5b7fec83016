#pragma once
/// One face of a scanned surface, as the mesher sees it. Internal.

#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/quads/triangulated_surface.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

/// One face of a triangulation that is cut along the curves between its faces. Points are also found by the
/// tree of boxes, because a walk from triangle to triangle gets stuck among long narrow triangles side by
/// side, such as those of cylinders in CAD exports.
class PatchSurface : public MeshSurface {
 public:
  /// \param whole,locator the triangulation and its tree of boxes, which must outlive this \param patch from
  /// 0
  PatchSurface(const TriangulatedSurface& whole, const SurfaceLocator& locator, int patch)
      : whole_(whole), locator_(locator), patch_(patch) {}

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override;
  Vector2 between(std::span<const Vector2> uvs) const override { return whole_.between(uvs); }
  /// The point of the patch nearest to a target anywhere, its parameters and its normal.
  Vector3 find(const Vector3& target, Vector2& uv, Vector3& normal) const;

 private:
  const TriangulatedSurface& whole_;
  const SurfaceLocator& locator_;
  int patch_;
};

}  // namespace quadrille
