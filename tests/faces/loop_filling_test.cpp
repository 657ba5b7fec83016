/// Loops in space and the triangles that span them.

#include "mesher/faces/loop_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace quadrille {
namespace {

std::vector<Vector3> circle(int n, double radius, double z) {
  std::vector<Vector3> points;
  points.reserve(n);
  for (int i = 0; i < n; ++i)
    points.emplace_back(radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n), z);
  return points;
}

/// The sides that one triangle has, in its direction.
std::map<std::pair<int, int>, int> open_sides(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      if (const auto back = sides.find({b, a}); back != sides.end())
        sides.erase(back);
      else
        ++sides[{a, b}];
    }
  }
  return sides;
}

double area(const std::vector<Vector3>& p, const std::vector<std::array<int, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  return sum;
}

TEST(LoopFilling, SpansALoopAlongItsDirection) {
  const std::vector<Vector3> points = circle(12, 1, 0);
  std::vector<int> loop(points.size());
  std::iota(loop.begin(), loop.end(), 0);
  for (const bool turned : {false, true}) {
    if (turned) std::reverse(loop.begin(), loop.end());
    const auto triangles = fill_loops(points, {loop}, true);
    EXPECT_EQ(triangles.size(), 10U);
    EXPECT_NEAR(area(points, triangles), 6 * std::sin(2 * M_PI / 12), 1e-9);
    const auto sides = open_sides(triangles);
    EXPECT_EQ(sides.size(), 12U);
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(sides.contains({loop[i], loop[(i + 1) % 12]}));
  }
}

TEST(LoopFilling, JoinsHolesByBridges) {
  std::vector<Vector3> points = circle(12, 2, 0);
  const std::vector<Vector3> inner = circle(8, 1, 0);
  points.insert(points.end(), inner.begin(), inner.end());
  std::vector<int> outer, hole;
  for (int i = 0; i < 12; ++i) outer.push_back(i);
  for (int i = 0; i < 8; ++i) hole.push_back(19 - i);
  const auto triangles = fill_loops(points, {outer, hole}, true);
  EXPECT_EQ(triangles.size(), 20U);
  EXPECT_EQ(open_sides(triangles).size(), 20U);
  EXPECT_NEAR(area(points, triangles), 24 * std::sin(2 * M_PI / 12) - 4 * std::sin(2 * M_PI / 8), 1e-9);
}

TEST(LoopFilling, FlipsTheLongSideOfAFlatTriangle) {
  const std::vector<Vector3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  flip_flat(points, {{0, 1}, {1, 2}, {2, 3}, {0, 3}}, triangles);
  EXPECT_NEAR(area(points, {triangles[0]}), 0.5, 1e-12);
  EXPECT_NEAR(area(points, {triangles[1]}), 0.5, 1e-12);
  EXPECT_EQ(open_sides(triangles).size(), 4U);
}

TEST(LoopFilling, RefusesWhatIsTooMuch) {
  std::vector<int> loop(3000);
  for (int i = 0; i < 3000; ++i) loop[i] = i;
  EXPECT_TRUE(fill_loops(circle(3000, 1, 0), {loop}, true).empty());
  EXPECT_TRUE(fill_loops({}, {}, true).empty());
}

}  // namespace
}  // namespace quadrille
