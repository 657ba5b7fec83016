/// Lists in compressed rows.

#include "geometry/base/rows.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

std::vector<int> copy(std::span<const int> list) {
  return {list.begin(), list.end()};
}

TEST(Rows, KeepTheOrderInWhichItemsWereAdded) {
  const Rows<> rows(4, [](auto&& add) {
    add(2, 7);
    add(0, 5);
    add(2, 3);
    add(3, 4);
    add(2, 7);
  });
  EXPECT_EQ(copy(rows[0]), std::vector<int>{5});
  EXPECT_TRUE(rows[1].empty());
  EXPECT_EQ(copy(rows[2]), (std::vector<int>{7, 3, 7}));
  EXPECT_EQ(copy(rows[3]), std::vector<int>{4});
}

TEST(Rows, GiveTheirItemsListByList) {
  Rows<> rows(3, [](auto&& add) {
    for (int i = 0; i < 6; ++i) add(2 - i % 3, i);
  });
  EXPECT_EQ(rows.take_items(), (std::vector<int>{2, 5, 1, 4, 0, 3}));
}

TEST(Rows, MayBeNone) {
  EXPECT_TRUE(Rows<>(0, [](auto&&) {}).take_items().empty());
}

}  // namespace
}  // namespace quadrille
