#pragma once
/// Small vectors used throughout: lengths in the model's unit (millimeter for CAD files, as in FreeCAD).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace quadrille {

using Vector2 = Eigen::Vector2d;  ///< (2) in a plane
using Vector3 = Eigen::Vector3d;  ///< (3) in space, millimeters

/// The angle between two vectors of any length, 0 to pi; accurate for small angles too.
inline double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The place of the segment ab nearest to a point: the share of the way from a to b, from 0 to 1; 0 if they
/// are one point.
inline double nearest_share(const Vector3& a, const Vector3& b, const Vector3& point) {
  const Vector3 way = b - a;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp((point - a).dot(way) / square, 0.0, 1.0) : 0;
}

/// The distance of a point from the segment ab.
inline double distance_to_segment(const Vector3& point, const Vector3& a, const Vector3& b) {
  return (a + nearest_share(a, b, point) * (b - a) - point).norm();
}

}  // namespace quadrille
