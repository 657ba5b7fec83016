/// The solids of a model as skins: material inside, faces with the model's numbers, and joined if wanted.

#include "geometry/midsurface/solids.hpp"

#include <gtest/gtest.h>

#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include <set>

#include "tests/models/trouble_models.hpp"

namespace quadrille {
namespace {

TopoDS_Shape boxes(bool overlap) {
  return compound({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 2)).Shape(),
                   BRepPrimAPI_MakeBox(gp_Pnt(4, 0, overlap ? 1 : 9), gp_Pnt(6, 10, 12)).Shape().Reversed()});
}

TEST(Solids, HaveTheMaterialInsideAndTheModelsNumbers) {
  const TopoDS_Shape shape = boxes(false);
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  const std::deque<Skin> skins = skins_of(shape, false, ExecutionContext(1));
  ASSERT_EQ(skins.size(), 2U);
  std::set<int> numbers;
  for (const Skin& skin : skins) {
    ASSERT_EQ(skin.faces().size(), 6U);
    GProp_GProps properties;
    BRepGProp::VolumeProperties(skin.solid(), properties);
    EXPECT_GT(properties.Mass(), 0);
    EXPECT_TRUE(skin.in_material(properties.CentreOfMass()));
    EXPECT_FALSE(skin.in_material(gp_Pnt(20, 20, 20)));
    for (const SkinFace& face : skin.faces()) {
      EXPECT_TRUE(faces(face.number()).IsSame(face.face()));
      EXPECT_TRUE(numbers.insert(face.number()).second);
      const FaceSample sample = face.samples(4).front();
      const gp_Vec outward(properties.CentreOfMass(), sample.point);
      EXPECT_GT(outward.Dot(gp_Vec(*face.outward(sample.uv))), 0);
    }
  }
}

TEST(Solids, ThatOverlapAreOneIfJoined) {
  const TopoDS_Shape shape = boxes(true);
  EXPECT_EQ(skins_of(shape, false, ExecutionContext(1)).size(), 2U);
  const std::deque<Skin> joined = skins_of(shape, true, ExecutionContext(1));
  ASSERT_EQ(joined.size(), 1U);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(joined[0].solid(), properties);
  EXPECT_NEAR(properties.Mass(), 10 * 10 * 2 + 2 * 10 * 10, 1e-9);
  std::multiset<int> numbers;
  for (const SkinFace& face : joined[0].faces()) numbers.insert(face.number());
  EXPECT_EQ(std::set<int>(numbers.begin(), numbers.end()).size(), 11U)
      << "one of the twelve lay in the material";
  EXPECT_EQ(*numbers.begin(), 1);
}

}  // namespace
}  // namespace quadrille
