#pragma once
/// Polygons of straight sides, and all their fillings with quads.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "mesher/quads/polygon_filling.hpp"

namespace quadrille::testing {

using Quad = std::array<int, 4>;

struct Polygon {
  std::vector<Vector3> outline;
  std::vector<int> corners;
};

/// Corners on a circle, straight sides; two enclose a lens.
inline Polygon polygon(const std::vector<int>& sides) {
  Polygon result;
  const auto n = static_cast<double>(sides.size());
  const double bulge = sides.size() == 2 ? 1.2 : 0;
  const auto corner = [&](double i) {
    const double angle = 2 * std::numbers::pi * i / n;
    return Vector3(std::cos(angle), std::sin(angle), 0);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    result.corners.push_back(static_cast<int>(result.outline.size()));
    const Vector3 from = corner(static_cast<double>(i)), to = corner(static_cast<double>(i) + 1),
                  out = corner(static_cast<double>(i) + 0.5);
    for (int k = 0; k < sides[i]; ++k) {
      const double t = static_cast<double>(k) / sides[i];
      result.outline.push_back((1 - t) * from + t * to + bulge * t * (1 - t) * out);
    }
  }
  return result;
}

/// All fillings with at most so many irregular nodes.
inline std::vector<PolygonFilling> polygon_fillings(const std::vector<Vector3>& outline,
                                                    const std::vector<int>& corners, int irregular) {
  std::vector<PolygonFilling> result;
  EXPECT_FALSE(
      fill_polygon(outline, corners, {.most_irregular = irregular}, [&](const PolygonFilling& filling) {
        result.push_back(filling);
        return false;
      }));
  return result;
}

/// The number of quads at each node.
inline std::map<int, int> valences(const std::vector<Quad>& quads) {
  std::map<int, int> count;
  for (const Quad& quad : quads)
    for (const int node : quad) ++count[node];
  return count;
}

}  // namespace quadrille::testing
