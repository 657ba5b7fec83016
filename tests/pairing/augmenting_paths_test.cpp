/// The search for alternating paths finds as many pairs as there can be.

#include "mesher/pairing/augmenting_paths.hpp"

#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <numeric>

#include "tests/support/coloring_checks.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Triangles that stay alone in the best pairing there is.
int fewest_free(const EdgeColoring& coloring) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph dual(coloring.size());
  for (int t = 0; t < coloring.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side s = coloring.twin(make_side(t, i));
      if (s >= 0 && triangle_of(s) > t) boost::add_edge(t, triangle_of(s), dual);
    }
  }
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> mates(coloring.size());
  boost::edmonds_maximum_cardinality_matching(dual, mates.data());
  return coloring.size() - 2 * static_cast<int>(boost::matching_size(dual, mates.data()));
}

std::vector<TriangleMesh> samples() {
  std::vector<TriangleMesh> meshes{
      strip(7),     band(9),        with_ears(band(8)),   with_ears(with_ears(strip(12))),
      icosphere(2), torus(9, 7, 1), double_torus(8, 6, 2)};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    meshes.push_back(random_square(200, seed));
    meshes.push_back(random_with_holes(400, 6, seed));
    meshes.push_back(perforated(random_square(300, seed), 0.05 + 0.01 * seed, seed));
  }
  return meshes;
}

TEST(AugmentingPaths, LeaveAsFewAsCanBe) {
  int contracted = 0;
  for (const TriangleMesh& mesh : samples()) {
    EdgeColoring coloring(mesh);
    const int left = augment(coloring, free_triangles(coloring));
    EXPECT_EQ(validate(coloring), "");
    EXPECT_EQ(left, fewest_free(coloring));
    contracted += left > 0;
  }
  EXPECT_GT(contracted, 0) << "all samples can be paired: nothing shows when to stop";
}

TEST(AugmentingPaths, FindTheSameFromABadStartAndStraightToAnAim) {
  for (const TriangleMesh& mesh : samples()) {
    EdgeColoring coloring(mesh);
    // Pairs at random: long paths are needed from here.
    std::mt19937 generator(7);
    std::vector<int> order(coloring.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), generator);
    for (int t : order) {
      const Side side = make_side(t, static_cast<int>(generator() % 3)), twin = coloring.twin(side);
      if (twin >= 0 && coloring.free(t) && coloring.free(triangle_of(twin))) coloring.pair(side);
    }
    const int left = augment(coloring, free_triangles(coloring), {.heading = &mesh});
    EXPECT_EQ(validate(coloring), "");
    EXPECT_EQ(left, fewest_free(coloring));
  }
}

TEST(AugmentingPaths, StopAtTheirReach) {
  // One triangle less at each end of a long strip: its pairs change all the way.
  const int n = 1000;
  const TriangleMesh mesh = strip(n);
  EdgeColoring coloring(mesh);
  for (int t = 1; t + 2 < n; t += 2) {
    for (int i = 0; i < 3; ++i) {
      const Side twin = coloring.twin(make_side(t, i));
      if (twin >= 0 && triangle_of(twin) == t + 1) coloring.pair(twin);
    }
  }
  EXPECT_EQ(augment(coloring, free_triangles(coloring), {.reach = 100}), 2);
  EXPECT_EQ(augment(coloring, free_triangles(coloring), {.reach = 2 * n}), 0);
  EXPECT_EQ(validate(coloring), "");
}

}  // namespace
}  // namespace quadrille
