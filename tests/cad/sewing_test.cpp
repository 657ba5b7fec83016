/// Sewing turns as few faces as it can, leaves solids alone, and finds faces on faces.

#include "geometry/cad/sewing.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <gp_Pln.hxx>

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
