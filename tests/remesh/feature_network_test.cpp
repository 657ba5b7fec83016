/// Where the features of a triangulated surface run, and where nodes go on them.

#include "mesher/remesh/feature_network.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace quadrille {
namespace {

/// A flat disk of n triangles, its rim a polygon.
TriangleMesh disk(
    int n, double radius, const std::function<double(int)>& factor = [](int) { return 1.0; }) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    mesh.points.emplace_back(radius * factor(k) * std::cos(angle), radius * factor(k) * std::sin(angle), 0);
    mesh.triangles.push_back({k, (k + 1) % n, n});
  }
  mesh.points.emplace_back(0, 0, 0);
  return mesh;
}

FeatureRules rules_of(double size, double angle = 40) {
  FeatureRules rules;
  rules.size = size;
  rules.angle = angle;
  return rules;
}

TEST(FeatureNetwork, ARoundRimHasNoCorner) {
  const FeatureNetwork network = find_features(disk(48, 10), rules_of(1));
  ASSERT_EQ(network.curves.size(), 1u);
  EXPECT_TRUE(network.curves[0].closed());
  EXPECT_EQ(network.curves[0].points.size(), 49u);
  EXPECT_EQ(std::accumulate(network.corner.begin(), network.corner.end(), 0), 0);
}

TEST(FeatureNetwork, ASquareRimHasFour) {
  const FeatureNetwork network = find_features(disk(4, 10), rules_of(1));
  EXPECT_EQ(network.curves.size(), 4u);
  EXPECT_EQ(std::accumulate(network.corner.begin(), network.corner.end(), 0), 4);
}

TEST(FeatureNetwork, JagsFarBelowTheSizeAreNoCorners) {
  // They turn by more than 90 degrees at every point.
  const TriangleMesh jagged = disk(600, 10, [](int k) { return k % 2 == 0 ? 1.0 : 1.01; });
  EXPECT_EQ(find_features(jagged, rules_of(2)).curves.size(), 1u);
  EXPECT_GT(find_features(jagged, rules_of(0.01)).curves.size(), 500u);
}

TEST(FeatureNetwork, NodesOfACircleTurnBySixtyDegreesAtMost) {
  const FeatureNetwork network = find_features(disk(96, 10), rules_of(50));
  const auto nodes = place_on_curves(network, {100});
  ASSERT_EQ(nodes.size(), 1u);
  EXPECT_GE(nodes[0].size(), 7u);  // both ends are told
  EXPECT_LE(nodes[0].size(), 12u);
  EXPECT_EQ(nodes[0].front(), 0);
  EXPECT_NEAR(nodes[0].back(), network.curves[0].length(), 1e-9);
}

TEST(FeatureNetwork, NodesAreAsFarApartAsAskedFor) {
  const FeatureNetwork network = find_features(disk(4, 10), rules_of(1));
  for (const auto& nodes : place_on_curves(network, std::vector<double>(4, 2.0))) {
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      EXPECT_GT(nodes[k] - nodes[k - 1], 1.7);
      EXPECT_LT(nodes[k] - nodes[k - 1], 2.3);
    }
  }
}

TEST(FeatureNetwork, SpacingGrowsFromShortCurves) {
  // Two curves that meet, the first with nodes ten times as near.
  const FeatureNetwork network = find_features(disk(4, 100), rules_of(1));
  const auto nodes = place_on_curves(network, {1, 10, 10, 10});
  double last = 1;
  const auto& next = nodes[1];
  const bool starts_there = network.curves[1].points.front() == network.curves[0].points.front() ||
                            network.curves[1].points.front() == network.curves[0].points.back();
  std::vector<double> steps;
  for (std::size_t k = 1; k < next.size(); ++k) steps.push_back(next[k] - next[k - 1]);
  if (!starts_there) std::reverse(steps.begin(), steps.end());
  EXPECT_LT(steps.front(), 2);
  for (const double step : steps) {
    EXPECT_LT(step, 1.5 * last + 0.5);
    last = step;
  }
}

TEST(FeatureNetwork, SmallFoldedFacesGoToANeighbor) {
  // A spike of three triangles on a plate, far smaller than the elements.
  TriangleMesh mesh;
  mesh.points = {{-10, -10, 0},  {10, -10, 0}, {0, 10, 0}, {-0.1, -0.1, 0},
                 {0.1, -0.1, 0}, {0, 0.1, 0},  {0, 0, 0.2}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3},
                    {2, 3, 5}, {3, 4, 6}, {4, 5, 6}, {5, 3, 6}};
  EXPECT_EQ(find_features(mesh, rules_of(4)).patch_count, 1);
  EXPECT_EQ(find_features(mesh, rules_of(0.1)).patch_count, 4);
}

}  // namespace
}  // namespace quadrille
