/// Exchanges along chains lower the cost and keep the coloring proper.

#include "mesher/pairing/kempe_chains.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "mesher/pairing/augmenting_paths.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// The coloring that exchanges start from.
CostedColoring colored_by_cost(const TriangleMesh& mesh) {
  CostedColoring coloring(mesh);
  coloring.compute_costs(mesh.points);
  color_by_cost(coloring);
  augment(coloring, free_triangles(coloring));
  return coloring;
}

double cost_of_pairs(const CostedColoring& coloring) {
  double cost = 0;
  for (int t = 0; t < coloring.size(); ++t)
    cost += coloring.free(t) ? 0 : 0.5 * coloring.cost_of(coloring.diagonal_of(t));
  return cost;
}

TEST(KempeChains, KeepTheColoringProperAndPairAll) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const TriangleMesh& mesh : {random_square(400, seed), random_with_holes(600, 4, seed)}) {
      CostedColoring coloring = colored_by_cost(mesh);
      EXPECT_EQ(validate(coloring), "");
      const std::size_t free = free_triangles(coloring).size();
      const double before = cost_of_pairs(coloring);
      ExecutionContext context;
      exchange_chains(coloring, mesh.points, context);
      EXPECT_EQ(validate(coloring), "");
      EXPECT_EQ(free_triangles(coloring).size(), free);
      EXPECT_NE(cost_of_pairs(coloring), before) << "nothing was exchanged";
    }
  }
}

TEST(KempeChains, LeavesTheTriangleFreeThatCostsLeast) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 0.8);
  for (const int n : {3, 7, 31, 101}) {
    TriangleMesh mesh = strip(n);
    for (Vector3& p : mesh.points) p.x() += place(random);
    CostedColoring coloring(mesh);
    coloring.compute_costs(mesh.points);
    const auto side_to = [&](int t, int other) {
      for (int i = 0; i < 3; ++i) {
        if (const Side twin = coloring.twin(make_side(t, i)); twin >= 0 && triangle_of(twin) == other)
          return make_side(t, i);
      }
      return -1;
    };
    // A strip of an odd number of triangles can do without any of those with even numbers.
    double least = std::numeric_limits<double>::infinity();
    for (int free = 0; free < n; free += 2) {
      double cost = 0;
      for (int t = 0; t < n; t += 2) {
        if (t == free) ++t;
        if (t < n) cost += coloring.cost_of(side_to(t, t + 1));
      }
      least = std::min(least, cost);
    }
    for (int t = 0; t + 1 < n; t += 2) coloring.pair(side_to(t, t + 1));
    move_free(coloring);
    EXPECT_EQ(validate(coloring), "");
    EXPECT_EQ(free_triangles(coloring).size(), 1U);
    EXPECT_NEAR(cost_of_pairs(coloring), least, 2e-3) << n;
  }
}

}  // namespace
}  // namespace quadrille
