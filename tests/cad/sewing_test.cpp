/// Sewing turns as few faces as it can, leaves solids alone, and finds faces on faces.

#include "geometry/cad/sewing.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepFill.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <cmath>
#include <gp_Pln.hxx>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "tests/models/trouble_models.hpp"

namespace quadrille {
namespace {

/// A square of 10 from x on.
TopoDS_Shape square(double x) {
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), gp::DZ()), x, x + 10, 0, 10).Face();
}

TEST(Sewing, TurnsTheFewerFaces) {
  const Sewn sewn = sew(compound({square(0), square(10).Reversed(), square(20)}), 1e-3);
  EXPECT_EQ(sewn.joined, 2);
  EXPECT_EQ(sewn.orientation.turned, std::vector<int>{2});
  const CadShape shape(sewn.shape, "squares");
  for (const CadFace& face : shape.faces) EXPECT_FALSE(face.reversed);
}

/// A strip in three faces whose end is turned over: it has one side.
TEST(Sewing, TellsWhereNormalsCannotAgree) {
  const auto rung = [](int i) {
    const double turn = i * 2 * std::acos(-1) / 3, twist = turn / 2;
    const gp_Vec out(std::cos(turn), std::sin(turn), 0);
    const gp_Vec half = out * std::cos(twist) + gp_Vec(0, 0, 1) * std::sin(twist);
    const gp_Pnt middle = gp_Pnt(0, 0, 0).Translated(out * 10);
    return BRepBuilderAPI_MakeEdge(middle.Translated(-half * 2), middle.Translated(half * 2)).Edge();
  };
  std::vector<TopoDS_Shape> strip;
  for (int i = 0; i < 3; ++i) strip.push_back(BRepFill::Face(rung(i), rung(i + 1)));
  const Sewn sewn = sew(compound(strip), 1e-3);
  EXPECT_EQ(sewn.joined, 3);
  EXPECT_TRUE(sewn.orientation.turned.empty());
  EXPECT_FALSE(sewn.orientation.unlike.empty());
  EXPECT_TRUE(sew(compound({strip[0], strip[1]}), 1e-3).orientation.unlike.empty());
}

TEST(Sewing, LeavesFacesOfSolidsAsTheyAre) {
  const Sewn sewn = sew(compound({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape(),
                                  BRepPrimAPI_MakeBox(gp_Pnt(10, 10, 0), gp_Pnt(20, 20, 10)).Shape()}),
                        1e-3);
  EXPECT_EQ(sewn.joined, 1);
  EXPECT_TRUE(sewn.orientation.turned.empty());
  EXPECT_TRUE(sewn.coincident.empty());
}

TEST(Sewing, FindsFacesOnFaces) {
  const TopoDS_Shape boxes = compound({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape(),
                                       BRepPrimAPI_MakeBox(gp_Pnt(10, 0, 0), gp_Pnt(20, 10, 10)).Shape()});
  ASSERT_EQ(sew(boxes, 1e-3).coincident.size(), 1u);
  const CadModel model(std::make_shared<CadShape>(boxes, "boxes"));
  try {
    model.sewn(1e-3);
    ADD_FAILURE() << "the common face would be meshed twice";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("`imprint`"), std::string::npos) << error.what();
  }
  EXPECT_EQ(model.imprinted().sewn(1e-3).face_count(), 11);
}

TEST(Sewing, ABoxHasNoFacesOnFaces) {
  EXPECT_TRUE(sew(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), 1e-3).coincident.empty());
}

}  // namespace
}  // namespace quadrille
