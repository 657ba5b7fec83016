/// Parts that touch or cross share faces and lines afterwards, and numbers and names follow.

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
#include "mesher/settings.hpp"
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

TEST(Imprinting, TellsWhatEdgesAndVerticesBecame) {
  const CadModel apart = model_of({rod_in_sleeve(), BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), 30, 30, 3).Shape()}),
                 model = apart.imprinted();
  ASSERT_EQ(model.edge_pieces().size(), static_cast<std::size_t>(apart.edge_count()));
  ASSERT_EQ(model.vertex_pieces().size(), static_cast<std::size_t>(apart.vertex_count()));
  for (int edge = 1; edge <= apart.edge_count(); ++edge) {
    double length = 0;
    for (const int piece : model.edge_pieces()[edge - 1])
      length += model.shape().edges[EdgeId::from_number(piece)].length;
    EXPECT_NEAR(length, apart.shape().edges[EdgeId::from_number(edge)].length, 1e-6) << edge;
  }
  for (int vertex = 1; vertex <= apart.vertex_count(); ++vertex) {
    const std::vector<int>& own = model.vertex_pieces()[vertex - 1];
    ASSERT_EQ(own.size(), 1u);
    const Vector3 moved = model.shape().vertices[VertexId::from_number(own.front())] -
                          apart.shape().vertices[VertexId::from_number(vertex)];
    EXPECT_LT(moved.norm(), 1e-6);
  }
}

/// Names in settings are those before; of a piece that two have in common, the smaller size holds.
TEST(Imprinting, NamesStandForAllPieces) {
  const CadModel apart = two_boxes(), model = apart.imprinted();
  const auto& pieces = model.pieces();
  const auto cut = std::find_if(pieces.begin(), pieces.end(), [](const auto& own) { return own.size() > 1; });
  ASSERT_NE(cut, pieces.end());
  const int top = static_cast<int>(cut - pieces.begin()) + 1;
  int foot = 0;  // of the upper box, one of the pieces of the lower one's top
  for (int face = 1; face <= 12; ++face)
    if (face != top && std::find(cut->begin(), cut->end(), pieces[face - 1].front()) != cut->end())
      foot = face;
  ASSERT_GT(foot, 0);

  Settings settings;
  settings.mesh.faces = {top, foot};
  settings.mesh.sizing.face_sizes = {{top, 0.5}, {foot, 0.25}};
  settings.mesh.sizing.spacings[1].segments = 7;
  const Settings renamed = with_pieces(settings, model);
  EXPECT_EQ(renamed.mesh.faces, *cut);
  const int shared = pieces[foot - 1].front();
  for (const int piece : *cut)
    EXPECT_EQ(renamed.mesh.sizing.face_sizes.at(piece), piece == shared ? 0.25 : 0.5);
  EXPECT_EQ(renamed.mesh.sizing.face_sizes.size(), cut->size());
  EXPECT_EQ(renamed.mesh.sizing.spacings.at(model.edge_pieces()[0].front()).segments, 7);
  EXPECT_EQ(with_pieces(settings, apart).mesh.faces, settings.mesh.faces);

  settings.mesh.faces = {13};
  EXPECT_THROW(with_pieces(settings, model), Error);
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
