/// What a pair of triangles costs, and which edges get the removed color by that.

#include "mesher/pairing/costed_coloring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/coloring_checks.hpp"

namespace quadrille {
namespace {

using testing::validate;

/// The coloring of two triangles (0, 1, 2) and (0, 2, 3), with costs.
CostedColoring pair_of(const std::array<Vector3, 4>& corners) {
  TriangleMesh mesh;
  mesh.points.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  CostedColoring coloring(mesh);
  coloring.compute_costs(mesh.points);
  return coloring;
}

float cost_of(const std::array<Vector3, 4>& corners) {
  return pair_of(corners).cost_of(make_side(0, 2));
}

TEST(CostedColoring, RectanglesCostNothingAndConcaveQuadsMost) {
  const double height = std::sqrt(0.75);
  EXPECT_NEAR(cost_of({{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}}), 0, 1e-4);
  const float rhomb = cost_of({{{0, 0, 0}, {0.5, -height, 0}, {1, 0, 0}, {0.5, height, 0}}});
  EXPECT_GT(rhomb, 0.2);
  EXPECT_LT(rhomb, 0.4);
  EXPECT_GT(cost_of({{{0, 0, 0}, {0.5, -0.2, 0}, {2, 0, 0}, {-1, 0.1, 0}}}), 2);
  const float folded = cost_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0.7}}});
  EXPECT_GT(folded, cost_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}) + 1);
}

/// Three squares in a row, each cut in two: the cuts are the cheapest edges, and what they leave is no
/// choice.
TEST(CostedColoring, GivesTheRemovedColorToTheCheapestEdges) {
  TriangleMesh mesh;
  for (int i = 0; i < 4; ++i) {
    mesh.points.emplace_back(i, 0, 0);
    mesh.points.emplace_back(i, 1, 0);
  }
  for (int i = 0; i < 3; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  CostedColoring coloring(mesh);
  coloring.compute_costs(mesh.points);
  color_by_cost(coloring);
  for (int t = 0; t < coloring.size(); ++t) EXPECT_EQ(coloring.mate_of(t), t ^ 1) << t;
  EXPECT_EQ(validate(coloring), "");
}

TEST(CostedColoring, AFlipJoinsTheOtherCorners) {
  const std::array<Vector3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  CostedColoring coloring = pair_of(corners);
  coloring.pair(make_side(0, 2));
  coloring.flip(make_side(0, 2), {corners.begin(), corners.end()});
  const Side side = coloring.diagonal_of(0);
  EXPECT_EQ(std::set<int>({coloring.corner_at(side), coloring.end_of(side)}), std::set<int>({1, 3}));
  EXPECT_EQ(coloring.mate_of(0), 1);
  EXPECT_NEAR(coloring.cost_of(side), 0, 1e-4);
}

}  // namespace
}  // namespace quadrille
