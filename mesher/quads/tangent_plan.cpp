/// Projects the quads around a node and judges places for it by squared corner sines, without roots.

#include "mesher/quads/tangent_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrille {
namespace {

/// The signed square of the least corner sine of a quad with the node at (x, y). Squares need no roots.
double least_square(const TangentPlan::Corner& at, double x, double y) {
  const double ux = at.bx - x, uy = at.by - y, vx = at.cx - at.bx, vy = at.cy - at.by;
  const double wx = at.dx - at.cx, wy = at.dy - at.cy, tx = x - at.dx, ty = y - at.dy;
  const double uu = ux * ux + uy * uy, vv = vx * vx + vy * vy, ww = wx * wx + wy * wy, tt = tx * tx + ty * ty;
  const double tu = tx * uy - ty * ux, uv = ux * vy - uy * vx, vw = vx * wy - vy * wx, wt = wx * ty - wy * tx;
  const auto square = [](double sine, double lengths) {
    return sine * std::abs(sine) / std::max(lengths, std::numeric_limits<double>::min());
  };
  return std::min(std::min(square(tu, tt * uu), square(uv, uu * vv)),
                  std::min(square(vw, vv * ww), square(wt, ww * tt)));
}

}  // namespace

// Duff et al., Building an orthonormal basis, revisited (2017).
TangentPlan::TangentPlan(const Vector3& origin, const Vector3& normal) : origin_(origin) {
  const double sign = std::copysign(1.0, normal.z()), a = -1 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  u_ = {1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()};
  v_ = {b, sign + normal.y() * normal.y() * a, -normal.y()};
}

bool TangentPlan::add(const Vector3& b, const Vector3& c, const Vector3& d) {
  if (count_ == max_quads) return false;
  const auto [bx, by] = coordinates(b);
  const auto [cx, cy] = coordinates(c);
  const auto [dx, dy] = coordinates(d);
  corners_[count_++] = {bx, by, cx, cy, dx, dy};
  return true;
}

std::array<double, 2> TangentPlan::coordinates(const Vector3& place) const {
  const Vector3 shift = place - origin_;
  return {u_.dot(shift), v_.dot(shift)};
}

bool TangentPlan::fits(double x, double y, double floor) {
  const double bound = floor * std::abs(floor);
  for (int i = 0; i < count_; ++i) {
    const double least = least_square(corners_[i], x, y);
    if (least < bound) return false;
    squares_[i] = least;
  }
  return true;
}

double TangentPlan::quality(int quad) const {
  return std::copysign(std::sqrt(std::abs(squares_[quad])), squares_[quad]);
}

}  // namespace quadrille
