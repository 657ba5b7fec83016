#pragma once
/// The quads round a node, flattened into the tangent plane at it; not part of the public interface.

#include <array>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Places of the node are judged in the plane, with a third of the arithmetic that space takes.
class TangentPlan {
 public:
  static constexpr int max_quads = 16;
  struct Corner {
    double bx, by, cx, cy, dx, dy;  ///< the next, opposite and previous corner of a quad, from the node
  };

  /// \param origin the node. \param normal unit, of the plane
  TangentPlan(const Vector3& origin, const Vector3& normal);

  /// Adds the quad of the node and b, c and d in its order. False where the plan is full.
  bool add(const Vector3& b, const Vector3& c, const Vector3& d);

  int count() const { return count_; }
  const Corner& corner(int quad) const { return corners_[quad]; }
  Vector3 place(double x, double y) const { return origin_ + x * u_ + y * v_; }
  /// Where a place lies in the plane.
  std::array<double, 2> coordinates(const Vector3& place) const;

  /// Whether all quads have a scaled Jacobian of `floor` and more with the node at (x, y).
  bool fits(double x, double y, double floor);
  /// Scaled Jacobian of a quad at the place that fits() judged last.
  double quality(int quad) const;

 private:
  Vector3 origin_, u_, v_;
  int count_ = 0;
  std::array<Corner, max_quads> corners_;
  std::array<double, max_quads> squares_;  ///< signed squares of the scaled Jacobians
};

}  // namespace quadrille
