#pragma once
/// Several faces that meet smoothly, as one surface. Internal.

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/quads/triangulated_surface.hpp"

namespace quadrille {

/// Parameters of a point begin with the number of a triangle of a mesh of the faces. The triangle determines
/// the face on whose surface the point lies: move() walks over the triangles to find the face, then searches
/// on the face's own surface. Use one object per thread.
class CompositeSurface : public MeshSurface {
 public:
  /// \param triangles of all faces, consistently oriented \param members (triangles) index into `surfaces`
  /// \param uvs (triangles) parameters of the corners on the surface of their face
  CompositeSurface(TriangleMesh triangles, std::vector<int> members, std::vector<std::array<Vector2, 3>> uvs,
                   std::vector<std::shared_ptr<const MeshSurface>> surfaces)
      : walk_(std::move(triangles)),
        members_(std::move(members)),
        uvs_(std::move(uvs)),
        surfaces_(std::move(surfaces)) {}

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    const Vector3 walked = walk_.move(uv, target, normal);
    Vector2 on_face = member_uv(uv, walked);
    return surfaces_[member(uv)]->nearest(on_face, target);
  }
  Vector2 between(std::span<const Vector2> uvs) const override { return walk_.between(uvs); }

  /// The index of the face that a point's triangle belongs to.
  int member(const Vector2& uv) const { return members_[static_cast<std::size_t>(uv.x())]; }
  /// The parameters near a point on the surface of its face.
  Vector2 member_uv(const Vector2& uv, const Vector3& point) const {
    const auto t = static_cast<std::size_t>(uv.x());
    const Vector3 &a = walk_.corner(t, 0), &b = walk_.corner(t, 1), &c = walk_.corner(t, 2);
    const Vector3 normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    if (!(area > 0)) return uvs_[t][0];
    const double second = std::clamp((point - a).cross(c - a).dot(normal) / area, 0.0, 1.0),
                 third = std::clamp((b - a).cross(point - a).dot(normal) / area, 0.0, 1.0 - second);
    return (1 - second - third) * uvs_[t][0] + second * uvs_[t][1] + third * uvs_[t][2];
  }

 private:
  TriangulatedSurface walk_;
  std::vector<int> members_;
  std::vector<std::array<Vector2, 3>> uvs_;
  std::vector<std::shared_ptr<const MeshSurface>> surfaces_;
};

}  // namespace quadrille
