/// Solids built of other faces are what they were, wherever they stand and however they are turned.

#include "geometry/cad/face_exchange.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>

namespace quadrille {
namespace {

/// Twice the same box, the second one moved, and a face of the first one, turned over.
TopoDS_Shape boxes() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  gp_Trsf motion;
  motion.SetRotation(gp_Ax1(gp_Pnt(5, 0, 0), gp::DZ()), 0.3);
  const TopExp_Explorer face(box, TopAbs_FACE);
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (const TopoDS_Shape& part : {box, box.Moved(motion), face.Current().Reversed()})
    builder.Add(result, part);
  return result;
}

/// Volume and center of each solid, in order.
std::vector<std::pair<double, gp_Pnt>> masses(const TopoDS_Shape& shape) {
  std::vector<std::pair<double, gp_Pnt>> result;
  for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next()) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solid.Current(), properties);
    result.emplace_back(properties.Mass(), properties.CentreOfMass());
  }
  return result;
}

TEST(FaceExchange, KeepsSolidsTheirPlacesAndTheSidesOfFaces) {
  const TopoDS_Shape shape = boxes();
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  ASSERT_EQ(faces.Extent(), 12);
  std::vector<TopoDS_Shape> others;
  for (int i = 1; i <= faces.Extent(); ++i) others.push_back(BRepBuilderAPI_Copy(faces(i)).Shape());
  const TopoDS_Shape result = with_faces(shape, faces, others);
  const auto before = masses(shape), after = masses(result);
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(after[i].first, before[i].first, 1e-9);
    EXPECT_LT(after[i].second.Distance(before[i].second), 1e-9);
  }
  TopExp_Explorer old(shape, TopAbs_FACE), face(result, TopAbs_FACE);
  for (; old.More() && face.More(); old.Next(), face.Next()) {
    const TopoDS_Shape& other = others[faces.FindIndex(old.Current()) - 1];
    EXPECT_TRUE(face.Current().IsSame(other));
    const bool turned =
        old.Current().Orientation() != faces.FindKey(faces.FindIndex(old.Current())).Orientation();
    EXPECT_EQ(face.Current().Orientation() != other.Orientation(), turned);
  }
  EXPECT_FALSE(old.More() || face.More());
}

}  // namespace
}  // namespace quadrille
