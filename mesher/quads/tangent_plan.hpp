#pragma once
/// The quads around a node, flattened into its tangent plane; not part of the public interface.

#include <array>

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
  TangentPlan(const Vector3& origin, const Vector3& normal);

  /// Adds the quad of the node, b, c and d, in this order. False if the plan is full.
  bool add(const Vector3& b, const Vector3& c, const Vector3& d);

  int count() const { return count_; }
  const Corner& corner(int quad) const { return corners_[quad]; }
  Vector3 place(double x, double y) const { return origin_ + x * u_ + y * v_; }
  /// The coordinates of a place in the plane.
  std::array<double, 2> coordinates(const Vector3& place) const;

  /// Whether all quads have a scaled Jacobian of at least `floor` with the node at (x, y).
  bool fits(double x, double y, double floor);
  /// Scaled Jacobian of a quad with the node at the place that fits() accepted last.
  double quality(int quad) const;

 private:
  Vector3 origin_, u_, v_;
  int count_ = 0;
  std::array<Corner, max_quads> corners_;
  std::array<double, max_quads> squares_;  ///< signed squares of the scaled Jacobians
};

}  // namespace quadrille
