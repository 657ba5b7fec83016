#pragma once
/// Several faces that meet smoothly, as one surface. Internal.

#include <array>
#include <memory>
#include <vector>

#include "geometry/surfaces/mesh_surface.hpp"
#include "mesher/quads/triangulated_surface.hpp"

namespace quadrille {

/// Parameters of a point begin with the number of a triangle of a mesh of the faces. The triangle determines
/// the face on whose surface the point lies. Use one object per thread.
class CompositeSurface : public MeshSurface {
 public:
  /// \param triangles of all faces, consistently oriented \param members (triangles) index into `surfaces`
  /// \param uvs (triangles) parameters of the corners on the surface of their face
  CompositeSurface(TriangleMesh triangles, std::vector<int> members, std::vector<std::array<Vector2, 3>> uvs,
                   std::vector<std::shared_ptr<const MeshSurface>> surfaces)
      : points_(triangles.points),
        corners_(triangles.triangles),
        walk_(std::move(triangles)),
        members_(std::move(members)),
        uvs_(std::move(uvs)),
        surfaces_(std::move(surfaces)) {}

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override;
  Vector2 between(std::span<const Vector2> uvs) const override { return walk_.between(uvs); }

  /// The index of the face that a point's triangle belongs to.
  int member(const Vector2& uv) const { return members_[static_cast<std::size_t>(uv.x())]; }
  /// The parameters near a point on the surface of its face.
  Vector2 member_uv(const Vector2& uv, const Vector3& point) const;

 private:
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> corners_;
  TriangulatedSurface walk_;
  std::vector<int> members_;
  std::vector<std::array<Vector2, 3>> uvs_;
  std::vector<std::shared_ptr<const MeshSurface>> surfaces_;
};

}  // namespace quadrille
