#pragma once
/// The quads around a node, flattened into its tangent plane; not part of the public interface.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Judges places of the node in the plane, which takes a third of the arithmetic needed in space.
class TangentPlan {
 public:
  static constexpr int max_quads = 16;
  struct Corner {
    double bx, by, cx, cy, dx, dy;  ///< next, opposite and previous corner of a quad, relative to the node
  };

  /// \param origin the node. \param normal unit normal of the plane
  /// Based on: Duff et al., Building an orthonormal basis, revisited (2017).
  TangentPlan(const Vector3& origin, const Vector3& normal) : origin_(origin) {
    const double sign = std::copysign(1.0, normal.z()), a = -1 / (sign + normal.z());
    const double b = normal.x() * normal.y() * a;
    u_ = {1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()};
    v_ = {b, sign + normal.y() * normal.y() * a, -normal.y()};
  }

  /// Adds the quad of the node, b, c and d, in this order. False if the plan is full.
  bool add(const Vector3& b, const Vector3& c, const Vector3& d) {
    if (count_ == max_quads) return false;
    const auto [bx, by] = coordinates(b);
    const auto [cx, cy] = coordinates(c);
    const auto [dx, dy] = coordinates(d);
    corners_[count_++] = {bx, by, cx, cy, dx, dy};
    return true;
  }

  int count() const { return count_; }
  const Corner& corner(int quad) const { return corners_[quad]; }
  Vector3 place(double x, double y) const { return origin_ + x * u_ + y * v_; }
  /// The coordinates of a place in the plane.
  std::array<double, 2> coordinates(const Vector3& place) const {
    const Vector3 shift = place - origin_;
    return {u_.dot(shift), v_.dot(shift)};
  }

  /// Whether all quads have a scaled Jacobian of at least `floor` with the node at (x, y).
  bool fits(double x, double y, double floor) {
    const double bound = floor * std::abs(floor);
    for (int i = 0; i < count_; ++i) {
      squares_[i] = least_square(corners_[i], x, y);
      if (squares_[i] < bound) return false;
    }
    return true;
  }
  /// Scaled Jacobian of a quad with the node at the place that fits() accepted last.
  double quality(int quad) const {
    return std::copysign(std::sqrt(std::abs(squares_[quad])), squares_[quad]);
  }

 private:
  /// The signed square of the least corner sine of a quad with the node at (x, y). Squares need no roots.
  static double least_square(const Corner& at, double x, double y) {
    const double ux = at.bx - x, uy = at.by - y, vx = at.cx - at.bx, vy = at.cy - at.by;
    const double wx = at.dx - at.cx, wy = at.dy - at.cy, tx = x - at.dx, ty = y - at.dy;
    const double uu = ux * ux + uy * uy, vv = vx * vx + vy * vy, ww = wx * wx + wy * wy,
                 tt = tx * tx + ty * ty;
    const double tu = tx * uy - ty * ux, uv = ux * vy - uy * vx, vw = vx * wy - vy * wx,
                 wt = wx * ty - wy * tx;
    const auto square = [](double sine, double lengths) {
      return sine * std::abs(sine) / std::max(lengths, std::numeric_limits<double>::min());
    };
    return std::min(std::min(square(tu, tt * uu), square(uv, uu * vv)),
                    std::min(square(vw, vv * ww), square(wt, ww * tt)));
  }

  Vector3 origin_, u_, v_;
  int count_ = 0;
  std::array<Corner, max_quads> corners_;
  std::array<double, max_quads> squares_;  ///< signed squares of the scaled Jacobians
};

}  // namespace quadrille
