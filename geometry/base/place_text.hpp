#pragma once
/// Points as messages show them. Internal.

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// "(x, y, z)" with six digits. Coordinates that are rounding errors beside the others are 0.
inline std::string place_text(const Vector3& point) {
  constexpr double rounding = 1e-9;
  const double least = rounding * point.cwiseAbs().maxCoeff();
  const auto shown = [&](double x) { return std::abs(x) <= least ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", shown(point.x()), shown(point.y()), shown(point.z()));
}

}  // namespace quadrille
