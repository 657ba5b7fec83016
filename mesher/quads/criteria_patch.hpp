#pragma once
/// What the last optimization lowers: how far quads are from the criteria of industry, as a smooth number.
/// Not part of the public interface.

#include <array>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Of one quad.
struct QuadObjective {
  double value = 0;         ///< 0 for a square; about 1 where one criterion is at its limit; bounded
  double least_sine = 0;    ///< of its corners, signed: the scaled Jacobian
  Vector3 normal{0, 0, 0};  ///< unit; zero for a quad without area
};

/// The sum over the criteria of (value / limit)^4: aspect / 5, sine of the skew / sine of 40 degrees, for
/// each corner the sine of its deviation from 90 degrees / sine of 50 degrees, taper at Gauss points / the
/// taper at which the Jacobian ratio is 0.6. In the plane of the quad's mean normal.
/// \param squareness the weight of the squared cosines of the corners, of the taper and a little of the
/// aspect, which are added: the fourth powers alone leave corners 20 degrees from right angles as they are.
QuadObjective measure_objective(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                                double squareness = 0);

/// A quad whose nodes move along two directions, in a plane that stays.
class FlatQuad {
 public:
  /// In the plane of the quad's diagonals, unless that does not face `up`. \param u,v the directions
  FlatQuad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, const Vector3& up,
           const Vector3& u, const Vector3& v);
  /// Moves the corner by x u + y v.
  void move(int corner, double x, double y);
  /// As measure_objective(), without the normal.
  QuadObjective measure() const;
  /// Lengths of the two sides at a corner.
  std::array<double, 2> sides_at(int corner) const;

 private:
  friend class CriteriaPatch;
  std::array<double, 4> x_, y_;
  double ux_, uy_, vx_, vy_;  ///< the directions
};

/// The quads round one node, each in its own plane, judged for several places of the node at once.
class CriteriaPatch {
 public:
  static constexpr int max_quads = 16;
  static constexpr int lanes = 8;
  using Lanes = std::array<double, lanes>;

  /// \param u,v the two directions that the node can move in; v is zero where it has one only.
  /// \param squareness as for measure_objective()
  CriteriaPatch(const Vector3& u, const Vector3& v, double squareness = 0)
      : u_(u), v_(v), squareness_(squareness) {}

  /// Adds the quad with the node at `a`. False where the patch is full or the quad has no area.
  bool add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);
  /// Adds a quad with the node at a corner. False where the patch is full.
  bool add(const FlatQuad& quad, int corner);

  /// The sum of the objectives with the node moved by x u + y v; huge where a quad would not be convex.
  Lanes evaluate(const Lanes& x, const Lanes& y) const;

  /// With the node moved so: the least scaled Jacobian, negative where a quad is folded; where positive, less
  /// if a side at the node is shorter than `short_side` times their mean.
  Lanes merits(const Lanes& x, const Lanes& y, double short_side) const;

  /// The best move (x, y) found by a step of Newton's method, whose derivatives are differences over places
  /// that are judged together, and by shares of that step. \param shortest side at the node: derivatives are
  /// taken over a tenth of it. \param longest step
  std::array<double, 2> lowest(double shortest, double longest) const;

 private:
  struct Quad {
    double bx, by, cx, cy, dx, dy;  ///< from the node's present place
    double ux, uy, vx, vy;          ///< the directions
  };
  Vector3 u_, v_;
  double squareness_;
  int count_ = 0;
  std::array<Quad, max_quads> quads_;
};

}  // namespace quadrille
