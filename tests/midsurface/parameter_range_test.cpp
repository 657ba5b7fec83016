/// Ranges of parameters hold what they are made from, also across the seam of a periodic surface.

#include "geometry/midsurface/parameter_range.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

constexpr double radius = 5, turn = 2 * std::numbers::pi;

/// Points on a cylinder at these angles, from z = 1 to 3.
std::vector<gp_Pnt> on_cylinder(double from, double to, int count) {
  std::vector<gp_Pnt> result;
  for (int i = 0; i <= count; ++i) {
    const double angle = from + (to - from) * i / count;
    result.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 1 + 2.0 * i / count);
  }
  return result;
}

TEST(ParameterRange, HoldsAnArcWhereverTheSeamIs) {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), radius);
  for (int k = 0; k < 24; ++k) {
    const double from = turn * k / 24, arc = 1.5, margin = 0.1;
    const auto [u, v] = range_of(cylinder, on_cylinder(from, from + arc, 20), {margin, 0.5});
    EXPECT_NEAR(u.length(), arc + 2 * margin, 1e-9);
    EXPECT_NEAR(std::remainder(u.low - (from - margin), turn), 0, 1e-9);
    EXPECT_NEAR(v.low, 0.5, 1e-9);
    EXPECT_NEAR(v.high, 3.5, 1e-9);
  }
}

TEST(ParameterRange, IsThePeriodWherePointsLeaveNoWideGap) {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), radius);
  for (const double missing : {0.0, 0.3, 1.2}) {
    const auto [u, v] = range_of(cylinder, on_cylinder(0.2, 0.2 + turn - missing, 60), {0.1, 0});
    EXPECT_NEAR(u.length(), missing < 1 ? turn : turn - missing + 0.2, 1e-9);
  }
  // Margins from both sides close the gap.
  const auto [u, v] = range_of(cylinder, on_cylinder(0, turn - 1, 60), {0.45, 0});
  EXPECT_NEAR(u.length(), turn, 1e-12);
}

TEST(ParameterRange, OfAPlaneIsTheBoxWithMargins) {
  const Handle(Geom_Surface) plane = new Geom_Plane(gp::XOY());
  const auto [u, v] = range_of(plane, {{1, 2, 9}, {-4, 7, 0}, {0, 3, -2}}, {0.5, 2});
  EXPECT_NEAR(u.low, -4.5, 1e-12);
  EXPECT_NEAR(u.high, 1.5, 1e-12);
  EXPECT_NEAR(v.low, 0, 1e-12);
  EXPECT_NEAR(v.high, 9, 1e-12);
}

TEST(ParameterRange, PointsOnEdgesReachTheirEnds) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Solid();
  triangulate(box, 0.1);
  TopTools_DataMapOfShapeInteger numbers;
  for (TopExp_Explorer it(box, TopAbs_FACE); it.More(); it.Next())
    numbers.Bind(it.Current(), numbers.Extent() + 1);
  const Skin skin(TopoDS::Solid(box), numbers);
  for (int face = 0; face < 6; ++face) {
    const std::vector<gp_Pnt> points = points_on_edges(skin, {face});
    EXPECT_EQ(points.size(), 4U * 17);
    for (TopExp_Explorer it(skin.faces()[face].face(), TopAbs_VERTEX); it.More(); it.Next()) {
      const gp_Pnt corner = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                              [&](const gp_Pnt& p) { return p.Distance(corner) < 1e-9; }));
    }
    for (const gp_Pnt& p : points)
      EXPECT_LT(skin.faces()[face].point(skin.faces()[face].closest(p)).Distance(p), 1e-9);
  }
}

}  // namespace
}  // namespace quadrille
