/// The search for alternating paths finds as many pairs as there can be.

#include "mesher/pairing/augmenting_paths.hpp"

#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <numeric>

#include "mesher/pairing/matching.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Triangles that stay alone in the best pairing there is.
int fewest_free(const TriangleGraph& graph) {
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
  Graph dual(graph.size());
  for (int t = 0; t < graph.size(); ++t) {
    for (Side s : graph.triangles[t].twin) {
      if (s >= 0 && triangle_of(s) > t) boost::add_edge(t, triangle_of(s), dual);
    }
  }
  std::vector<boost::graph_traits<Graph>::vertex_descriptor> mates(graph.size());
  boost::edmonds_maximum_cardinality_matching(dual, mates.data());
  return graph.size() - 2 * static_cast<int>(boost::matching_size(dual, mates.data()));
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

/// No triangle has two partners, and who is paired is so with a neighbour.
void expect_pairs(const TriangleGraph& graph) {
  for (int t = 0; t < graph.size(); ++t) {
    if (!graph.free(t)) {
      EXPECT_EQ(graph.mate_of(graph.mate_of(t)), t);
    }
  }
}

TEST(AugmentingPaths, LeaveAsFewAsCanBe) {
  int contracted = 0;
  for (const TriangleMesh& mesh : samples()) {
    TriangleGraph graph(mesh);
    const int left = augment(graph);
    expect_pairs(graph);
    EXPECT_EQ(left, fewest_free(graph));
    contracted += left > 0;
  }
  EXPECT_GT(contracted, 0) << "all samples can be paired: nothing shows when to stop";
}

TEST(AugmentingPaths, FindTheSameFromABadStartAndStraightToAnAim) {
  for (const TriangleMesh& mesh : samples()) {
    TriangleGraph graph(mesh);
    // Pairs at random: long paths are needed from here.
    std::mt19937 generator(7);
    std::vector<int> order(graph.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), generator);
    for (int t : order) {
      const Side side = make_side(t, static_cast<int>(generator() % 3)), twin = graph.twin_of(side);
      if (twin >= 0 && graph.free(t) && graph.free(triangle_of(twin))) graph.pair(side);
    }
    std::vector<int> free;
    for (int t = 0; t < graph.size(); ++t) {
      if (graph.free(t)) free.push_back(t);
    }
    const int left = augment_pairs(graph, free, StraightToNext(mesh, free), reach_of_paths);
    expect_pairs(graph);
    EXPECT_EQ(left, fewest_free(graph));
  }
}

TEST(AugmentingPaths, StopAtTheirReach) {
  // One triangle less at each end of a long strip: its pairs change all the way.
  const int n = 1000;
  const TriangleMesh mesh = strip(n);
  TriangleGraph graph(mesh);
  for (int t = 1; t + 2 < n; t += 2) {
    for (int i = 0; i < 3; ++i) {
      const Side twin = graph.twin_of(make_side(t, i));
      if (twin >= 0 && triangle_of(twin) == t + 1) graph.pair(twin);
    }
  }
  EXPECT_EQ(augment(graph, 100), 2);
  EXPECT_EQ(augment(graph, 2 * n), 0);
  expect_pairs(graph);
}

}  // namespace
}  // namespace quadrille
