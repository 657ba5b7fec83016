/// Faces end before corners that are too narrow.

#include "mesher/edges/slivers.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "mesher/edges/tiny_features.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// A plate of 100 by 100, with a wedge between two faces: its tip lies at (10, 50), its base at x = 100.
CadModel plate_with_wedge(double base) {
  const double low = 50 - 0.5 * base, high = 50 + 0.5 * base;
  return sheet({{{10, 50}, {100, low}, {100, high}},
                {{0, 0}, {100, 0}, {100, low}, {10, 50}, {0, 50}},
                {{0, 50}, {10, 50}, {100, high}, {100, 100}, {0, 100}}});
}

struct Found {
  std::vector<EdgeCut> cuts;
  std::vector<Sliver> spikes;  // once the edges are divided
};

Found spikes_of(const CadModel& model, double width) {
  Found found;
  EdgeEnds taken;
  const FaceFlags used(model.face_count(), 1);
  for (const FaceId face : used.ids()) find_spikes(model.shape(), used, face, width, taken, found.cuts);
  const auto divided = divided_at_slivers(model.shape(), used, width);
  found.spikes = find_slivers(divided ? *divided : model.shape(), used, width);
  return found;
}

ShellMesh meshed(const CadModel& model, MeshOptions options = {}) {
  options.sizing.size = 10;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

/// Whether the face's note says that it ends early.
bool ends_early(const ShellMesh& mesh, int face) {
  return mesh.faces[face - 1].note.find("ends before a corner") != std::string::npos;
}

TEST(Spikes, AreFoundWhereTwoEdgesStayCloserThanTheWidth) {
  const CadModel model = plate_with_wedge(10);
  const Found found = spikes_of(model, 0.625);
  ASSERT_EQ(found.cuts.size(), 2U);
  for (const EdgeCut& cut : found.cuts) {
    const auto& faces = model.shape().edges[cut.edge].faces;
    EXPECT_EQ(faces.front().number(), 1);
    EXPECT_NEAR(cut.point.x(), 10 + 0.9 * 0.625 / 10 * 90, 0.1);
  }
  ASSERT_EQ(found.spikes.size(), 1U);
  EXPECT_TRUE(found.spikes[0].is_spike);
  EXPECT_EQ(found.spikes[0].face.number(), 1);
}

TEST(Spikes, AreNoneWithoutAWidthOrInBluntCorners) {
  EXPECT_TRUE(spikes_of(plate_with_wedge(10), 0).spikes.empty());
  EXPECT_TRUE(spikes_of(plate_with_wedge(60), 0.625).spikes.empty());
  EXPECT_TRUE(spikes_of(plate_with_wedge(60), 0.625).cuts.empty());
}

/// A plate with a slit of no width at its end: the face lies around it, not between its sides.
TEST(Spikes, AreNoSlits) {
  const CadModel model =
      sheet({{{0, 0}, {100, 0}, {100, 49.9}, {40, 50}, {100, 50.1}, {100, 100}, {0, 100}}});
  EXPECT_TRUE(spikes_of(model, 0.6).cuts.empty());
  EXPECT_TRUE(spikes_of(model, 0.6).spikes.empty());
}

/// A short edge that lies along all of its neighbor's beginning.
TEST(Spikes, BeginAtShortEdges) {
  const CadModel model = sheet({{{0, 0}, {50, 0}, {52, 0.2}, {50, 0.4}, {50, 30}, {0, 30}},
                                {{50, 0}, {50, -30}, {80, -30}, {80, 30}, {50, 30}, {50, 0.4}, {52, 0.2}}});
  const Found found = spikes_of(model, 0.6);
  ASSERT_EQ(found.spikes.size(), 1U);
  EXPECT_EQ(found.spikes[0].face.number(), 1);
  const ShellMesh mesh = meshed(model);
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_TRUE(ends_early(mesh, 1));
}

TEST(Spikes, AreLeftOutOfTheMesh) {
  const CadModel model = plate_with_wedge(10);
  const ShellMesh early = meshed(model);
  MeshOptions options;
  options.keep_features = true;
  const ShellMesh whole = meshed(model, options);
  for (const ShellMesh* mesh : {&early, &whole}) EXPECT_EQ(validate(*mesh), std::vector<std::string>{});
  EXPECT_TRUE(ends_early(early, 1));
  EXPECT_FALSE(ends_early(whole, 1));
  EXPECT_LE(check_criteria(early).failing, check_criteria(whole).failing);
  // The wedge is 5.6 long where it is narrower than half the minimum size, 0.625.
  const auto first = [](const ShellMesh& mesh) {
    double least = 100;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      if (mesh.quad_faces[i] != 1) continue;
      for (const int node : mesh.quads[i]) least = std::min(least, mesh.points[node].x());
    }
    return least;
  };
  EXPECT_NEAR(first(whole), 10, 1e-6);
  EXPECT_GT(first(early), 11);
  EXPECT_LT(first(early), 20);  // nodes slide: quads may cross the edge
  // Nothing is open but the rim of the plate, and the whole plate is covered.
  double area = 0;
  for (const auto& [a, b, c, d] : early.quads) {
    const auto& p = early.points;
    area += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm();
  }
  EXPECT_NEAR(area, 100 * 100, 1e-6);
}

TEST(Spikes, ForceTheQuadsBesideThem) {
  const CadModel model(std::make_shared<CadShape>(BRepPrimAPI_MakeWedge(30, 100, 60, 0).Shape(), "wedge"));
  const ShellMesh mesh = meshed(model);
  bool any = false;
  for (const ShellMesh::PoorQuads& found : mesh.poor_quads)
    any |= found.cause == ShellMesh::PoorQuads::Cause::corner &&
           found.why.find("at Vertex") != std::string::npos;
  EXPECT_TRUE(any);
}

TEST(Spikes, StayBesideEdgesThatUsersDivide) {
  const CadModel model = plate_with_wedge(10);
  MeshOptions options;
  options.sizing.spacings[model.shape().edges[spikes_of(model, 0.625).cuts.at(0).edge].number] = {.segments =
                                                                                                      40};
  EXPECT_FALSE(ends_early(meshed(model, options), 1));
}

TEST(Spikes, EndMeshesOfTheSecondOrderToo) {
  MeshOptions options;
  options.order = 2;
  const ShellMesh mesh = meshed(plate_with_wedge(10), options);
  EXPECT_TRUE(ends_early(mesh, 1));
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
}

/// A disc of radius 20, cut in two along a circle that touches its rim from inside. Each circle is one edge.
CadModel disc_with_touching_circle(double radius) {
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(20, 0, 0));
  const auto circle = [&](double of) {
    const gp_Circ curve(gp_Ax2(gp_Pnt(20 - of, 0, 0), gp::DZ()), of);
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve, vertex, vertex).Edge()).Wire();
  };
  const TopoDS_Wire rim = circle(20), inner = circle(radius);
  BRepBuilderAPI_MakeFace around(gp_Pln(gp::XOY()), rim);
  around.Add(TopoDS::Wire(inner.Reversed()));
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, around.Face());
  builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), inner).Face());
  return CadModel(std::make_shared<CadShape>(shell, "disc"));
}

TEST(Spikes, LieOnBothSidesOfAVertexWhereWiresTouch) {
  const Found found = spikes_of(disc_with_touching_circle(12), 0.3);
  EXPECT_EQ(found.cuts.size(), 4U);
  ASSERT_EQ(found.spikes.size(), 2U);
  for (const Sliver& spike : found.spikes) EXPECT_EQ(spike.face.number(), 1);
}

TEST(Spikes, EndWhereWiresTouch) {
  const CadModel model = disc_with_touching_circle(12);
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    MeshOptions options;
    options.sizing.size = 2;
    options.order = 2;
    options.strategy = strategy;
    ExecutionContext context(1);
    const ShellMesh early = mesh(model, options, context);
    options.keep_features = true;
    const ShellMesh whole = mesh(model, options, context);
    for (const ShellMesh* mesh : {&early, &whole}) EXPECT_EQ(validate(*mesh), std::vector<std::string>{});
    EXPECT_TRUE(ends_early(early, 1));
    EXPECT_FALSE(ends_early(early, 2));
    EXPECT_FALSE(ends_early(whole, 1));
    EXPECT_LT(check_criteria(early).failing, check_criteria(whole).failing);
    EXPECT_TRUE(area_differences(model, early).empty());
    // No quad of the outer face has the vertex where the circles touch.
    for (std::size_t i = 0; i < early.quads.size(); ++i) {
      if (early.quad_faces[i] != 1) continue;
      for (const int node : early.quads[i]) EXPECT_GT((early.points[node] - Vector3(20, 0, 0)).norm(), 1);
    }
  }
}

}  // namespace
}  // namespace quadrille
