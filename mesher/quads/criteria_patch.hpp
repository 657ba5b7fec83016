#pragma once
/// The objective of the last optimization: a smooth measure of how far quads are from the industry criteria.
/// Not part of the public interface.

#include <array>
#include <span>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// The objective of one quad.
struct QuadObjective {
  double value = 0;         ///< almost 0 for a square; about 1 where one criterion is at its limit; bounded
  double least_sine = 0;    ///< least sine of a corner: the scaled Jacobian; -1 for a quad that is not convex
  Vector3 normal{0, 0, 0};  ///< unit; zero for a quad without area
};

/// The sum over the criteria of (value / limit)^4: aspect / 5, sine of the skew / sine of 40 degrees, for
/// each corner the sine of its deviation from 90 degrees / sine of 50 degrees, taper at Gauss points / the
/// taper at which the Jacobian ratio is 0.6. Measured in the plane of the quad's diagonals.
/// \param squareness the weight of an added term: the squared cosines of the corners, the squared taper and a
/// little of the squared aspect. The fourth powers alone hardly act on corners 20 degrees off.
QuadObjective measure_objective(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                                double squareness = 0);

/// The objective of a quad of indices into points.
inline QuadObjective measure_objective(std::span<const Vector3> points, const std::array<int, 4>& quad) {
  return measure_objective(points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]);
}

/// A quad whose nodes move along two directions in a fixed plane.
class FlatQuad {
 public:
  /// Uses the plane of the quad's diagonals if that faces `up`, else the plane of u and v.
  /// \param u,v the directions
  FlatQuad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, const Vector3& up,
           const Vector3& u, const Vector3& v);
  /// Moves the corner by x u + y v.
  void move(int corner, double x, double y);
  /// The same as measure_objective() without squareness; the normal is zero.
  QuadObjective measure() const;
  /// The lengths of the two sides at a corner.
  std::array<double, 2> sides_at(int corner) const;

 private:
  friend class CriteriaPatch;
  std::array<double, 4> x_, y_;
  double ux_, uy_, vx_, vy_;  ///< the directions, in the plane
};

/// The quads around one node, each in its own plane, judged for several places of the node at once.
class CriteriaPatch {
 public:
  static constexpr int max_quads = 16;
  static constexpr int lanes = 8;
  using Lanes = std::array<double, lanes>;

  /// \param u,v the two directions in which the node can move; v is zero if there is only one.
  /// \param squareness as for measure_objective()
  CriteriaPatch(const Vector3& u, const Vector3& v, double squareness = 0)
      : u_(u), v_(v), squareness_(squareness) {}

  /// Adds the quad with the node at `a`. False if the patch is full or the quad has no area.
  /// \param weight of the quad's objective in evaluate()
  bool add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, double weight = 1);
  /// Adds a quad with the node at a corner. False if the patch is full.
  bool add(const FlatQuad& quad, int corner);

  /// The weighted sum of the objectives with the node moved by x u + y v; huge if a quad would not be convex.
  Lanes evaluate(const Lanes& x, const Lanes& y) const;

  /// The least scaled Jacobian with the node moved by x u + y v; -1 if a quad is not convex. A positive value
  /// is reduced if a side at the node is shorter than `short_side` times the mean of these sides.
  Lanes merits(const Lanes& x, const Lanes& y, double short_side) const;

  /// The best move (x, y) found by one step of Newton's method and by multiples of that step from 0.03 to
  /// 1.5. The derivatives are finite differences. \param shortest the shortest side at the node; differences
  /// are taken over a tenth of it. \param longest limit on the length of Newton's step
  std::array<double, 2> lowest(double shortest, double longest) const;

 private:
  struct Quad {
    double bx, by, cx, cy, dx, dy;  ///< relative to the node's present place
    double ux, uy, vx, vy;          ///< the directions
    double weight;                  ///< of the objective
  };
  Vector3 u_, v_;
  double squareness_;
  int count_ = 0;
  std::array<Quad, max_quads> quads_;
};

}  // namespace quadrille
