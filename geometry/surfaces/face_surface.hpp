#pragma once
/// The surface of one CAD face, evaluated fast. Internal.

#include <memory>
#include <vector>

#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

class BRepAdaptor_Surface;

namespace quadrille {

/// Point, first derivatives at parameters (u, v).
struct SurfacePoint {
  Vector3 point, du, dv;
};

/// Twice the vector area of a closed polygon (Newell's method).
Vector3 vector_area(const std::vector<Vector3>& loop);

/// Evaluates a face's surface. Planes, cylinders, cones, spheres and tori by their formulas, others through
/// OpenCASCADE. Evaluation caches inside: one object a thread.
class FaceSurface {
 public:
  explicit FaceSurface(const CadFace& face);

  /// The same surface in another parametrization: (u, v) are coordinates in a plane, in the model's unit, and
  /// stand for the point of the surface that is seen there along the plane's normal. For faces whose own
  /// parametrization is of no use. The plane is that of the loop's vector area. \param loop points round the
  /// face. Throws Error (failure) where the surface turns away from the plane's normal by more than 80
  /// degrees at a point of the loop or between them.
  static FaceSurface seen_from_above(const CadFace& face, const std::vector<Vector3>& loop);

  /// Whether (u, v) are coordinates in a plane.
  bool is_view() const { return view_ != nullptr; }
  /// Where a point lies in that plane.
  Vector2 seen_at(const Vector3& point) const;
  ~FaceSurface();
  FaceSurface(FaceSurface&&) noexcept;
  FaceSurface& operator=(FaceSurface&&) = delete;

  SurfacePoint evaluate(const Vector2& uv) const;
  Vector3 point(const Vector2& uv) const { return evaluate(uv).point; }

  /// Unit normal du x dv; at a singular point (pole, apex) the limit from inside the face.
  Vector3 normal(const Vector2& uv) const { return normal(evaluate(uv), uv); }
  Vector3 normal(const SurfacePoint& at, const Vector2& uv) const;

  /// Largest absolute principal curvature, 1 / length.
  double max_curvature(const Vector2& uv) const;

  /// The change of (u, v) that moves a point by `displacement` in space, to first order, in the least squares
  /// sense. Directions in which the parametrization is singular stay still.
  static Vector2 parameter_step(const SurfacePoint& at, const Vector3& displacement);

  /// The point of the surface near `target`, searched from `uv`, which is updated. Exact for elementary
  /// surfaces, one Newton step towards it for others; the result is on the surface in any case.
  SurfacePoint move(Vector2& uv, const Vector3& target) const;

  /// The closest point of the surface to `target` near `uv` (Newton iterations, bounded).
  SurfacePoint project(Vector2& uv, const Vector3& target) const;

  /// No more than the distance from a point to the surface, trimmed or not: exact for elementary surfaces
  /// without their trimming, 0 for others.
  double distance_at_least(const Vector3& point) const;

  bool planar() const { return kind_ == Kind::plane; }
  bool u_periodic() const { return u_period_ > 0; }
  bool v_periodic() const { return v_period_ > 0; }
  double u_period() const { return u_period_; }  ///< 0 = not periodic
  double v_period() const { return v_period_; }
  /// Mean lengths in space of a unit step in u and in v over the face: scales the parameter plane to be as
  /// isometric as it can be by two numbers.
  Vector2 mean_scale() const { return mean_scale_; }
  /// Whether all of it is one curve or point, as a torus that has lost its smaller radius is.
  bool is_curve() const { return is_curve_; }

 private:
  enum class Kind { plane, cylinder, cone, sphere, torus, other };
  struct View;

  void recognize();
  SurfacePoint evaluate_elementary(const Vector2& uv) const;
  SurfacePoint evaluate_other(const Vector2& uv) const;
  SurfacePoint evaluate_view(const Vector2& xy) const;
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
