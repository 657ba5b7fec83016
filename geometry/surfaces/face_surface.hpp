#pragma once
/// Fast evaluation of the surface of one CAD face. Internal.

#include <memory>
#include <vector>

#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/mesh_surface.hpp"

class BRepAdaptor_Surface;

namespace quadrille {

/// Point and first derivatives at parameters (u, v).
struct SurfacePoint {
  Vector3 point, du, dv;
};

/// Twice the vector area of a closed polygon (Newell's method).
Vector3 vector_area(const std::vector<Vector3>& loop);

/// Evaluates a face's surface: planes, cylinders, cones, spheres and tori by their formulas, others through
/// OpenCASCADE. Evaluation uses internal caches, so use one object per thread.
class FaceSurface : public MeshSurface {
 public:
  explicit FaceSurface(const CadFace& face);

  /// The same surface in another parametrization, for faces whose own is unusable: (u, v) are coordinates in
  /// a plane, in the model's unit, of the point of the surface that lies above them along the plane's normal.
  /// The plane is that of the loop's vector area. \param loop points along the boundary of the face. Throws
  /// Error (failure) when the loop encloses no area, or when the surface turns away from the plane's normal
  /// by more than 80 degrees at a point of the loop.
  static FaceSurface seen_from_above(const CadFace& face, const std::vector<Vector3>& loop);

  /// Whether (u, v) are coordinates in a plane.
  bool is_view() const { return view_ != nullptr; }
  /// The coordinates of a point in that plane.
  Vector2 seen_at(const Vector3& point) const;
  ~FaceSurface() override;
  FaceSurface(FaceSurface&&) noexcept;
  FaceSurface& operator=(FaceSurface&&) = delete;

  SurfacePoint evaluate(const Vector2& uv) const;
  Vector3 point(const Vector2& uv) const { return evaluate(uv).point; }

  /// Unit normal along du x dv. At a singular point (pole, apex) the normal a little inside the face.
  Vector3 normal(const Vector2& uv) const { return normal(evaluate(uv), uv); }
  Vector3 normal(const SurfacePoint& at, const Vector2& uv) const;

  /// Largest absolute principal curvature, 1 / length.
  double max_curvature(const Vector2& uv) const;

  /// The change of (u, v) that moves a point by `displacement` in space, to first order and in the
  /// least-squares sense. Parameters in whose direction the parametrization is singular do not change.
  static Vector2 parameter_step(const SurfacePoint& at, const Vector3& displacement);

  /// The point of the surface near `target`, searched from `uv`, which is updated. Exact for elementary
  /// surfaces, one Newton step for others. The result always lies on the surface.
  SurfacePoint move(Vector2& uv, const Vector3& target) const;

  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal_there) const override {
    const SurfacePoint at = move(uv, target);
    normal_there = normal(at, uv);
    return at.point;
  }
  /// The point of the surface closest to `target` near `uv`, which is updated (bounded Newton iterations).
  SurfacePoint project(Vector2& uv, const Vector3& target) const;
  Vector3 approach(Vector2& uv, const Vector3& target) const override { return move(uv, target).point; }
  Vector3 nearest(Vector2& uv, const Vector3& target) const override { return project(uv, target).point; }

  /// A lower bound of the distance from a point to the surface, trimmed or not. It is the exact distance to
  /// untrimmed elementary surfaces, and 0 for others.
  double distance_at_least(const Vector3& point) const;

  bool planar() const { return kind_ == Kind::plane; }
  bool u_periodic() const { return u_period_ > 0; }
  bool v_periodic() const { return v_period_ > 0; }
  double u_period() const { return u_period_; }  ///< 0 = not periodic
  double v_period() const { return v_period_; }
  /// Mean lengths in space of a unit step in u and in v over the face. Scaling the parameter plane by them
  /// makes it as isometric as two numbers can.
  Vector2 mean_scale() const { return mean_scale_; }
  /// Whether the surface degenerates to a curve or a point, as a torus with a minor radius of zero does.
  bool is_curve() const { return is_curve_; }

 private:
  enum class Kind { plane, cylinder, cone, sphere, torus, other };
  struct View;

  void recognize();
  SurfacePoint evaluate_own(const Vector2& uv) const;
  SurfacePoint evaluate_elementary(const Vector2& uv) const;
  SurfacePoint evaluate_other(const Vector2& uv) const;
  SurfacePoint evaluate_view(const Vector2& xy) const;
  /// The radius around the axis at v, of cones and tori negative beyond the apex or the axis; that of a
  /// sphere everywhere. 0 for other kinds.
  double radius_at(double v) const;
  Vector2 inverse(const Vector2& near, const Vector3& target) const;
  Vector2 clamp(Vector2 uv) const;
  /// One step of Newton's method.
  Vector2 step_towards(const Vector2& uv, const SurfacePoint& at, const Vector3& target) const;
  void measure_scale();

  Kind kind_ = Kind::other;
  std::unique_ptr<BRepAdaptor_Surface> adaptor_;
  std::unique_ptr<View> view_;
  Vector3 origin_, x_, y_, z_;  // frame of an elementary surface
  double radius_ = 0;           // cylinder, sphere; reference radius of a cone; major radius of a torus
  double minor_radius_ = 0;     // torus
  double sin_angle_ = 0, cos_angle_ = 1;  // half-angle of a cone
  double u_period_ = 0, v_period_ = 0;
  Vector2 low_, high_;  // bounds of the face in the parameter plane
  Vector2 mean_scale_{1, 1};
  bool is_curve_ = false;
};

}  // namespace quadrille
