/// Outlines of steps laid out in cells, and the nodes inside.

#include "mesher/faces/step_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadrille {
namespace {

/// A loop of sides with as many segments as cells, on columns and rows of uneven widths.
struct Loop {
  std::vector<StepLayout::Line> sides;
  std::vector<Vector3> points;
  std::vector<Vector2> uv;
};

double column_at(int i) {
  return i + 0.1 * i * i;
}
double row_at(int j) {
  return 2 * j - 0.05 * j * j;
}

Loop walk(const std::vector<int>& directions, const std::vector<int>& counts) {
  Loop loop;
  int i = 0, j = 0, total = 0, next = 0;
  for (const int count : counts) total += count;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    StepLayout::Line& side = loop.sides.emplace_back();
    for (int n = 0; n < counts[k]; ++n) {
      side.push_back(next++);
      loop.points.emplace_back(column_at(i), row_at(j), 0);
      loop.uv.emplace_back(column_at(i), row_at(j));
      (directions[k] % 2 == 0 ? i : j) += directions[k] < 2 ? 1 : -1;
    }
    side.push_back(next % total);
  }
  return loop;
}

std::optional<StepLayout> layout_of(const Loop& loop, const std::vector<int>& directions) {
  const ExecutionContext context;
  SparseCheck check(context);
  return StepLayout::make(loop.sides, directions, loop.points, check);
}

/// Where columns and rows are straight, the nodes inside lie where they cross: Laplace's equation over their
/// widths is exact there, beside corners that turn to the right too.
TEST(StepLayout, KeepsStraightLinesStraight) {
  const std::vector<int> t{0, 1, 0, 1, 2, 3, 0, 3};  // a T, from the foot of its stem
  const std::vector<int> counts{3, 4, 5, 3, 12, 3, 4, 4};
  const Loop loop = walk(t, counts);
  const auto layout = layout_of(loop, t);
  ASSERT_TRUE(layout);
  const ExecutionContext context;
  SparseCheck check(context);
  const std::vector<Vector2> inside = layout->spread(loop.uv, check);
  int cells = 0;
  double area = 0;
  layout->for_each_cell([&](const std::array<int, 4>& corners) {
    ++cells;
    const auto at = [&](int point) { return point < 0 ? inside[StepLayout::inner(point)] : loop.uv[point]; };
    const Vector2 a = at(corners[0]), b = at(corners[1]), c = at(corners[2]), d = at(corners[3]);
    EXPECT_NEAR((b - a).dot(d - a), 0, 1e-9);
    EXPECT_NEAR((b - c).dot(d - c), 0, 1e-9);
    area += (b - a).norm() * (d - a).norm();
  });
  EXPECT_EQ(cells, 3 * 4 + 12 * 3);
  double wanted = 0;  // of the loop
  for (std::size_t k = 0; k < loop.uv.size(); ++k) {
    const Vector2 &p = loop.uv[k], &q = loop.uv[(k + 1) % loop.uv.size()];
    wanted += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  EXPECT_NEAR(area, wanted, 1e-9);
  EXPECT_GT(wanted, 0);
}

TEST(StepLayout, TakesStripsOneCellWide) {
  const std::vector<int> l{0, 1, 2, 1, 2, 3};
  const Loop loop = walk(l, {5, 1, 4, 3, 1, 4});
  const auto layout = layout_of(loop, l);
  ASSERT_TRUE(layout);
  const ExecutionContext context;
  SparseCheck check(context);
  EXPECT_TRUE(layout->spread(loop.uv, check).empty());
  int cells = 0;
  layout->for_each_cell([&](const std::array<int, 4>&) { ++cells; });
  EXPECT_EQ(cells, 5 + 3);
}

TEST(StepLayout, RefusesLoopsThatDoNotCloseTouchOrCross) {
  const std::vector<int> l{0, 1, 2, 1, 2, 3};
  EXPECT_FALSE(layout_of(walk(l, {5, 1, 4, 3, 2, 4}), l));
  EXPECT_FALSE(layout_of(walk(l, {5, 1, 4, 3, 1, 5}), l));
  // A U whose slot reaches its bottom, and one whose slot goes beyond it.
  const std::vector<int> u{0, 1, 2, 3, 2, 1, 2, 3};
  EXPECT_TRUE(layout_of(walk(u, {6, 4, 2, 3, 2, 3, 2, 4}), u));
  EXPECT_FALSE(layout_of(walk(u, {6, 4, 2, 4, 2, 4, 2, 4}), u));
  EXPECT_FALSE(layout_of(walk(u, {6, 4, 2, 5, 2, 5, 2, 4}), u));
  // To the right in all.
  const std::vector<int> back{0, 3, 2, 1};
  EXPECT_FALSE(layout_of(walk(back, {3, 2, 3, 2}), back));
}

}  // namespace
}  // namespace quadrille
