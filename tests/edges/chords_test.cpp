/// Classes of edges with one count, and who runs against whom.

#include "mesher/edges/chords.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

constexpr double any_ratio = std::numeric_limits<double>::infinity();

Chords chords_of(const std::vector<double>& counts) {
  IdVector<EdgeId, double> wanted;
  for (const double count : counts) wanted.push_back(count);
  return Chords(wanted);
}

/// Ties that follow from directions and classes that are known beforehand, in any order.
TEST(Chords, KeepClassesAndDirectionsWhateverTheOrder) {
  std::mt19937 random(5);
  constexpr int edges = 40, classes = 4;
  for (int round = 0; round < 20; ++round) {
    std::vector<char> forward(edges);
    for (char& value : forward) value = static_cast<char>(random() % 2);
    Chords chords = chords_of(std::vector<double>(edges, 1));
    for (int tie = 0; tie < 400; ++tie) {
      const int a = static_cast<int>(random() % edges);
      const int b = static_cast<int>((a + classes * (random() % 10)) % edges);
      const bool turned = random() % 2 != 0;
      const SideEdge one{edge_id(a + 1), (forward[a] != 0) != turned},
          other{edge_id(b + 1), (forward[b] != 0) != turned};
      EXPECT_TRUE(chords.tie(one, other, any_ratio));
    }
    for (int a = 0; a < edges; ++a) {
      for (int b = 0; b < edges; ++b) {
        const EdgeId one = edge_id(a + 1), other = edge_id(b + 1);
        ASSERT_EQ(chords.of(one) == chords.of(other), a % classes == b % classes);
        if (a % classes == b % classes) {
          EXPECT_EQ(chords.against(one) == chords.against(other), forward[a] == forward[b]);
        }
      }
    }
  }
}

TEST(Chords, AreNotTiedBeyondTheRatioOfAllMembers) {
  Chords chords = chords_of({1, 1.9, 3.5, 7});
  EXPECT_TRUE(chords.tie({edge_id(1), true}, {edge_id(2), true}, 2));
  EXPECT_FALSE(chords.tie({edge_id(2), true}, {edge_id(3), true}, 2));  // 3.5 and 1
  EXPECT_NE(chords.of(edge_id(2)), chords.of(edge_id(3)));
  EXPECT_TRUE(chords.tie({edge_id(3), true}, {edge_id(4), false}, 2));
  EXPECT_TRUE(chords.tie({edge_id(1), true}, {edge_id(4), true}, any_ratio));
  EXPECT_EQ(chords.of(edge_id(2)), chords.of(edge_id(3)));
  EXPECT_NE(chords.against(edge_id(1)), chords.against(edge_id(3)));
}

}  // namespace
}  // namespace quadrille
