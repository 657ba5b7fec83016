/// Widths of faces whose width is known.

#include "geometry/midsurface/widths.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrille {
namespace {

TEST(Widths, OfABoxAreItsShorterSides) {
  std::array<int, 3> found{};
  for (TopExp_Explorer it(BRepPrimAPI_MakeBox(2, 5, 9).Shape(), TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    const double area = area_of(face);
    const int kind = area < 11 ? 0 : area < 20 ? 1 : 2;  // 2 x 5, 2 x 9, 5 x 9
    ++found[kind];
    EXPECT_NEAR(width_of(face), kind == 2 ? 5 : 2, 1e-9);
  }
  EXPECT_EQ(found, (std::array{2, 2, 2}));
}

TEST(Widths, OfARectangleWhateverItsShape) {
  for (const double ratio : {1.0, 1.5, 10.0, 1e4})
    EXPECT_NEAR(width_of(3 * 3 * ratio, 2 * (3 + 3 * ratio)), 3, 1e-6) << ratio;
}

/// A circle has more area than a square of that perimeter.
TEST(Widths, OfARoundFaceIsThatOfASquare) {
  const double width = width_of(M_PI, 2 * M_PI);
  EXPECT_GT(width, 0.75 * M_PI / 2);
  EXPECT_LE(width, 2);
}

TEST(Widths, OfARingAreThoseOfItsBand) {
  for (TopExp_Explorer it(BRepPrimAPI_MakeCylinder(50, 1).Shape(), TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    if (area_of(face) > 1000) continue;  // the ends
    EXPECT_NEAR(area_of(face), 100 * M_PI, 1e-6);
    EXPECT_NEAR(length_of(TopoDS::Edge(TopExp_Explorer(face, TopAbs_EDGE).Current())), 100 * M_PI, 1e-6);
    EXPECT_NEAR(width_of(face), 1, 0.01);
  }
}

}  // namespace
}  // namespace quadrille
