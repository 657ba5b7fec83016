/// Walks over the triangles to find the face, then searches on the face's own surface.

#include "mesher/shell/composite_surface.hpp"

#include <algorithm>

namespace quadrille {

Vector2 CompositeSurface::member_uv(const Vector2& uv, const Vector3& point) const {
  const auto t = static_cast<std::size_t>(uv.x());
  const Vector3 &a = points_[corners_[t][0]], &b = points_[corners_[t][1]], &c = points_[corners_[t][2]];
  const Vector3 normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (!(area > 0)) return uvs_[t][0];
  const double second = std::clamp((point - a).cross(c - a).dot(normal) / area, 0.0, 1.0),
               third = std::clamp((b - a).cross(point - a).dot(normal) / area, 0.0, 1.0 - second);
  return (1 - second - third) * uvs_[t][0] + second * uvs_[t][1] + third * uvs_[t][2];
}

Vector3 CompositeSurface::move(Vector2& uv, const Vector3& target, Vector3& normal) const {
  const Vector3 walked = walk_.move(uv, target, normal);
  Vector2 on_face = member_uv(uv, walked);
  return surfaces_[member(uv)]->nearest(on_face, target);
}

}  // namespace quadrille
