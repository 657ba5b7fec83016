/// The faces of a solid: samples that share their area, rays through the material, and what lies where.

#include "geometry/midsurface/skin.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace quadrille {
namespace {

/// A plate of 20 by 20 by 2 with a hole of radius 5 in its middle.
std::unique_ptr<Skin> drilled_plate() {
  const TopoDS_Shape shape =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, 0), 20, 20, 2).Shape(),
                      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -1), gp::DZ()), 5, 4).Shape())
          .Shape();
  triangulate(shape, 0.02);
  const TopoDS_Solid solid = TopoDS::Solid(TopExp_Explorer(shape, TopAbs_SOLID).Current());
  TopTools_DataMapOfShapeInteger numbers;
  for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next())
    numbers.Bind(it.Current(), numbers.Extent() + 1);
  return std::make_unique<Skin>(solid, numbers);
}

TEST(Skin, SamplesShareTheAreaAndLookOutOfTheMaterial) {
  const auto skin = drilled_plate();
  ASSERT_EQ(skin->faces().size(), 7U);
  for (const SkinFace& face : skin->faces()) {
    double area = 0;
    const std::vector<FaceSample> samples = face.samples(20);
    EXPECT_GE(samples.size(), 20U);
    for (const FaceSample& sample : samples) {
      area += sample.area;
      EXPECT_LT(face.point(sample.uv).Distance(sample.point), 1e-9);
      EXPECT_TRUE(face.holds(sample.uv));
      const gp_Vec outward(*face.outward(sample.uv));
      EXPECT_TRUE(skin->in_material(sample.point.Translated(-0.01 * outward)));
      EXPECT_FALSE(skin->in_material(sample.point.Translated(0.01 * outward)));
    }
    EXPECT_NEAR(area, face.area(), 0.01 * face.area());
  }
}

TEST(Skin, RaysMeetTheFirstFaceOnTheExactSurface) {
  const auto skin = drilled_plate();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  for (int i = 0; i < 200; ++i) {
    const double turn = angle(random);
    const auto hit = skin->first_hit(gp_Pnt(0, 0, 1), gp_Dir(std::cos(turn), std::sin(turn), 0.05));
    ASSERT_TRUE(hit);
    EXPECT_EQ(skin->faces()[hit->face].surface().GetType(), GeomAbs_Cylinder);
    EXPECT_NEAR(std::hypot(hit->point.X(), hit->point.Y()), 5, 1e-7);
    EXPECT_NEAR(hit->distance, hit->point.Distance(gp_Pnt(0, 0, 1)), 1e-7);
  }
  const auto through = skin->first_hit(gp_Pnt(8, 1, 0.5), gp::DZ());
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->distance, 1.5, 1e-9);
  EXPECT_FALSE(skin->first_hit(gp_Pnt(0, 0, 1), gp::DZ())) << "through the hole";
  EXPECT_TRUE(skin->meets_face(gp_Pnt(8, 1, 0.5), gp::DZ(), 1));
  EXPECT_FALSE(skin->meets_face(gp_Pnt(8, 1, 0.9), gp::DZ(), 0.5));
}

TEST(Skin, KnowsTheFacesAtAPoint) {
  const auto skin = drilled_plate();
  EXPECT_EQ(skin->faces_at(gp_Pnt(10, 10, 2), 1e-6).size(), 3U);
  EXPECT_EQ(skin->faces_at(gp_Pnt(5, 0, 2), 1e-6).size(), 2U);
  EXPECT_EQ(skin->faces_at(gp_Pnt(8, 0, 2), 1e-6).size(), 1U);
  EXPECT_TRUE(skin->faces_at(gp_Pnt(0, 0, 2), 1e-6).empty()) << "over the hole";
  for (int i = 0; i < 7; ++i) EXPECT_EQ(skin->index_of(skin->faces()[i].face()), i);
}

}  // namespace
}  // namespace quadrille
