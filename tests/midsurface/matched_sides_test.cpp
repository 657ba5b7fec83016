/// Chains of walls whose sides continue into each other.

#include "geometry/midsurface/matched_sides.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace quadrille {
namespace {

/// A sheet of thickness 1 along a line of parts of length 10, each of which turns by this angle against the
/// one before.
TopoDS_Solid folded_sheet(const std::vector<double>& degrees) {
  std::vector<gp_Pnt> below, above;
  double x = 0, y = 0, angle = 0;
  for (std::size_t i = 0; i <= degrees.size() + 1; ++i) {
    const double turned = i == 0 || i > degrees.size() ? 0 : degrees[i - 1] * std::numbers::pi / 180;
    const double middle = angle + turned / 2, reach = 1 / std::cos(turned / 2);
    below.emplace_back(x, y, 0);
    above.emplace_back(x - reach * std::sin(middle), y + reach * std::cos(middle), 0);
    angle += turned;
    x += 10 * std::cos(angle);
    y += 10 * std::sin(angle);
  }
  BRepBuilderAPI_MakePolygon wire;
  for (const gp_Pnt& point : below) wire.Add(point);
  std::for_each(above.rbegin(), above.rend(), [&](const gp_Pnt& point) { wire.Add(point); });
  wire.Close();
  return TopoDS::Solid(
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 30)).Shape());
}

struct Sheet {
  TopoDS_Solid solid;
  std::unique_ptr<Skin> skin;
  std::vector<std::array<int, 2>> pairs;  // the faces below and above of each part, in order

  explicit Sheet(const std::vector<double>& degrees) : solid(folded_sheet(degrees)) {
    triangulate(solid, 0.1);
    TopTools_DataMapOfShapeInteger numbers;
    for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next())
      numbers.Bind(it.Current(), numbers.Extent() + 1);
    skin = std::make_unique<Skin>(solid, numbers);
    // A prism's faces come in the order of its profile's edges, and a part's two sides are as far from its
    // ends.
    std::vector<int> walls;
    for (int face = 0; face < static_cast<int>(skin->faces().size()); ++face)
      if (skin->faces()[face].area() > 200 && skin->faces()[face].area() < 400) walls.push_back(face);
    for (std::size_t i = 0; i < walls.size() / 2; ++i)
      pairs.push_back({walls[i], walls[walls.size() - 1 - i]});
    EXPECT_EQ(pairs.size(), degrees.size() + 1);
  }
};

std::vector<int> firsts(const std::vector<MatchedSides>& walls) {
  std::vector<int> result;
  result.reserve(walls.size());
  for (const MatchedSides& wall : walls) result.push_back(wall.faces[0]);
  std::sort(result.begin(), result.end());
  return result;
}

TEST(MatchedSides, ChainWallsThatTurnByLittle) {
  const Sheet sheet({10, -12, 5});
  const std::vector<MatchedSides> walls = matched_sides(*sheet.skin, sheet.pairs);
  ASSERT_EQ(walls.size(), 4U);
  std::vector<int> below;
  for (const auto& pair : sheet.pairs) below.push_back(pair[0]);
  EXPECT_EQ(firsts(walls), below);  // the first sides lie side by side, whatever was given first
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto beside = 4 - std::count(walls[i].beside.begin(), walls[i].beside.end(), -1);
    EXPECT_EQ(static_cast<std::size_t>(beside), walls[i].next.size());
    for (const std::size_t next : walls[i].next) {
      const auto& back = walls[next].next;
      EXPECT_NE(std::find(back.begin(), back.end(), i), back.end());
      const auto& ends = walls[i].beside;
      EXPECT_NE(std::find(ends.begin(), ends.end(), walls[next].faces[0]), ends.end());
    }
  }
}

TEST(MatchedSides, AreThoseOfOneSideHoweverPairsAreGiven) {
  Sheet sheet({10, -12, 5});
  std::swap(sheet.pairs[1][0], sheet.pairs[1][1]);
  std::swap(sheet.pairs[3][0], sheet.pairs[3][1]);
  const std::vector<MatchedSides> walls = matched_sides(*sheet.skin, sheet.pairs);
  ASSERT_EQ(walls.size(), 4U);
  EXPECT_EQ(firsts(walls),
            (std::vector<int>{sheet.pairs[0][0], sheet.pairs[1][1], sheet.pairs[2][0], sheet.pairs[3][1]}));
}

TEST(MatchedSides, EndChainsAtSharpFoldsAndLeaveSingleWalls) {
  const Sheet split({10, 40, -15, 60});
  const std::vector<MatchedSides> walls = matched_sides(*split.skin, split.pairs);
  ASSERT_EQ(walls.size(), 4U);  // two chains of two, and a wall alone
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(walls[i].next, std::vector<std::size_t>{i ^ 1});
  const Sheet sharp({40, -60});
  EXPECT_TRUE(matched_sides(*sharp.skin, sharp.pairs).empty());
}

}  // namespace
}  // namespace quadrille
