#include "geometry/cad/imprinting.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <gp_Pln.hxx>
#include <set>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/surface_cut.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/models/trouble_models.hpp"

namespace quadrille {
namespace {

CadModel model_of(const std::vector<TopoDS_Shape>& parts) {
  return CadModel(std::make_shared<CadShape>(compound(parts), "parts"));
}

/// A box of 10, and a smaller one that stands on the middle of its top.
CadModel two_boxes() {
  return model_of({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape(),
                   BRepPrimAPI_MakeBox(gp_Pnt(3, 3, 10), gp_Pnt(7, 7, 16)).Shape()});
}

/// Two plates of 20 by 20 that cross in the middle.
CadModel crossing_plates() {
  return model_of({BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), gp::DZ()), -10, 10, -10, 10).Face(),
                   BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), gp::DX()), -10, 10, -10, 10).Face()});
}

/// Nodes that lie where an earlier one lies.
int repeated(const std::vector<Vector3>& points) {
  const std::vector<int> first = coincident_points(points, 1e-6);
  int count = 0;
  for (int i = 0; i < static_cast<int>(first.size()); ++i) count += first[i] != i;
  return count;
}

ShellMesh meshed(const CadModel& model) {
  MeshOptions options;
  options.sizing.size = 1;
  ExecutionContext context;
  return mesh(model, options, context);
}

void expect_joined(const CadModel& model) {
  const ShellMesh mesh = meshed(model);
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_EQ(repeated(mesh.points), 0);
  std::vector<Vector3> middles;
  for (const auto& quad : mesh.quads)
    middles.push_back(
        (mesh.points[quad[0]] + mesh.points[quad[1]] + mesh.points[quad[2]] + mesh.points[quad[3]]) / 4);
  EXPECT_EQ(repeated(middles), 0);  // no quad lies on another
}

TEST(Imprinting, BoxesThatTouchShareAFace) {
  const CadModel apart = two_boxes(), model = apart.imprinted();
  EXPECT_EQ(apart.face_count(), 12);
  EXPECT_EQ(model.face_count(),
            12);  // the lower one's top is cut in two, and one of these is the upper's foot
  EXPECT_EQ(model.solid_count(), 2);
  EXPECT_NEAR(model.area(), apart.area() - 16, 1e-6);
  expect_joined(model);
}

/// Only the face that was cut and the one that is shared are told; the others keep their numbers.
TEST(Imprinting, FacesKeepTheirNumbers) {
  const CadModel apart = two_boxes(), model = apart.imprinted();
  ASSERT_EQ(model.pieces().size(), 12u);
  int changed = 0;
  std::set<int> numbers;
  for (int face = 1; face <= 12; ++face) {
    const std::vector<int>& own = model.pieces()[face - 1];
    EXPECT_TRUE(std::find(own.begin(), own.end(), face) != own.end()) << face;
    changed += own.size() > 1;
    numbers.insert(own.begin(), own.end());
  }
  EXPECT_EQ(changed, 1);
  EXPECT_EQ(numbers.size(), 12u);
  ASSERT_EQ(changes_of_faces(model.pieces()).size(), 2u);
  ASSERT_FALSE(model.problems().empty());
  EXPECT_NE(model.problems().back().find("(shared)"), std::string::npos) << model.problems().back();
}

TEST(Imprinting, ARodSharesItsSleevesHole) {
  const CadModel apart = model_of({rod_in_sleeve()}), model = apart.imprinted();
  EXPECT_EQ(model.face_count(), apart.face_count() - 1 + 2);
  EXPECT_EQ(model.solid_count(), 2);
  EXPECT_GT(repeated(meshed(apart).points), 0);
  expect_joined(model);
}

TEST(Imprinting, PlatesThatCrossShareTheirLine) {
  const CadModel model = crossing_plates().imprinted();
  EXPECT_EQ(model.face_count(), 4);
  EXPECT_EQ(model.edge_count(), 13);
  expect_joined(model);
}

TEST(Imprinting, PlatesOfOneShellThatCrossShareTheirLine) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const gp_Dir& normal : {gp::DZ(), gp::DX()})
    builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(gp::Origin(), normal), -10, 10, -10, 10).Face());
  EXPECT_EQ(model_of({shell}).imprinted().face_count(), 4);
}

TEST(Imprinting, OverlappingSolidsShareWhatTheyHaveInCommon) {
  const CadModel model = model_of({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape(),
                                   BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 5), gp_Pnt(15, 15, 15)).Shape()})
                             .imprinted();
  EXPECT_EQ(model.solid_count(), 3);
  expect_joined(model);
}

TEST(Imprinting, ASinglePartStaysAsItIs) {
  const CadModel box = model_of({BRepPrimAPI_MakeBox(1, 2, 3).Shape()}), model = box.imprinted();
  EXPECT_EQ(model.face_count(), 6);
  EXPECT_EQ(model.edge_count(), 12);
  EXPECT_TRUE(model.problems().empty());
}

/// Boxes with a gap of 0.01 between them touch if that is the tolerance.
TEST(Imprinting, ATolerancesBridgesGaps) {
  const CadModel apart = model_of({BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(10, 10, 10)).Shape(),
                                   BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 10.01), gp_Pnt(10, 10, 16)).Shape()});
  EXPECT_EQ(apart.imprinted().face_count(), 12);
  EXPECT_EQ(apart.imprinted(0.02).face_count(), 11);
  EXPECT_THROW(apart.imprinted(1e6), Error);
}

}  // namespace
}  // namespace quadrille
