/// Sides of elements, and which elements share them.

#include "mesher/mesh/sides.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace quadrille {
namespace {

using Groups = std::vector<std::pair<std::array<int, 2>, std::vector<Side>>>;

template <class... Lists>
Groups groups(std::size_t nodes, const Lists&... lists) {
  Groups result;
  const auto add = [&](int low, int high, std::span<const Side> sides) {
    result.push_back({{low, high}, {sides.begin(), sides.end()}});
  };
  for_each_shared_side(nodes, no_check, add, lists...);
  return result;
}

TEST(Sides, AreVisitedInOrderWithAllTheirElements) {
  // A quad, and beyond its side 1-2 a triangle, which comes after it in number.
  const std::vector<std::array<int, 4>> quads{{0, 1, 2, 3}};
  const std::vector<std::array<int, 3>> triangles{{1, 4, 2}};
  const Groups expected{
      {{0, 1}, {make_side(0, 0)}}, {{0, 3}, {make_side(0, 3)}}, {{1, 2}, {make_side(0, 1), make_side(1, 2)}},
      {{1, 4}, {make_side(1, 0)}}, {{2, 3}, {make_side(0, 2)}}, {{2, 4}, {make_side(1, 1)}}};
  EXPECT_EQ(groups(5, quads, triangles), expected);
}

TEST(Sides, MayHaveAnyNumberOfElements) {
  const std::vector<std::array<int, 3>> book{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Groups all = groups(5, book);
  EXPECT_EQ(all.size(), 7);
  EXPECT_EQ(all.front().second, (std::vector<Side>{make_side(0, 0), make_side(1, 0), make_side(2, 0)}));
}

TEST(Sides, OfNoElementsAreNone) {
  EXPECT_TRUE(groups(3, std::vector<std::array<int, 4>>{}).empty());
  EXPECT_TRUE(groups(0, std::vector<std::array<int, 4>>{}).empty());
}

TEST(Sides, TellTheirElementAndPlace) {
  for (const auto& [element, i] : std::map<int, int>{{0, 3}, {5, 0}, {1'000'000, 2}}) {
    EXPECT_EQ(element_of(make_side(element, i)), element);
    EXPECT_EQ(index_of(make_side(element, i)), i);
  }
}

TEST(Sides, CornersAreListedByNode) {
  const std::vector<std::array<int, 4>> quads{{0, 1, 2, 3}, {1, 4, 5, 2}};
  int calls = 0;
  const Rows<Side> corners = corners_by_node(7, quads, [&] { ++calls; });
  EXPECT_EQ(calls, 4);
  const std::vector<Side> at_1(corners[1].begin(), corners[1].end());
  EXPECT_EQ(at_1, (std::vector<Side>{make_side(0, 1), make_side(1, 0)}));
  const std::vector<Side> at_2(corners[2].begin(), corners[2].end());
  EXPECT_EQ(at_2, (std::vector<Side>{make_side(0, 2), make_side(1, 3)}));
  EXPECT_EQ(corners[0].size(), 1);
  EXPECT_TRUE(corners[6].empty());
}

}  // namespace
}  // namespace quadrille
