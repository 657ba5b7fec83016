/// Starts Newton's method, with bounds and second derivatives, at the local minima of a grid of points.

#include "geometry/midsurface/closest_point.hpp"

#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Vec.hxx>

namespace quadrille {

namespace {

/// Parameters from one end to the other, with places between the knots.
std::vector<double> spread(const TColStd_Array1OfReal& knots) {
  constexpr int places = 16, min_parts = 2;
  const int intervals = knots.Length() - 1, parts = std::max(min_parts, (places + intervals - 1) / intervals);
  std::vector<double> result;
  for (int i = knots.Lower(); i < knots.Upper(); ++i) {
    for (int part = 0; part < parts; ++part)
      result.push_back(knots(i) + (knots(i + 1) - knots(i)) * part / parts);
  }
  result.push_back(knots.Last());
  return result;
}

}  // namespace

ClosestPoint::ClosestPoint(const TopoDS_Face& face) : search_(BRep_Tool::Surface(face)) {
  surface_.Load(search_.Surface());
  bounds_ = {surface_.FirstUParameter(), surface_.LastUParameter(), surface_.FirstVParameter(),
             surface_.LastVParameter()};
  const bool endless =
      std::any_of(bounds_.begin(), bounds_.end(), [](double bound) { return Precision::IsInfinite(bound); });
  if (surface_.GetType() < GeomAbs_BezierSurface || endless) return;
  TColStd_Array1OfReal us(1, surface_.NbUIntervals(GeomAbs_CN) + 1),
      vs(1, surface_.NbVIntervals(GeomAbs_CN) + 1);
  surface_.UIntervals(us, GeomAbs_CN);
  surface_.VIntervals(vs, GeomAbs_CN);
  values_ = {spread(us), spread(vs)};
}

void ClosestPoint::make_grid() {
  Bnd_Box box;
  for (const double u : values_[0]) {
    for (const double v : values_[1]) box.Add(grid_.emplace_back(surface_.Value(u, v)));
  }
  size_ = std::sqrt(box.SquareExtent());
  for (std::size_t i = 0; i + 1 < count(0); ++i) {
    for (std::size_t j = 0; j + 1 < count(1); ++j) {
      const std::size_t at = i * count(1) + j, opposite = at + count(1) + 1;
      spacing_ = std::max(
          {spacing_, grid_[at].Distance(grid_[opposite]), grid_[at + 1].Distance(grid_[opposite - 1])});
    }
  }
}

std::vector<ClosestPoint::Place> ClosestPoint::starts(const gp_Pnt& point) const {
  std::vector<double> distances(grid_.size());
  for (std::size_t i = 0; i < grid_.size(); ++i) distances[i] = grid_[i].SquareDistance(point);
  const double least = std::sqrt(*std::min_element(distances.begin(), distances.end()));
  // Each point of the surface is about half a cell or less from one of the grid.
  const double most = std::pow(least + spacing_, 2);
  const auto closer_than_around = [&](std::size_t i, std::size_t j) {
    const double own = distances[i * count(1) + j];
    for (std::size_t k = i > 0 ? i - 1 : 0; k < std::min(i + 2, count(0)); ++k) {
      for (std::size_t l = j > 0 ? j - 1 : 0; l < std::min(j + 2, count(1)); ++l)
        if (distances[k * count(1) + l] < own) return false;
    }
    return true;
  };
  std::vector<Place> result;
  for (std::size_t i = 0; i < count(0); ++i) {
    for (std::size_t j = 0; j < count(1); ++j) {
      const double distance = distances[i * count(1) + j];
      if (distance <= most && closer_than_around(i, j))
        result.push_back({{values_[0][i], values_[1][j]}, distance});
    }
  }
  return result;
}

std::optional<ClosestPoint::Step> ClosestPoint::step(const Place& at, const gp_Pnt& point) const {
  gp_Pnt there;
  gp_Vec du, dv, duu, dvv, duv;
  surface_.D2(at.uv[0], at.uv[1], there, du, dv, duu, dvv, duv);
  const gp_Vec off(point, there);
  const std::array<double, 2> slope{off.Dot(du), off.Dot(dv)};
  std::array<bool, 2> kept{};
  for (int i = 0; i < 2; ++i)
    kept[i] = slope[i] > 0 ? at.uv[i] <= bounds_[2 * i] : at.uv[i] >= bounds_[2 * i + 1];
  const double metric_u = du.SquareMagnitude(), metric_v = dv.SquareMagnitude(), metric_uv = du.Dot(dv);
  double a = metric_u + off.Dot(duu), b = metric_uv + off.Dot(duv), c = metric_v + off.Dot(dvv);
  constexpr double floor = 1e-3;  // over what it is without curvature: there the second derivatives mislead
  const double flat = metric_u * metric_v - metric_uv * metric_uv;
  if (!(flat > 1e-12 * metric_u * metric_v)) return std::nullopt;
  if (a < floor * metric_u || c < floor * metric_v || a * c - b * b < floor * flat) {
    a = metric_u;
    b = metric_uv;
    c = metric_v;
  }
  Step result;
  if (!kept[0] && !kept[1]) {
    const double determinant = a * c - b * b;
    result.by = {(b * slope[1] - c * slope[0]) / determinant, (b * slope[0] - a * slope[1]) / determinant};
  } else {
    result.by = {kept[0] ? 0 : -slope[0] / a, kept[1] ? 0 : -slope[1] / c};
  }
  result.length = (result.by[0] * du + result.by[1] * dv).Magnitude();
  return result;
}

std::optional<ClosestPoint::Place> ClosestPoint::descend(Place from, const gp_Pnt& point) const {
  constexpr int most_steps = 40;
  const double near = 1e-11 * size_;
  for (int i = 0; i < most_steps; ++i) {
    const auto next = step(from, point);
    if (!next) return std::nullopt;
    const bool last = next->length < near;
    Place to;
    double share = 1;
    for (;; share *= 0.5) {
      for (int j = 0; j < 2; ++j)
        to.uv[j] = std::clamp(from.uv[j] + share * next->by[j], bounds_[2 * j], bounds_[2 * j + 1]);
      to.distance = surface_.Value(to.uv[0], to.uv[1]).SquareDistance(point);
      if (to.distance <= from.distance || last) break;
      if (share * next->length < near) return from;  // no closer point within the precision
    }
    from = to;
    if (last) return from;
  }
  return std::nullopt;
}

gp_Pnt2d ClosestPoint::operator()(const gp_Pnt& point) {
  if (values_[0].empty()) return search_.ValueOfUV(point, Precision::Confusion());
  if (grid_.empty()) make_grid();
  std::optional<Place> best;
  for (const Place& start : starts(point)) {
    const auto found = descend(start, point);
    if (!found) {
      best.reset();
      break;
    }
    if (!best || found->distance < best->distance) best = found;
  }
  return best ? gp_Pnt2d(best->uv[0], best->uv[1]) : search_.ValueOfUV(point, Precision::Confusion());
}

}  // namespace quadrille
