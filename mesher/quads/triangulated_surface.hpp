#pragma once
/// A triangulation as the surface on which the quads made of it are smoothed.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/side_twins.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille {

/// The first parameter of a point is the number of its triangle. move() walks from triangle to triangle and
/// ends at the nearest point found. Normals vary linearly between those of the points.
class TriangulatedSurface : public MeshSurface {
 public:
  /// One patch: all triangles are neighbors across the sides they share, whatever their tags.
  explicit TriangulatedSurface(TriangleMesh patch);

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override;
  Vector2 between(std::span<const Vector2> uvs) const override { return uvs.front(); }

  /// Parameters of a point of the patch; the point must belong to a triangle.
  Vector2 parameters_of(int point) const { return {triangle_at_[point], 0}; }
  const Vector3& normal_of(int point) const { return normals_[point]; }
  const Vector3& corner(std::size_t triangle, int k) const { return points_[triangles_[triangle][k]]; }
  /// Whether the point lies on the patch's boundary.
  bool on_boundary(int point) const { return boundary_[point] != 0; }

 private:
  struct Nearest {
    double squared_distance;
    Vector3 weights;  // barycentric
  };

  Nearest nearest_on(int triangle, const Vector3& target) const;

  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<Side, 3>> twins_;
  std::vector<Vector3> normals_;
  std::vector<int> triangle_at_;
  std::vector<char> boundary_;
};

/// Cleans up and smooths quads that recombine() made of a triangulation, tag by tag, on the triangulation
/// itself. Nodes on the boundary of a tag, and those marked as fixed, stay where they are. Others move,
/// vanish or are added, so points are renumbered. \param renumbered out, by point of the triangulation: the
/// point of the result if it stays, else -1. Throws Error (cancelled). Time: linear in practice.
QuadMesh improve_on(const TriangleMesh& triangulation, const QuadMesh& quads, const ImproveOptions& options,
                    std::vector<int>& renumbered, ExecutionContext& context);

}  // namespace quadrille
