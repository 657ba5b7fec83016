/// Points in faces with few and with many holes, beside their distance from the holes.

#include "geometry/midsurface/inside_test.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <random>

namespace quadrille {
namespace {

constexpr double radius = 0.3;

/// A square of n x n holes, one in each unit square.
TopoDS_Face perforated(int n) {
  BRepBuilderAPI_MakeFace face(gp_Pln(gp::XOY()), 0, n, 0, n);
  for (int k = 0; k < n * n; ++k) {
    const gp_Circ circle(gp_Ax2(gp_Pnt(k % n + 0.5, 0.5 + k / n, 0), gp::DZ()), radius);
    face.Add(TopoDS::Wire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire().Reversed()));
  }
  return face.Face();
}

class Perforated : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Holes, Perforated, testing::Values(2, 20));

TEST_P(Perforated, HasMaterialBetweenTheHoles) {
  const int n = GetParam();
  const TopoDS_Face face = perforated(n);
  EXPECT_EQ(has_many_holes(face), n > 10);
  const InsideTest inside(face);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(-0.5, n + 0.5);
  constexpr double near = 1e-3;
  for (int i = 0; i < 3000; ++i) {
    const double x = place(random), y = place(random);
    const double hole = std::hypot(x - std::floor(x) - 0.5, y - std::floor(y) - 0.5) - radius;
    const double border = std::min({x, y, n - x, n - y});  // negative outside
    const double depth = border < 0 ? border : std::min(border, hole);
    if (std::abs(depth) < 2 * near) continue;
    EXPECT_EQ(inside.at({x, y}, near), depth > 0 ? TopAbs_IN : TopAbs_OUT) << x << " " << y;
  }
  const double diagonal = std::sqrt(0.5) * radius;
  EXPECT_EQ(inside.at({0.5 + diagonal, 0.5 - diagonal}, near), TopAbs_ON);
  EXPECT_EQ(inside.at({0, 0.9}, near), TopAbs_ON);
}

}  // namespace
}  // namespace quadrille
