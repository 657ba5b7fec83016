/// Elementary surfaces follow the parametrizations of OpenCASCADE's ElSLib. Curvature comes from the first
/// and second fundamental forms (do Carmo, Differential Geometry of Curves and Surfaces, 3.3).

#include "geometry/surfaces/face_surface.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <limits>

#include <Eigen/LU>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"

namespace quadrille {

namespace {

/// The angle equal to `angle` modulo `period` that is nearest to `reference`.
double nearest_period(double angle, double reference, double period) {
  return angle + period * std::round((reference - angle) / period);
}

}  // namespace

/// A plane onto which a surface is projected, and samples of the surface to start searches from.
struct FaceSurface::View {
  static constexpr int across = 48, buckets = 32;
  Vector3 origin, x, y, normal;
  Eigen::AlignedBox2d box;                  // of the samples in the plane
  Vector2 least_uv, greatest_uv;            // bounds within which the surface may be evaluated
  std::vector<Vector2> uv;                  // parameters of the samples that face the plane
  std::vector<Vector2> xy;                  // coordinates of the same samples in the plane
  std::array<int, buckets * buckets> near;  // index of the sample nearest to the middle of each bucket

  Vector2 at(const Vector3& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }

  int nearest(const Vector2& p) const {
    const Vector2 t = (p - box.min()).cwiseQuotient(box.sizes().cwiseMax(1e-300)) * buckets;
    return near[cell_at(t.y(), buckets) * buckets + cell_at(t.x(), buckets)];
  }

  void fill_buckets() {
    for (const Vector2& p : xy) box.extend(p);
    for (int i = 0; i < buckets * buckets; ++i) {
      const int column = i % buckets, row = i / buckets;
      const Vector2 middle = box.min() + box.sizes().cwiseProduct(Vector2(column + 0.5, row + 0.5)) / buckets;
      int best = 0;
      for (std::size_t k = 1; k < xy.size(); ++k) {
        if ((xy[k] - middle).squaredNorm() < (xy[best] - middle).squaredNorm()) best = static_cast<int>(k);
      }
      near[i] = best;
    }
  }
};

FaceSurface::FaceSurface(const CadFace& face)
    : adaptor_(std::make_unique<BRepAdaptor_Surface>(face.face, Standard_False)),
      low_(face.u_min, face.v_min),
      high_(face.u_max, face.v_max) {
  if (adaptor_->IsUPeriodic()) u_period_ = adaptor_->UPeriod();
  if (adaptor_->IsVPeriodic()) v_period_ = adaptor_->VPeriod();
  recognize();
  measure_scale();
}

Vector3 vector_area(const std::vector<Vector3>& loop) {
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    area += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
  return area;
}

FaceSurface FaceSurface::seen_from_above(const CadFace& face, const std::vector<Vector3>& loop) {
  constexpr double least_cosine = 0.17;  // 80 degrees
  FaceSurface surface(face);
  auto view = std::make_unique<View>();
  const Vector3 area = vector_area(loop);
  view->origin = Vector3::Zero();
  for (const Vector3& p : loop) view->origin += p / static_cast<double>(loop.size());
  if (!(area.norm() > 0)) throw failure("", "the loop encloses no area");
  view->normal = area.normalized();
  // The parametric curves may be wrong, and with them the face's bounds: use those of the surface.
  const Vector2 span = surface.high_ - surface.low_;
  view->least_uv = surface.low_ - span;
  view->greatest_uv = surface.high_ + span;
  const Handle(Geom_Surface) geometry = BRep_Tool::Surface(face.face);
  Vector2 first, last;
  geometry->Bounds(first.x(), last.x(), first.y(), last.y());
  for (int k = 0; k < 2; ++k) {
    if (k == 0 ? surface.u_periodic() : surface.v_periodic()) continue;
    if (!Precision::IsInfinite(first[k])) view->least_uv[k] = first[k];
    if (!Precision::IsInfinite(last[k])) view->greatest_uv[k] = last[k];
  }
  // Orient the plane's normal to the side that most of the surface shows.
  std::vector<std::pair<Vector2, SurfacePoint>> samples;
  int towards = 0;
  for (int i = 0; i < View::across * View::across; ++i) {
    const Vector2 t(i % View::across, i / View::across);
    const Vector2 uv = surface.low_ + t.cwiseProduct(surface.high_ - surface.low_) / (View::across - 1);
    const SurfacePoint at = surface.evaluate(uv);
    towards += at.du.cross(at.dv).dot(view->normal) > 0 ? 1 : -1;
    samples.emplace_back(uv, at);
  }
  if (towards < 0) view->normal *= -1;
  view->x = view->normal.unitOrthogonal();
  view->y = view->normal.cross(view->x);
  for (const auto& [uv, at] : samples) {
    const Vector3 normal = at.du.cross(at.dv);
    if (!(normal.dot(view->normal) > least_cosine * normal.norm())) continue;
    view->uv.push_back(uv);
    view->xy.push_back(view->at(at.point));
  }
  if (view->uv.empty()) throw failure("", "the surface turns away from the plane of its boundary");
  view->fill_buckets();
  surface.view_ = std::move(view);
  for (const Vector3& p : loop) {
    const Vector2 xy = surface.view_->at(p);
    const SurfacePoint at = surface.evaluate_view(xy);
    const Vector3 normal = at.du.cross(at.dv);
    if (!((surface.view_->at(at.point) - xy).norm() < 1e-3 * std::sqrt(area.norm())) ||
        !(normal.dot(surface.view_->normal) > least_cosine * normal.norm())) {
      throw failure("", "the surface turns away from the plane of its boundary");
    }
  }
  surface.u_period_ = surface.v_period_ = 0;
  surface.mean_scale_ = {1, 1};
  return surface;
}

Vector2 FaceSurface::seen_at(const Vector3& point) const {
  return view_->at(point);
}

/// Newton's method in the surface's parameters, on the projection of its points onto the plane.
SurfacePoint FaceSurface::evaluate_view(const Vector2& xy) const {
  constexpr int max_iterations = 20;
  Vector2 uv = view_->uv[view_->nearest(xy)];
  SurfacePoint best{}, at{};
  double least = std::numeric_limits<double>::infinity();
  Eigen::Matrix2d seen, best_seen = Eigen::Matrix2d::Identity();
  for (int i = 0; i < max_iterations; ++i) {
    at = evaluate_own(uv);
    seen << at.du.dot(view_->x), at.dv.dot(view_->x), at.du.dot(view_->y), at.dv.dot(view_->y);
    const Vector2 off = xy - view_->at(at.point);
    if (!(off.norm() < least)) break;
    least = off.norm();
    best = at;
    best_seen = seen;
    if (std::abs(seen.determinant()) < 1e-14 * seen.squaredNorm() || least == 0) break;
    uv = (uv + seen.inverse() * off).cwiseMax(view_->least_uv).cwiseMin(view_->greatest_uv);
  }
  if (std::abs(best_seen.determinant()) > 1e-14 * best_seen.squaredNorm()) {
    const Eigen::Matrix2d inverse = best_seen.inverse();
    const Vector3 du = best.du, dv = best.dv;
    best.du = inverse(0, 0) * du + inverse(1, 0) * dv;
    best.dv = inverse(0, 1) * du + inverse(1, 1) * dv;
  }
  return best;
}

FaceSurface::~FaceSurface() = default;
FaceSurface::FaceSurface(FaceSurface&&) noexcept = default;

double FaceSurface::distance_at_least(const Vector3& point) const {
  if (kind_ == Kind::other) return 0;  // without a frame
  const Vector3 from = point - origin_;
  const double height = from.dot(z_), beside = std::hypot(from.dot(x_), from.dot(y_));
  if (kind_ == Kind::plane) return std::abs(height);
  if (kind_ == Kind::cylinder) return std::abs(beside - radius_);
  if (kind_ == Kind::sphere) return std::abs(from.norm() - radius_);
  if (kind_ == Kind::torus) return std::abs(std::hypot(beside - radius_, height) - minor_radius_);
  // Both nappes of a cone.
  const double near = (beside - radius_) * cos_angle_ - height * sin_angle_;
  const double far = (-beside - radius_) * cos_angle_ - height * sin_angle_;
  return std::min(std::abs(near), std::abs(far));
}

void FaceSurface::recognize() {
  gp_Ax3 frame;
  switch (adaptor_->GetType()) {
    case GeomAbs_Plane:
      kind_ = Kind::plane;
      frame = adaptor_->Plane().Position();
      break;
    case GeomAbs_Cylinder:
      kind_ = Kind::cylinder;
      frame = adaptor_->Cylinder().Position();
      radius_ = adaptor_->Cylinder().Radius();
      break;
    case GeomAbs_Cone:
      kind_ = Kind::cone;
      frame = adaptor_->Cone().Position();
      radius_ = adaptor_->Cone().RefRadius();
      sin_angle_ = std::sin(adaptor_->Cone().SemiAngle());
      cos_angle_ = std::cos(adaptor_->Cone().SemiAngle());
      break;
    case GeomAbs_Sphere:
      kind_ = Kind::sphere;
      frame = adaptor_->Sphere().Position();
      radius_ = adaptor_->Sphere().Radius();
      break;
    case GeomAbs_Torus:
      kind_ = Kind::torus;
      frame = adaptor_->Torus().Position();
      radius_ = adaptor_->Torus().MajorRadius();
      minor_radius_ = adaptor_->Torus().MinorRadius();
      break;
    default:
      return;
  }
  origin_ = to_vector(frame.Location());
  x_ = to_vector(frame.XDirection());
  y_ = to_vector(frame.YDirection());
  z_ = to_vector(frame.Direction());
  // A scaled placement changes the parametrization, so use the formulas only where they agree with
  // OpenCASCADE.
  const double tolerance = 1e-9 * (1 + (to_vector(adaptor_->Value(low_.x(), low_.y())).norm() + radius_));
  for (const Vector2& uv : {low_, high_, Vector2(0.7 * low_ + 0.3 * high_)}) {
    const SurfacePoint mine = evaluate_elementary(uv), theirs = evaluate_other(uv);
    if ((mine.point - theirs.point).norm() > tolerance) kind_ = Kind::other;
  }
}

SurfacePoint FaceSurface::evaluate(const Vector2& uv) const {
  return view_ ? evaluate_view(uv) : evaluate_own(uv);
}

SurfacePoint FaceSurface::evaluate_own(const Vector2& uv) const {
  return kind_ == Kind::other ? evaluate_other(uv) : evaluate_elementary(uv);
}

double FaceSurface::radius_at(double v) const {
  if (kind_ == Kind::cone) return radius_ + v * sin_angle_;
  return kind_ == Kind::torus ? radius_ + minor_radius_ * std::cos(v) : radius_;
}

SurfacePoint FaceSurface::evaluate_elementary(const Vector2& uv) const {
  if (kind_ == Kind::plane) return {origin_ + uv.x() * x_ + uv.y() * y_, x_, y_};
  const double cos_u = std::cos(uv.x()), sin_u = std::sin(uv.x());
  const Vector3 radial = cos_u * x_ + sin_u * y_, around = -sin_u * x_ + cos_u * y_;
  if (kind_ == Kind::cylinder) return {origin_ + radius_ * radial + uv.y() * z_, radius_ * around, z_};
  if (kind_ == Kind::cone) {
    const double r = radius_at(uv.y());
    return {origin_ + r * radial + uv.y() * cos_angle_ * z_, r * around,
            sin_angle_ * radial + cos_angle_ * z_};
  }
  const double cos_v = std::cos(uv.y()), sin_v = std::sin(uv.y());
  const double tube = kind_ == Kind::torus ? minor_radius_ : radius_;
  const double r = kind_ == Kind::torus ? radius_ + minor_radius_ * cos_v : radius_ * cos_v;
  return {origin_ + r * radial + tube * sin_v * z_, r * around, tube * (-sin_v * radial + cos_v * z_)};
}

SurfacePoint FaceSurface::evaluate_other(const Vector2& uv) const {
  if (!uv.allFinite())
    return {Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), Vector3::Zero(), Vector3::Zero()};
  gp_Pnt p;
  gp_Vec du, dv;
  adaptor_->D1(uv.x(), uv.y(), p, du, dv);
  return {to_vector(p), to_vector(du), to_vector(dv)};
}

Vector3 FaceSurface::normal(const SurfacePoint& at, const Vector2& uv) const {
  const Vector3 n = at.du.cross(at.dv);
  const double length = n.norm();
  const double scale = (mean_scale_.x() * mean_scale_.y());
  if (length > 1e-7 * scale) return n / length;
  if (view_) return view_->normal;
  const Vector2 middle = 0.5 * (low_ + high_);
  for (const double nudge : {1e-4, 1e-3, 1e-2, 1e-1}) {
    const SurfacePoint near = evaluate(uv + nudge * (middle - uv));
    const Vector3 m = near.du.cross(near.dv);
    if (m.norm() > 1e-7 * scale) return m.normalized();
  }
  return Vector3::UnitZ();
}

double FaceSurface::max_curvature(const Vector2& uv) const {
  const auto around = [&](double cosine) {
    return std::abs(cosine) / std::max(std::abs(radius_at(uv.y())), 1e-12);
  };
  if (kind_ == Kind::plane) return 0;
  if (kind_ == Kind::cylinder || kind_ == Kind::sphere) return 1 / radius_;
  if (kind_ == Kind::cone) return around(cos_angle_);
  if (kind_ == Kind::torus) return std::max(1 / minor_radius_, around(std::cos(uv.y())));
  gp_Pnt p;
  gp_Vec du, dv, duu, dvv, duv;
  adaptor_->D2(uv.x(), uv.y(), p, du, dv, duu, dvv, duv);
  const double e = du.Dot(du), f = du.Dot(dv), g = dv.Dot(dv);
  const double area2 = e * g - f * f;
  if (!(area2 > 1e-14 * mean_scale_.squaredNorm() * mean_scale_.squaredNorm())) return 0;
  const gp_Vec n = du.Crossed(dv) / std::sqrt(area2);
  const double l = duu.Dot(n), m = duv.Dot(n), k = dvv.Dot(n);
  const double mean = (e * k - 2 * f * m + g * l) / (2 * area2);
  const double gauss = (l * k - m * m) / area2;
  return std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - gauss));
}

Vector2 FaceSurface::parameter_step(const SurfacePoint& at, const Vector3& displacement) {
  const double e = at.du.squaredNorm(), f = at.du.dot(at.dv), g = at.dv.squaredNorm();
  const double a = at.du.dot(displacement), b = at.dv.dot(displacement);
  const double determinant = e * g - f * f;
  if (determinant > 1e-10 * e * g) return {(g * a - f * b) / determinant, (e * b - f * a) / determinant};
  // Singular: move only along the longer derivative.
  if (e > g) return {e > 0 ? a / e : 0, 0};
  return {0, g > 0 ? b / g : 0};
}

Vector2 FaceSurface::clamp(Vector2 uv) const {
  if (!u_periodic()) uv.x() = std::clamp(uv.x(), low_.x(), high_.x());
  if (!v_periodic()) uv.y() = std::clamp(uv.y(), low_.y(), high_.y());
  return uv;
}

Vector2 FaceSurface::step_towards(const Vector2& uv, const SurfacePoint& at, const Vector3& target) const {
  Vector2 step = parameter_step(at, target - at.point);
  // Near a pole, steps around it can become arbitrarily long.
  if (u_periodic()) step.x() = std::clamp(step.x(), -0.5 * u_period_, 0.5 * u_period_);
  if (v_periodic()) step.y() = std::clamp(step.y(), -0.5 * v_period_, 0.5 * v_period_);
  return clamp(uv + step);
}

/// Exact closest point on an elementary surface.
Vector2 FaceSurface::inverse(const Vector2& near, const Vector3& target) const {
  const Vector3 d = target - origin_;
  const double x = d.dot(x_), y = d.dot(y_), z = d.dot(z_);
  if (kind_ == Kind::plane) return {x, y};
  double r = std::hypot(x, y);
  double u = r > 1e-12 * (radius_ + std::abs(z)) ? std::atan2(y, x) : near.x();
  const double pi = M_PI;
  // Beyond the apex of a cone, and beyond the axis of a torus that meets its axis, the radius is negative:
  // the same point then has u shifted by half a turn.
  if (radius_at(near.y()) < 0) {
    r = -r;
    u += pi;
  }
  u = nearest_period(u, near.x(), 2 * pi);
  if (kind_ == Kind::cylinder) return {u, z};
  if (kind_ == Kind::cone) return {u, (r - radius_) * sin_angle_ + z * cos_angle_};
  if (kind_ == Kind::sphere) return {u, std::atan2(z, r)};
  return {u, nearest_period(std::atan2(z, r - radius_), near.y(), 2 * pi)};
}

SurfacePoint FaceSurface::move(Vector2& uv, const Vector3& target) const {
  if (view_) {
    uv = view_->at(target);
    return evaluate_view(uv);
  }
  if (kind_ != Kind::other) {
    uv = clamp(inverse(uv, target));
    return evaluate_elementary(uv);
  }
  const SurfacePoint from = evaluate_other(uv);
  uv = step_towards(uv, from, target);
  return evaluate_other(uv);
}

SurfacePoint FaceSurface::project(Vector2& uv, const Vector3& target) const {
  if (view_ || kind_ != Kind::other) return move(uv, target);
  constexpr int max_iterations = 10;
  SurfacePoint at = evaluate_other(uv);
  for (int i = 0; i < max_iterations; ++i) {
    const Vector2 next = step_towards(uv, at, target);
    const SurfacePoint candidate = evaluate_other(next);
    if ((candidate.point - target).norm() > (at.point - target).norm() * (1 + 1e-12)) break;
    const double moved = (candidate.point - at.point).norm();
    uv = next;
    at = candidate;
    if (moved < 1e-10 * mean_scale_.norm() * (high_ - low_).norm()) break;
  }
  return at;
}

void FaceSurface::measure_scale() {
  constexpr int n = 4;
  Vector2 sum(0, 0);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vector2 t((i + 0.5) / n, (j + 0.5) / n);
      const SurfacePoint at = evaluate(low_ + t.cwiseProduct(high_ - low_));
      sum += Vector2(at.du.norm(), at.dv.norm());
    }
  }
  mean_scale_ = sum / (n * n);
  constexpr double no_width = 1e-12;
  const Vector2 lengths = mean_scale_.cwiseProduct(high_ - low_);
  is_curve_ = !(lengths.minCoeff() > no_width * lengths.maxCoeff());
  for (int k = 0; k < 2; ++k) {
    if (!(mean_scale_[k] > 0) || !std::isfinite(mean_scale_[k])) mean_scale_[k] = 1;
  }
}

}  // namespace quadrille
