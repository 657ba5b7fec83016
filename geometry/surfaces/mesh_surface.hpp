#pragma once
/// The surface that a face is meshed on, whatever it is made of: a CAD face, a plane, or triangles. Internal.

#include <span>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// What the stages after the boundary need from a surface. Each kind defines what its parameters mean: those
/// of a CAD face are (u, v), those of a triangulation begin with the number of a triangle.
class MeshSurface {
 public:
  virtual ~MeshSurface() = default;

  /// Moves a point of the surface towards a target in space, and keeps it on the surface.
  /// \param uv in: parameters of the point; out: those of the new point.
  /// \return the point of the surface near `target`; its unit normal (the side that quads are
  /// counter-clockwise seen from) goes to `normal`.
  virtual Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const = 0;

  /// move() without the normal.
  virtual Vector3 approach(Vector2& uv, const Vector3& target) const {
    Vector3 normal;
    return move(uv, target, normal);
  }

  /// The point of the surface closest to `target` near `uv`, which is updated. As exact as the surface
  /// allows.
  virtual Vector3 nearest(Vector2& uv, const Vector3& target) const { return approach(uv, target); }

  /// Parameters from which a search between points finds the surface. \param uvs of at least one point.
  virtual Vector2 between(std::span<const Vector2> uvs) const {
    Vector2 sum(0, 0);
    for (const Vector2& uv : uvs) sum += uv / static_cast<double>(uvs.size());
    return sum;
  }
};

}  // namespace quadrille
