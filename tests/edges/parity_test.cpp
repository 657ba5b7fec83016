/// Even sums of counts around faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "mesher/edges/count_balance.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

constexpr double fixed = std::numeric_limits<double>::infinity();

/// The faces that are odd after the changes.
FaceFlags odd_after(const IdVector<EdgeId, ParityEdge>& edges, const EdgeFlags& change, FaceFlags odd) {
  for (const EdgeId edge : edges.ids()) {
    if (!change[edge]) continue;
    for (const FaceId face : edges[edge].faces) odd[face] ^= 1;
  }
  return odd;
}

int count_odd(const FaceFlags& odd) {
  return static_cast<int>(std::count(odd.begin(), odd.end(), 1));
}

double dearest(const IdVector<EdgeId, ParityEdge>& edges, const EdgeFlags& change) {
  double most = 0;
  for (const EdgeId edge : edges.ids())
    if (change[edge]) most = std::max(most, edges[edge].cost);
  return most;
}

/// The least cost of the dearest edge among all sets of edges that make every face even, tried one by one.
double least_dearest(const IdVector<EdgeId, ParityEdge>& edges, const FaceFlags& odd) {
  double least = fixed;
  for (unsigned set = 0; set < 1U << edges.size(); ++set) {
    EdgeFlags change(edges.size());
    for (const EdgeId edge : edges.ids()) change[edge] = static_cast<char>(set >> edge.index() & 1);
    if (count_odd(odd_after(edges, change, odd)) == 0) least = std::min(least, dearest(edges, change));
  }
  return least;
}

TEST(MakeEven, SolvesRandomClosedAndOpenTopologies) {
  std::mt19937 random(3);
  int compared = 0, with_fixed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int faces = 2 + trial % 40;
    const bool open = trial % 3 == 0, three = trial % 4 == 0;
    std::uniform_int_distribution<int> pick(0, faces - 1);
    std::uniform_real_distribution<double> cost(0.01, 1);
    IdVector<EdgeId, ParityEdge> edges;
    const auto add = [&](std::initializer_list<int> uses, bool may_change = true) {
      ParityEdge& edge = edges[edges.push_back({})];
      for (const int face : uses) edge.faces.push_back(FaceId::from_index(face));
      edge.cost = may_change ? cost(random) : fixed;
      with_fixed += !may_change;
    };
    for (int i = 1; i < faces; ++i) add({i, std::uniform_int_distribution<int>(0, i - 1)(random)});
    for (int i = 0; i < faces; ++i) {
      const int a = pick(random), b = pick(random);
      if (a != b) add({a, b}, random() % 4 != 0);
    }
    if (open) add({pick(random)});
    if (three && faces > 2) add({0, 1, 2});
    FaceFlags odd(faces);
    int sum = 0;
    for (char& o : odd) sum += (o = static_cast<char>(random() % 2));
    // On a closed two-manifold the number of odd faces is even: each edge counts twice.
    if (!open && !(three && faces > 2) && sum % 2 != 0) odd[face_id(1)] ^= 1;
    std::vector<FaceId> left;
    const EdgeFlags change = make_even(edges, odd, left);
    EXPECT_TRUE(left.empty());
    EXPECT_EQ(count_odd(odd_after(edges, change, odd)), 0);
    EXPECT_LT(dearest(edges, change), fixed);
    constexpr std::size_t few = 14;
    if (edges.size() > few) continue;
    EXPECT_EQ(dearest(edges, change), least_dearest(edges, odd));
    ++compared;
  }
  EXPECT_GT(compared, 30);
  EXPECT_GT(with_fixed, 1000);
}

TEST(MakeEven, TakesCheapEdgesAndLeavesFixedOnes) {
  for (const double dear : {10.0, fixed}) {
    IdVector<EdgeId, ParityEdge> edges;
    edges.push_back({{face_id(1), face_id(3)}, dear});
    edges.push_back({{face_id(1), face_id(2)}, 1.0});
    edges.push_back({{face_id(2), face_id(3)}, 1.0});
    FaceFlags odd(3);
    odd[face_id(1)] = odd[face_id(3)] = 1;
    std::vector<FaceId> left;
    const EdgeFlags change = make_even(edges, odd, left);
    EXPECT_TRUE(left.empty());
    EXPECT_EQ(std::vector<char>(change.begin(), change.end()), (std::vector<char>{0, 1, 1}));
  }
}

TEST(MakeEven, LeavesAFixedEdgeThatAloneWouldHelp) {
  IdVector<EdgeId, ParityEdge> edges;
  edges.push_back({{face_id(1), face_id(2)}, fixed});
  edges.push_back({{face_id(2), face_id(3)}, 1.0});
  FaceFlags odd(3);
  odd[face_id(1)] = odd[face_id(3)] = 1;
  std::vector<FaceId> left;
  const EdgeFlags change = make_even(edges, odd, left);
  EXPECT_FALSE(change[edge_id(1)]);
  ASSERT_EQ(left.size(), 2U);
  const FaceFlags after = odd_after(edges, change, odd);
  EXPECT_EQ(count_odd(after), 2);
  for (const FaceId face : left) EXPECT_TRUE(after[face]) << face.number();
}

TEST(MakeEven, NamesWhatCannotBeEven) {
  std::vector<FaceId> left;
  IdVector<EdgeId, ParityEdge> edges;
  edges.push_back({{face_id(1), face_id(2)}, 1.0});
  FaceFlags odd(2);
  odd[face_id(1)] = 1;
  const EdgeFlags change = make_even(edges, odd, left);
  ASSERT_EQ(left.size(), 1U);
  ASSERT_EQ(change.size(), 1U);
  const FaceFlags after = odd_after(edges, change, odd);
  EXPECT_EQ(count_odd(after), 1);
  EXPECT_TRUE(after[left[0]]);
}

}  // namespace
}  // namespace quadrille
