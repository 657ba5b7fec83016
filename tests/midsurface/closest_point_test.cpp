/// Closest points of free-form surfaces, beside OpenCASCADE's search over the whole surface.

#include "geometry/midsurface/closest_point.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cmath>
#include <random>

namespace quadrille {
namespace {

/// A wavy surface over a square of side 10.
TopoDS_Face wavy() {
  constexpr int n = 9;
  constexpr double step = 10.0 / (n - 1);
  TColStd_Array2OfReal heights(1, n, 1, n);
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      heights.SetValue(i, j, std::sin(step * (i - 1)) * std::cos(0.7 * step * (j - 1)));
  return BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(heights, 0, step, 0, step).Surface(), 1e-6)
      .Face();
}

TEST(ClosestPoint, IsNoFartherThanTheOneOfTheWholeSearch) {
  const TopoDS_Face face = wavy();
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  ClosestPoint closest(face);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 11), height(-3, 3);
  for (int i = 0; i < 200; ++i) {
    const gp_Pnt point(place(random), place(random), height(random));
    const gp_Pnt2d uv = closest(point);
    const double distance = surface->Value(uv.X(), uv.Y()).Distance(point);
    const GeomAPI_ProjectPointOnSurf search(point, surface);
    double least = 1e300;  // of the foot points; where there is none, on a border, which samples find
    if (search.NbPoints() > 0) least = search.LowerDistance();
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    surface->Bounds(u0, u1, v0, v1);
    for (int k = 0; k <= 50; ++k)
      for (int j = 0; j <= 50; ++j)
        least =
            std::min(least, surface->Value(u0 + k * (u1 - u0) / 50, v0 + j * (v1 - v0) / 50).Distance(point));
    EXPECT_LE(distance, least + 1e-7)
        << point.X() << " " << point.Y() << " " << point.Z() << ": " << uv.X() << " " << uv.Y();
  }
}

TEST(ClosestPoint, OfAPointOnTheSurfaceIsThatPoint) {
  const TopoDS_Face face = wavy();
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  ClosestPoint closest(face);
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface->Bounds(u0, u1, v0, v1);
  for (int k = 0; k < 121; ++k) {
    const gp_Pnt point = surface->Value(u0 + (u1 - u0) * (k % 11) / 10, v0 + (v1 - v0) * (k / 11) / 10);
    const gp_Pnt2d uv = closest(point);
    EXPECT_LT(surface->Value(uv.X(), uv.Y()).Distance(point), 1e-7) << k << " " << uv.X() << " " << uv.Y();
  }
}

}  // namespace
}  // namespace quadrille
