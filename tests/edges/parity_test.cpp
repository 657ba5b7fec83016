/// Even sums of counts around faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "mesher/edges/parity.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

TEST(MakeEven, SolvesRandomClosedAndOpenTopologies) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int faces = 2 + trial % 40;
    const bool open = trial % 3 == 0, three = trial % 4 == 0;
    std::uniform_int_distribution<int> pick(0, faces - 1);
    std::uniform_real_distribution<double> cost(0.01, 1);
    IdVector<EdgeId, ParityEdge> edges;
    const auto add = [&](std::initializer_list<int> uses) {
      ParityEdge& edge = edges[edges.push_back({})];
      for (const int face : uses) edge.faces.push_back(FaceId::from_index(face));
      edge.cost = cost(random);
    };
    for (int i = 1; i < faces; ++i) add({i, std::uniform_int_distribution<int>(0, i - 1)(random)});
    for (int i = 0; i < faces; ++i) {
      const int a = pick(random), b = pick(random);
      if (a != b) add({a, b});
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
    for (const EdgeId edge : edges.ids()) {
      if (!change[edge]) continue;
      for (const FaceId face : edges[edge].faces) odd[face] ^= 1;
    }
    EXPECT_EQ(std::count(odd.begin(), odd.end(), 1), 0);
  }
}

TEST(MakeEven, TakesCheapEdgesAndLeavesFixedOnes) {
  constexpr double fixed = std::numeric_limits<double>::infinity();
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

TEST(MakeEven, NamesWhatCannotBeEven) {
  std::vector<FaceId> left;
  IdVector<EdgeId, ParityEdge> edges;
  edges.push_back({{face_id(1), face_id(2)}, 1.0});
  FaceFlags odd(2);
  odd[face_id(1)] = 1;
  const EdgeFlags change = make_even(edges, odd, left);
  EXPECT_EQ(left.size(), 1U);
  EXPECT_EQ(change.size(), 1U);
}

}  // namespace
}  // namespace quadrille
