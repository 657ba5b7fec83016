#pragma once
/// Motions that keep all distances: translations, rotations about an axis, and both together (screws).

#include "geometry/base/vector.hpp"

namespace quadrille {

/// A rotation about an axis, then a translation along it; with no angle, a translation in any direction.
struct RigidMotion {
  Vector3 translation{0, 0, 0};  ///< along the axis if there is an angle, millimeters
  Vector3 center{0, 0, 0};       ///< the point of the axis that is nearest to the origin, millimeters
  Vector3 axis{0, 0, 1};         ///< unit vector, about which the rotation is counter-clockwise
  double angle = 0;              ///< radians, -pi to pi

  /// The rotation alone, as a matrix.
  Eigen::Matrix3d rotation() const { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }
  /// The matrix of the motion for homogeneous coordinates.
  Eigen::Matrix4d matrix() const {
    Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
    result.topLeftCorner<3, 3>() = rotation();
    result.topRightCorner<3, 1>() = (*this)(Vector3::Zero());
    return result;
  }
  /// Where a point goes.
  Vector3 operator()(const Vector3& point) const {
    if (angle == 0) return point + translation;
    return rotation() * (point - center) + center + translation;
  }
  /// The way back.
  RigidMotion inverse() const { return {-translation, center, axis, -angle}; }
};

}  // namespace quadrille
