#pragma once
/// Small vectors used throughout: lengths in the model's unit (millimetre for CAD files, as in FreeCAD).

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace quadrille {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

}  // namespace quadrille
