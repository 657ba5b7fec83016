/// Parts come once and in order. Solids built of other faces are what they were, wherever they stand and
/// however they are turned.

#include "geometry/cad/shape_parts.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GProp_GProps.hxx>

namespace quadrille {
namespace {

/// Twice the same box, the second one moved, and a face of the first one, turned over.
TopoDS_Shape boxes() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1, 2, 3).Shape();
  gp_Trsf motion;
  motion.SetRotation(gp_Ax1(gp_Pnt(5, 0, 0), gp::DZ()), 0.3);
  const TopExp_Explorer face(box, TopAbs_FACE);
  return compound_of(std::vector{box, box.Moved(motion), face.Current().Reversed()});
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

TEST(ShapeParts, ComeOnceAndInOrder) {
  const TopoDS_Shape shape = boxes();
  const TopTools_IndexedMapOfShape edges = map_of(shape, TopAbs_EDGE);
  const std::vector<TopoDS_Shape> list = list_of(shape, TopAbs_EDGE);
  ASSERT_EQ(list.size(), 24U);
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(edges.FindIndex(list[i]), static_cast<int>(i) + 1);
}

TEST(ShapeParts, EdgesOfAFaceAreItsSeamTwiceAndNoPole) {
  const TopoDS_Shape sphere = BRepPrimAPI_MakeSphere(1).Shape();
  EXPECT_EQ(list_of(sphere, TopAbs_EDGE).size(), 3U);
  const std::vector<TopoDS_Edge> edges = edges_of(sphere);
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_TRUE(edges[0].IsSame(edges[1]));
  EXPECT_NE(edges[0].Orientation(), edges[1].Orientation());
}

TEST(ShapeParts, ExchangeOfFacesKeepsSolidsTheirPlacesAndTheSidesOfFaces) {
  const TopoDS_Shape shape = boxes();
  const TopTools_IndexedMapOfShape faces = map_of(shape, TopAbs_FACE);
  ASSERT_EQ(faces.Extent(), 12);
  std::vector<TopoDS_Shape> others = list_of(shape, TopAbs_FACE);
  for (TopoDS_Shape& face : others) face = BRepBuilderAPI_Copy(face).Shape();
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
