/// Every small polygon is filled as told.

#include "mesher/quads/polygon_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesher/mesh/quad_geometry.hpp"
#include "tests/support/polygons.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Quads on both sides of each side but those of the outline, which they have to their left; one quad at a
/// corner, two at the other nodes of the outline; a disc.
void expect_fills(const Polygon& shape, const PolygonFilling& filling) {
  std::set<std::pair<int, int>> sides;
  for (const Quad& quad : filling.quads)
    for (int k = 0; k < 4; ++k)
      ASSERT_TRUE(sides.insert({quad[k], quad[(k + 1) % 4]}).second) << "a side has two quads to its left";
  const int outline = static_cast<int>(shape.outline.size());
  int open = 0;
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    ++open;
    ASSERT_LT(a, outline);
    ASSERT_EQ(b, (a + 1) % outline);
  }
  ASSERT_EQ(open, outline);
  std::map<int, int> uses = valences(filling.quads);
  for (int i = 0; i < outline; ++i) {
    const bool corner = std::find(shape.corners.begin(), shape.corners.end(), i) != shape.corners.end();
    ASSERT_EQ(uses[i], corner ? 1 : 2);
    ASSERT_EQ(filling.places[i], shape.outline[i]);
  }
  int irregular = 0;
  for (int i = outline; i < static_cast<int>(filling.places.size()); ++i) {
    ASSERT_TRUE(uses[i] >= 3 && uses[i] <= 5);
    irregular += uses[i] != 4;
  }
  ASSERT_EQ(irregular, filling.irregular);
  ASSERT_EQ(filling.quads.size(), outline / 2 - 1 + filling.places.size() - outline);
}

/// Calls with every polygon of so many sides of one to `most` segments.
template <class Visit>
void for_each_polygon(int corners, int most, Visit visit) {
  std::vector<int> sides(corners, 1);
  while (true) {
    visit(sides);
    int i = 0;
    while (i < corners && sides[i] == most) sides[i++] = 1;
    if (i == corners) return;
    ++sides[i];
  }
}

TEST(PolygonFilling, FillsWhatItSaysItFills) {
  int filled = 0;
  for (int corners = 2; corners <= 6; ++corners)
    for_each_polygon(
        corners,
        corners == 6   ? 4
        : corners == 5 ? 5
                       : 6,
        [&](const std::vector<int>& sides) {
          const Polygon shape = polygon(sides);
          for (const PolygonFilling& filling : polygon_fillings(shape.outline, shape.corners, 2)) {
            SCOPED_TRACE(::testing::PrintToString(sides));
            ASSERT_NO_FATAL_FAILURE(expect_fills(shape, filling));
            EXPECT_EQ(filling.irregular % 2, corners % 2);
            ++filled;
          }
        });
  EXPECT_GT(filled, 1000);
}

TEST(PolygonFilling, FindsAFillingWhereverThereIsRoom) {
  // Facing sides may differ by two, odd polygons need that each side is shorter than those beside it
  // together.
  for_each_polygon(4, 3, [&](const std::vector<int>& more) {
    std::vector<int> sides = more;
    for (int& side : sides) side += 5;
    if ((sides[0] + sides[1] + sides[2] + sides[3]) % 2 != 0) return;
    const Polygon shape = polygon(sides);
    const auto fillings = polygon_fillings(shape.outline, shape.corners, 2);
    ASSERT_FALSE(fillings.empty()) << ::testing::PrintToString(sides);
    const bool grid = sides[0] == sides[2] && sides[1] == sides[3];
    for (const PolygonFilling& filling : fillings) EXPECT_EQ(filling.irregular, grid ? 0 : 2);
  });
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{
           {2, 2, 2}, {3, 4, 5}, {2, 2, 2, 2, 2}, {3, 3, 2, 3, 3}, {4, 4}, {5, 7}, {3, 3, 3, 3, 3, 3}}) {
    const Polygon shape = polygon(sides);
    EXPECT_FALSE(polygon_fillings(shape.outline, shape.corners, 2).empty())
        << ::testing::PrintToString(sides);
  }
}

TEST(PolygonFilling, FoldsNothingInRoundPolygons) {
  for (int corners = 3; corners <= 5; ++corners) {
    const Polygon shape = polygon(std::vector<int>(corners, 6));
    const auto fillings = polygon_fillings(shape.outline, shape.corners, 1);
    ASSERT_EQ(fillings.size(), 1);
    const auto& p = fillings[0].places;
    for (const auto& [a, b, c, d] : fillings[0].quads)
      EXPECT_GT(folded_scaled_jacobian(p[a], p[b], p[c], p[d], {0, 0, 1}), 0.4);
  }
}

TEST(PolygonFilling, KeepsToTheQuadsAllowed) {
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{{4, 4, 4, 4}, {7, 6, 5, 6}, {4, 4, 4}}) {
    const Polygon shape = polygon(sides);
    std::set<std::size_t> counts;
    for (const auto& filling : polygon_fillings(shape.outline, shape.corners, 2))
      counts.insert(filling.quads.size());
    ASSERT_FALSE(counts.empty());
    const int least = static_cast<int>(*counts.begin());
    const auto found = [&](const FillingLimits& limits) {
      return fill_polygon(shape.outline, shape.corners, limits, [&](const PolygonFilling& filling) {
        EXPECT_GE(filling.quads.size(), limits.least_quads);
        EXPECT_LE(filling.quads.size(), limits.most_quads);
        return true;
      });
    };
    EXPECT_TRUE(found({2, least, least}));
    EXPECT_FALSE(found({2, 1, 1}));
    EXPECT_FALSE(found({2, 1000, 2000}));
  }
}

TEST(PolygonFilling, KeepsToTheIrregularNodesAllowed) {
  const Polygon uneven = polygon({6, 4, 4, 4}), triangle = polygon({4, 4, 4});
  EXPECT_FALSE(polygon_fillings(uneven.outline, uneven.corners, 2).empty());
  EXPECT_TRUE(polygon_fillings(uneven.outline, uneven.corners, 1).empty());
  EXPECT_TRUE(polygon_fillings(triangle.outline, triangle.corners, 0).empty());
  EXPECT_TRUE(polygon_fillings(polygon({4}).outline, {0}, 2).empty());
}

}  // namespace
}  // namespace quadrille
