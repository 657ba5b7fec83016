/// Middle surfaces of pairs of elementary faces are equally far from both.

#include "geometry/midsurface/middle_geometry.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>

#include <array>
#include <cmath>
#include <vector>

namespace quadrille {
namespace {

/// A part of a surface as a side of a wall, with the material below its normal, or above if `turned`.
SkinFace side(const Handle(Geom_Surface) & surface, bool turned) {
  TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, 0.2, 1, 0.2, 1, 1e-7).Face();
  if (turned) face.Reverse();
  triangulate(face, 0.1);
  return {face, 1};
}

double distance(const Handle(Geom_Surface) & surface, const gp_Pnt& point) {
  return GeomAPI_ProjectPointOnSurf(point, surface).LowerDistance();
}

TEST(MiddleGeometry, IsEquallyFarFromBothSides) {
  const gp_Ax3 axes(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 1));
  gp_Ax3 tilted = axes;
  tilted.Rotate(gp_Ax1(gp_Pnt(60, 0, 0), gp_Dir(1, 0, 1)), 0.03);
  gp_Ax3 shifted = axes;
  shifted.Translate(gp_Vec(axes.Direction()));
  constexpr double angle = 0.3;
  using Pair = std::array<Handle(Geom_Surface), 2>;
  const std::vector<Pair> pairs{
      Pair{new Geom_Plane(axes), new Geom_Plane(shifted)},
      Pair{new Geom_Plane(axes), new Geom_Plane(tilted)},
      Pair{new Geom_CylindricalSurface(axes, 5), new Geom_CylindricalSurface(axes, 7)},
      Pair{new Geom_ConicalSurface(axes, angle, 5), new Geom_ConicalSurface(axes, angle, 6)},
      Pair{new Geom_SphericalSurface(axes, 5), new Geom_SphericalSurface(axes, 6)},
      Pair{new Geom_ToroidalSurface(axes, 20, 3), new Geom_ToroidalSurface(axes, 20, 4)},
  };
  for (const Pair& pair : pairs) {
    const SkinFace inner = side(pair[0], true), outer = side(pair[1], false);
    const Handle(Geom_Surface) middle = middle_surface(inner, outer, 100);
    ASSERT_FALSE(middle.IsNull()) << pair[0]->DynamicType()->Name();
    for (const double u : {0.3, 0.5, 0.9})
      for (const double v : {0.3, 0.7}) {
        const gp_Pnt place = GeomAPI_ProjectPointOnSurf(pair[0]->Value(u, v), middle).NearestPoint();
        EXPECT_NEAR(distance(pair[0], place), distance(pair[1], place), 1e-7)
            << pair[0]->DynamicType()->Name();
      }
  }
  const SkinFace plane = side(pairs[0][0], true), cylinder = side(pairs[2][1], false);
  EXPECT_TRUE(middle_surface(plane, cylinder, 100).IsNull());
}

TEST(MiddleGeometry, KnowsFacesOnOneSurface) {
  const gp_Ax3 axes(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 1));
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(axes, 5),
                             same = new Geom_CylindricalSurface(axes.Ax2(), 5),
                             wider = new Geom_CylindricalSurface(axes, 5.01);
  EXPECT_TRUE(on_one_surface(side(cylinder, false), side(same, false), 100));
  EXPECT_FALSE(on_one_surface(side(cylinder, false), side(same, true), 100)) << "material on both sides";
  EXPECT_FALSE(on_one_surface(side(cylinder, false), side(wider, false), 100));
}

/// The mean of two bends whose axes are apart is off by the square of that, over the radius.
TEST(MiddleGeometry, IsNearlyTheMiddleOfBendsWithDraft) {
  for (const double apart : {0.01, 0.02, 0.04}) {
    const Handle(Geom_Surface) inner = new Geom_CylindricalSurface(gp_Ax3(), 5),
                               outer = new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(apart, 0, 0), gp::DZ()), 7);
    const NearMiddle near = near_middle_surface(side(inner, true), side(outer, false), 0.01);
    ASSERT_FALSE(near.surface.IsNull());
    EXPECT_LT(near.off, apart * apart);
    for (const double u : {0.0, 1.0, 2.5, 4.0}) {
      const gp_Pnt place = near.surface->Value(u, 0.5);
      EXPECT_LE(std::abs(distance(inner, place) - distance(outer, place)), 2 * near.off + 1e-9);
    }
    EXPECT_TRUE(near_middle_surface(side(inner, true), side(outer, false), 0.1 * near.off).surface.IsNull());
  }
}

}  // namespace
}  // namespace quadrille
