#include "mesher/quads/tangent_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/quads/wider_registers.hpp"

namespace quadrille {
namespace {

constexpr double tiny = std::numeric_limits<double>::min();

/// The signed square of the least sine at the corners of a quad, the node at (x, y), and the squared length
/// of its first side. Squares need no roots.
struct CornerSines {
  double least, side2;

  CornerSines(const TangentPlan::Corner& at, double x, double y) {
    const double ux = at.bx - x, uy = at.by - y, vx = at.cx - at.bx, vy = at.cy - at.by;
    const double wx = at.dx - at.cx, wy = at.dy - at.cy, tx = x - at.dx, ty = y - at.dy;
    const double uu = ux * ux + uy * uy, vv = vx * vx + vy * vy, ww = wx * wx + wy * wy,
                 tt = tx * tx + ty * ty;
    const double tu = tx * uy - ty * ux, uv = ux * vy - uy * vx, vw = vx * wy - vy * wx,
                 wt = wx * ty - wy * tx;
    const auto square = [](double sine, double lengths) {
      return sine * std::abs(sine) / std::max(lengths, tiny);
    };
    least = std::min(std::min(square(tu, tt * uu), square(uv, uu * vv)),
                     std::min(square(vw, vv * ww), square(wt, ww * tt)));
    side2 = uu;
  }
};

double signed_root(double square) {
  return std::copysign(std::sqrt(std::abs(square)), square);
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
    const double least = CornerSines(corners_[i], x, y).least;
    if (least < bound) return false;
    squares_[i] = least;
  }
  return true;
}

double TangentPlan::quality(int quad) const {
  return signed_root(squares_[quad]);
}

QUADRILLE_FOR_WIDER_REGISTERS
TangentPlan::Lanes TangentPlan::merits(const Lanes& x, const Lanes& y, double short_side) const {
  Lanes least, shortest, sum{};
  least.fill(1);
  shortest.fill(std::numeric_limits<double>::max());
  for (int i = 0; i < count_; ++i)
    for (int k = 0; k < lanes; ++k) {
      const CornerSines sines(corners_[i], x[k], y[k]);
      least[k] = std::min(least[k], sines.least);
      shortest[k] = std::min(shortest[k], sines.side2);
      sum[k] += std::sqrt(sines.side2);
    }
  Lanes result;
  for (int k = 0; k < lanes; ++k) {
    const double share = std::sqrt(shortest[k]) * count_ / (short_side * sum[k] + tiny);
    const double root = signed_root(least[k]);
    result[k] = root > 0 ? root * std::min(1.0, share) : root;
  }
  return result;
}

}  // namespace quadrille
