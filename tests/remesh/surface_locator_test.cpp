/// Nearest points on triangulated surfaces, beside a search over all triangles.

#include "mesher/remesh/surface_locator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace quadrille {
namespace {

/// The nearest point of a triangle, by its corners, its sides and its plane.
double distance_to(const std::array<Vector3, 3>& t, const Vector3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3 side = t[(k + 1) % 3] - t[k];
    const double along = std::clamp(side.dot(p - t[k]) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (t[k] + along * side - p).norm());
  }
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const Vector3 foot = p - normal.dot(p - t[0]) * normal;
  bool inside = true;
  for (int k = 0; k < 3; ++k) inside &= (t[(k + 1) % 3] - t[k]).cross(foot - t[k]).dot(normal) >= 0;
  return inside ? std::min(least, (foot - p).norm()) : least;
}

TEST(SurfaceLocator, FindsWhatASearchOverAllTrianglesFinds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  constexpr int triangles = 60, patch_count = 3;
  TriangleMesh surface;
  std::vector<int> patches;
  for (int t = 0; t < triangles; ++t) {
    const Vector3 middle(any(random), any(random), any(random));
    for (int k = 0; k < 3; ++k)
      surface.points.push_back(middle + 0.3 * Vector3(any(random), any(random), any(random)));
    surface.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    patches.push_back(t % patch_count);
  }
  const SurfaceLocator locator(surface, patches, patch_count);
  const auto corners = [&](int t) {
    const auto& [a, b, c] = surface.triangles[t];
    return std::array{surface.points[a], surface.points[b], surface.points[c]};
  };
  for (int round = 0; round < 300; ++round) {
    const Vector3 p = 2 * Vector3(any(random), any(random), any(random));
    const int patch = round % patch_count;
    double least = std::numeric_limits<double>::infinity();
    for (int t = patch; t < triangles; t += patch_count) least = std::min(least, distance_to(corners(t), p));
    const SurfaceLocator::Place found = locator.nearest(patch, p);
    EXPECT_NEAR((found.point - p).norm(), least, 1e-12);
    ASSERT_EQ(patches[found.triangle], patch);
    EXPECT_LT(distance_to(corners(found.triangle), found.point), 1e-12);
  }
}

}  // namespace
}  // namespace quadrille
