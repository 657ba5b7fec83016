#pragma once
/// Measured numbers, points and lists of faces as messages show them. Values that users gave are shown as
/// given. Internal.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// A value below this share of what it is compared with is a rounding error.
inline constexpr double rounding_share = 1e-9;

/// A number with four digits; 0 if it is a rounding error. \param like what it compares with; the default
/// suits lengths in millimeters, where a picometer is a rounding error, and ratios.
inline std::string number_text(double value, double like = 1e-3) {
  return fmt::format("{:.4g}", std::abs(value) <= rounding_share * std::abs(like) ? 0.0 : value);
}

/// "(x, y, z)" with six digits, since coordinates may be large beside the model. Those that are rounding
/// errors beside the others are 0.
inline std::string place_text(const Vector3& point) {
  const double least = rounding_share * point.cwiseAbs().maxCoeff();
  const auto shown = [&](double x) { return std::abs(x) <= least ? 0.0 : x; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", shown(point.x()), shown(point.y()), shown(point.z()));
}

/// "Face3, Face7": at most twelve names, and how many more there are.
inline std::string face_names(const std::vector<int>& numbers) {
  constexpr std::size_t names_shown = 12;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(names_shown, numbers.size()); ++i)
    names.push_back(fmt::format("Face{}", numbers[i]));
  if (numbers.size() > names_shown) names.push_back(fmt::format("{} more", numbers.size() - names_shown));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace quadrille
