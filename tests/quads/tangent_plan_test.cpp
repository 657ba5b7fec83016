/// Quads around a node in its tangent plane, beside the same measured in space.

#include "mesher/quads/tangent_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "mesher/mesh/quad_geometry.hpp"

namespace quadrille {
namespace {

/// A node and, for each quad around it, the three other corners, in a plane.
struct Fan {
  Vector3 origin, normal;
  std::vector<std::array<Vector3, 3>> quads;
};

/// \param n quads. Their corners are moved by up to `noise`.
Fan fan(int n, double noise, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  Fan result;
  result.origin = {any(random), any(random), any(random)};
  result.normal = Vector3(any(random), any(random), any(random)).normalized();
  const Vector3 u = result.normal.unitOrthogonal(), v = result.normal.cross(u);
  std::vector<Vector3> ring;
  for (int k = 0; k < 2 * n; ++k) {
    const double angle = M_PI * k / n, radius = (k % 2 == 0 ? 1 : 1.4) + noise * any(random);
    ring.push_back(result.origin + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  for (int k = 0; k < n; ++k)
    result.quads.push_back({ring[2 * k], ring[2 * k + 1], ring[(2 * k + 2) % (2 * n)]});
  return result;
}

TEST(TangentPlan, JudgesAsInSpace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.7, 0.7);
  int good = 0;
  for (int round = 0; round < 500; ++round) {
    const Fan around = fan(3 + round % 4, 0.3, random);
    TangentPlan plan(around.origin, around.normal);
    for (const auto& [b, c, d] : around.quads) ASSERT_TRUE(plan.add(b, c, d));
    const double x = shift(random), y = shift(random);
    const Vector3 place = plan.place(x, y);
    const auto [back_x, back_y] = plan.coordinates(place);
    EXPECT_NEAR(back_x, x, 1e-12);
    EXPECT_NEAR(back_y, y, 1e-12);
    std::vector<double> jacobians;
    for (const auto& [b, c, d] : around.quads)
      jacobians.push_back(folded_scaled_jacobian(place, b, c, d, around.normal));
    const double least = *std::min_element(jacobians.begin(), jacobians.end());
    EXPECT_FALSE(plan.fits(x, y, least + 1e-9));
    ASSERT_TRUE(plan.fits(x, y, least - 1e-9)) << least;
    for (int k = 0; k < plan.count(); ++k) EXPECT_NEAR(plan.quality(k), jacobians[k], 1e-9);
    good += least > 0;
  }
  EXPECT_GT(good, 50);
  EXPECT_LT(good, 450);  // folded ones were judged too
}

TEST(TangentPlan, TakesNoMoreQuadsThanItHasRoomFor) {
  std::mt19937 random(7);
  const Fan around = fan(4, 0, random);
  TangentPlan plan(around.origin, around.normal);
  const auto& [b, c, d] = around.quads[0];
  for (int k = 0; k < TangentPlan::max_quads; ++k) ASSERT_TRUE(plan.add(b, c, d));
  EXPECT_FALSE(plan.add(b, c, d));
}

}  // namespace
}  // namespace quadrille
