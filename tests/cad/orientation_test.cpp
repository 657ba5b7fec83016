/// Faces that share edges are turned alike, the fewer of them in each piece.

#include "geometry/cad/orientation.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>

namespace quadrille {
namespace {

TopoDS_Face square(int x) {
  return BRepBuilderAPI_MakeFace(gp_Pln(), x, x + 1, 0, 1).Face();
}

/// Squares side by side that share edges, some of them (numbers from 1) turned over.
std::vector<TopoDS_Shape> row(int count, const std::vector<int>& turned) {
  BRepBuilderAPI_Sewing sewing(1e-6);
  for (int x = 0; x < count; ++x) sewing.Add(square(x));
  sewing.Perform();
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer it(sewing.SewedShape(), TopAbs_FACE); it.More(); it.Next())
    faces.push_back(it.Current().Oriented(TopAbs_FORWARD));
  for (const int number : turned) faces[number - 1].Reverse();
  return faces;
}

std::vector<char> free_of(const std::vector<TopoDS_Shape>& faces) {
  return std::vector<char>(faces.size(), 0);
}

TEST(OrientAlike, TurnsTheFewerFacesWhicheverTheyAre) {
  for (const std::vector<int>& turned : std::vector<std::vector<int>>{{}, {1}, {2, 4}, {5}, {1, 2, 4}}) {
    std::vector<TopoDS_Shape> faces = row(5, turned);
    const Orientation result = orient_alike(faces, free_of(faces));
    std::vector<int> fewer = turned;
    if (turned.size() == 3) fewer = {3, 5};
    EXPECT_EQ(result.turned, fewer);
    EXPECT_TRUE(result.unlike.empty());
    for (const TopoDS_Shape& face : faces) EXPECT_EQ(face.Orientation(), faces[0].Orientation());
  }
}

TEST(OrientAlike, LeavesFixedFacesAndWhatLiesBehindThem) {
  std::vector<TopoDS_Shape> faces = row(4, {1, 3});
  std::vector<char> fixed = free_of(faces);
  fixed[1] = 1;  // so that Face1 stands alone, and Face3 with Face4
  const Orientation result = orient_alike(faces, fixed);
  EXPECT_EQ(result.turned.size(), 1U);
  EXPECT_EQ(faces[0].Orientation(), TopAbs_REVERSED);
  EXPECT_EQ(faces[1].Orientation(), TopAbs_FORWARD);
  EXPECT_EQ(faces[2].Orientation(), faces[3].Orientation());
}

/// Face1 and a square far away were cut from one face, so they are turned together.
TEST(OrientAlike, TurnsThePiecesOfAFaceTogether) {
  const auto turned = [](const std::vector<std::vector<int>>& pieces) {
    std::vector<TopoDS_Shape> faces = row(5, {1});
    faces.push_back(square(20));
    return orient_alike(faces, free_of(faces), pieces).turned;
  };
  EXPECT_EQ(turned({}), std::vector<int>{1});
  EXPECT_EQ(turned({{1, 6}}), (std::vector<int>{1, 6}));
  EXPECT_EQ(turned({{1, 6}, {6}}), std::vector<int>{1});  // a piece of two faces says nothing
}

TEST(OrientAlike, TellsAnEdgeOfThreeFaces) {
  std::vector<TopoDS_Shape> faces = row(2, {});
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(faces[0], TopAbs_EDGE, edges);
  int shared = 0;
  for (TopExp_Explorer it(faces[1], TopAbs_EDGE); it.More(); it.Next())
    shared = std::max(shared, edges.FindIndex(it.Current()));
  ASSERT_GT(shared, 0);
  faces.push_back(faces[1].EmptyCopied());
  const TopExp_Explorer source(faces[1], TopAbs_WIRE);
  BRep_Builder().Add(faces[2], source.Current());
  EXPECT_EQ(orient_alike(faces, free_of(faces)).unlike.front(), shared);
}

TEST(OrientAlike, KnowsTheFacesOfSolids) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, square(7));
  builder.Add(both, BRepPrimAPI_MakeBox(1, 2, 3).Shape());
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(both, TopAbs_FACE, faces);
  EXPECT_EQ(faces_in_solids(both, faces), (std::vector<char>{0, 1, 1, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace quadrille
