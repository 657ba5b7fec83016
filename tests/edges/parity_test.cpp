#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesher/edges/parity.hpp"

namespace quadrille {
namespace {

TEST(MakeEven, SolvesRandomClosedAndOpenTopologies) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int faces = 2 + trial % 40;
    const bool open = trial % 3 == 0, three = trial % 4 == 0;
    std::uniform_int_distribution<int> pick(0, faces - 1);
    std::uniform_real_distribution<double> cost(0.01, 1);
    std::vector<ParityEdge> edges;
    for (int i = 1; i < faces; ++i)
      edges.push_back({{i, std::uniform_int_distribution<int>(0, i - 1)(random)}, cost(random)});
    for (int i = 0; i < faces; ++i) {
      const int a = pick(random), b = pick(random);
      if (a != b) edges.push_back({{a, b}, cost(random)});
    }
    if (open) edges.push_back({{pick(random)}, cost(random)});
    if (three && faces > 2) edges.push_back({{0, 1, 2}, cost(random)});
    std::vector<char> odd(faces, 0);
    int sum = 0;
    for (char& o : odd) sum += (o = static_cast<char>(random() % 2));
    // On a closed two-manifold the number of odd faces is even: each edge counts twice.
    if (!open && !(three && faces > 2) && sum % 2 != 0) odd[0] ^= 1;
    std::vector<int> left;
    const std::vector<char> change = make_even(edges, odd, left);
    EXPECT_TRUE(left.empty());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (!change[i]) continue;
      for (const int face : edges[i].faces) odd[face] ^= 1;
    }
    EXPECT_EQ(std::count(odd.begin(), odd.end(), 1), 0);
  }
}

TEST(MakeEven, NamesWhatCannotBeEven) {
  std::vector<int> left;
  const std::vector<char> change = make_even({{{0, 1}, 1.0}}, {1, 0}, left);
  EXPECT_EQ(left.size(), 1U);
  EXPECT_EQ(change.size(), 1U);
}

}  // namespace
}  // namespace quadrille
