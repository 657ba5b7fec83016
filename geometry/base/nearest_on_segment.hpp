#pragma once
/// The place of a straight segment that is nearest to a point. Internal.

#include <algorithm>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// The share of the way from a to b, from 0 to 1; 0 if they are one point.
inline double nearest_share(const Vector3& a, const Vector3& b, const Vector3& point) {
  const Vector3 way = b - a;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(way) / square, 0.0, 1.0) : 0;
}

inline double distance_to_segment(const Vector3& point, const Vector3& a, const Vector3& b) {
  return (a + nearest_share(a, b, point) * (b - a) - point).norm();
}

}  // namespace quadrille
