#pragma once
/// Small vectors used throughout: lengths in the model's unit (millimeter for CAD files, as in FreeCAD).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace quadrille {

using Vector2 = Eigen::Vector2d;  ///< (2) in a plane
using Vector3 = Eigen::Vector3d;  ///< (3) in space, millimeters

/// The angle between two vectors of any length, 0 to pi; accurate for small angles too.
inline double angle_between(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace quadrille
