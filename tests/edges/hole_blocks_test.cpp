/// Which cells of a grid give way to a hole.

#include "mesher/edges/hole_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadrille {
namespace {

constexpr GridSize grid{40, 30};

HolePlace hole_at(double x, double y, double width, double height) {
  const Vector2 middle(x, y), half(width / 2, height / 2);
  return {Eigen::AlignedBox2d(middle - half, middle + half)};
}

TEST(HoleBlocks, AreAboutACellLargerThanTheHole) {
  const auto block = block_of(hole_at(8.5, 6.5, 4.1, 3.9), 0, grid);
  ASSERT_TRUE(block);
  EXPECT_EQ(block->columns, 5);
  EXPECT_EQ(block->rows, 5);
  EXPECT_EQ(block->column, 6);
  EXPECT_EQ(block->row, 4);
  EXPECT_EQ(block->around(), 20);
}

TEST(HoleBlocks, HaveTheirMiddleNearTheHoles) {
  const auto slot = block_of(hole_at(9, 6.5, 4.5, 1.4), 0, grid);
  ASSERT_TRUE(slot);
  EXPECT_EQ(slot->columns, 6);  // 5 cells would lie half a cell aside
  EXPECT_EQ(slot->column, 6);
  EXPECT_EQ(slot->rows, 3);
  EXPECT_EQ(slot->row, 5);
}

TEST(HoleBlocks, OfMirroredHolesAreMirrored) {
  const auto left = block_of(hole_at(8.5, 6, 3.1, 3.1), 16, grid),
             right = block_of(hole_at(31.5, 6, 3.1, 3.1), 16, grid);
  ASSERT_TRUE(left && right);
  EXPECT_EQ(left->columns, 4);
  EXPECT_EQ(left->column, 40 - right->column - right->columns);
}

TEST(HoleBlocks, HaveNodesBesideTheHolesVertex) {
  HolePlace hole = hole_at(9, 6, 4.1, 3.9);
  EXPECT_EQ(block_of(hole, 0, grid)->columns, 5);
  hole.even = true;
  EXPECT_EQ(block_of(hole, 0, grid)->columns, 6);
}

TEST(HoleBlocks, TakeTheNodesThatThereAre) {
  const HolePlace hole = hole_at(8.5, 6.5, 4.1, 3.9);
  EXPECT_FALSE(block_of(hole, 21, grid));
  EXPECT_FALSE(block_of(hole, 12, grid));  // smaller than the hole
  EXPECT_FALSE(block_of(hole, 40, grid));  // far larger
  const auto block = block_of(hole, 24, grid);
  ASSERT_TRUE(block);
  EXPECT_EQ(block->around(), 24);
  EXPECT_FALSE(block_of(hole_at(20, 20, 12, 12), 0, grid));
}

/// An outline whose corners enclose no area makes places of any size.
TEST(HoleBlocks, AreNoneForPlacesOutOfTheGrid) {
  EXPECT_FALSE(block_of(hole_at(1e15, 6.5, 2, 2), 0, grid));
  EXPECT_FALSE(block_of(hole_at(-1e15, 6.5, 2, 2), 0, grid));
  EXPECT_FALSE(block_of(hole_at(8.5, 6.5, 1e15, 2), 0, grid));
  EXPECT_FALSE(block_of(hole_at(NAN, 6.5, 2, 2), 0, grid));
}

TEST(HoleBlocks, KeepARowBetweenThem) {
  const HoleBlock one{2, 2, 3, 3};
  EXPECT_TRUE(keep_apart({one}, {10, 10}));
  EXPECT_FALSE(keep_apart({one}, {5, 10}));
  EXPECT_FALSE(keep_apart({{0, 2, 3, 3}}, {10, 10}));
  EXPECT_TRUE(keep_apart({one, {6, 2, 2, 3}}, {10, 10}));
  EXPECT_FALSE(keep_apart({one, {5, 4, 2, 3}}, {10, 10}));
  EXPECT_TRUE(keep_apart({one, {3, 6, 2, 3}}, {10, 10}));
}

}  // namespace
}  // namespace quadrille
