/// Walks over the triangles, and takes what the tree of boxes finds where that is closer and on the same
/// side.

#include "mesher/remesh/patch_surface.hpp"

namespace quadrille {

Vector3 PatchSurface::move(Vector2& uv, const Vector3& target, Vector3& normal) const {
  Vector3 walked = whole_.move(uv, target, normal);
  const SurfaceLocator::Place found = locator_.nearest(patch_, target);
  constexpr double closer = 1 - 1e-9;
  if ((found.point - target).norm() >= closer * (walked - target).norm()) return walked;
  Vector2 place(found.triangle, 0);
  Vector3 there;
  whole_.move(place, found.point, there);
  if (there.dot(normal) <= 0) return walked;  // another sheet of the surface
  uv = place;
  normal = there;
  return found.point;
}

Vector3 PatchSurface::find(const Vector3& target, Vector2& uv, Vector3& normal) const {
  uv = {locator_.nearest(patch_, target).triangle, 0};
  return move(uv, target, normal);
}

}  // namespace quadrille
