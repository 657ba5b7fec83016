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
CostedColoring colored_by_cost(const TriangleMesh& mesh, Objective objective = Objective::regular) {
  CostedColoring coloring(mesh);
  coloring.compute_costs(mesh.points, objective);
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

/// The cycles of edges without the removed color that have an odd number of them.
int count_odd_cycles(const EdgeColoring& coloring) {
  std::vector<char> seen(coloring.size(), 0);
  int odd = 0;
  for (int start = 0; start < coloring.size(); ++start) {
    if (seen[start]) continue;
    int length = 0;
    Side side = next_side(coloring.diagonal_of(start));
    for (;;) {
      seen[triangle_of(side)] = 1;
      ++length;
      const Side across = coloring.twin(side);
      if (across < 0) break;  // a path
      const int t = triangle_of(across);
      const Side diagonal = coloring.diagonal_of(t);
      side = next_side(diagonal) == across ? previous_side(diagonal) : next_side(diagonal);
      if (t == start) {
        odd += length % 2;
        break;
      }
    }
  }
  return odd;
}

TEST(KempeChains, KeepTheColoringProperAndPairAll) {
  int blanks = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const TriangleMesh& mesh : {random_square(400, seed), random_with_holes(600, 4, seed)}) {
      for (const Objective objective : {Objective::regular, Objective::shape}) {
        CostedColoring coloring = colored_by_cost(mesh, objective);
        EXPECT_EQ(validate(coloring), "");
        const std::size_t free = free_triangles(coloring).size();
        ExecutionContext context;
        exchange_chains(coloring, mesh.points, context);
        EXPECT_EQ(validate(coloring), "");
        EXPECT_EQ(free_triangles(coloring).size(), free);
        blanks += count_blanks(coloring);
      }
    }
  }
  EXPECT_GT(blanks, 0) << "no sample has an odd cycle";
}

TEST(KempeChains, TheOtherColorsLeaveABlankInOddCyclesAlone) {
  int odd = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const TriangleMesh& mesh :
         {random_square(400, seed), random_with_holes(600, 4, seed), icosphere(3)}) {
      CostedColoring coloring = colored_by_cost(mesh);
      if (!free_triangles(coloring).empty()) continue;
      complete(coloring);
      EXPECT_EQ(validate(coloring), "");
      EXPECT_EQ(count_blanks(coloring), count_odd_cycles(coloring));
      odd += count_odd_cycles(coloring);
    }
  }
  EXPECT_GT(odd, 0);
}

TEST(KempeChains, AreExchangedWholeWhereNoPartOfThemGains) {
  // A ring of squares paired across their common sides has one chain, all the way round.
  const TriangleMesh mesh = band(60);
  CostedColoring coloring(mesh);
  coloring.compute_costs(mesh.points, Objective::regular);
  for (int t = 1; t < coloring.size(); t += 2) coloring.pair(make_side(t, 1));
  ASSERT_TRUE(free_triangles(coloring).empty());
  const double before = cost_of_pairs(coloring);
  ExecutionContext context;
  exchange_chains(coloring, mesh.points, context);
  EXPECT_EQ(validate(coloring), "");
  EXPECT_TRUE(free_triangles(coloring).empty());
  EXPECT_LT(cost_of_pairs(coloring), 0.5 * before);
}

TEST(KempeChains, LeavesTheTriangleFreeThatCostsLeast) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 0.8);
  for (const int n : {3, 7, 31, 101}) {
    TriangleMesh mesh = strip(n);
    for (Vector3& p : mesh.points) p.x() += place(random);
    CostedColoring coloring(mesh);
    coloring.compute_costs(mesh.points, Objective::regular);
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
