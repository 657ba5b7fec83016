/// Quads cross smooth edges where these force them outside the limits, and only there.

#include "mesher/shell/crossed_edges.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesher/io/report.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/process.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Two faces in a plane, between them an edge that meets the rim at 11 degrees: its number is in `edge`.
CadModel plate_with_slanted_edge(int& edge) {
  CadModel model = sheet({{{0, 0}, {40, 0}, {40, 8}}, {{0, 0}, {40, 8}, {40, 20}, {0, 20}}});
  for (const CadEdge& cad : model.shape().edges)
    if (cad.faces.size() == 2) edge = cad.number;
  return model;
}

/// A box with three rounded edges of radius 0.5 that meet at a corner.
CadModel rounded_box() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  int count = 0;
  for (TopExp_Explorer at(box, TopAbs_EDGE); at.More(); at.Next())
    if (count++ % 3 == 0) fillet.Add(0.5, TopoDS::Edge(at.Current()));
  return CadModel(std::make_shared<CadShape>(fillet.Shape(), "rounded_box"));
}

ShellMesh meshed(const CadModel& model, double size, MeshOptions options = {}, int threads = 1) {
  options.sizing.size = size;
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

double outside(const ShellMesh& mesh) {
  return static_cast<double>(check_criteria(mesh).failing) / static_cast<double>(mesh.quads.size());
}

double area(const ShellMesh& mesh, int face) {
  double sum = 0;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    const auto& [a, b, c, d] = mesh.quads[q];
    const auto& p = mesh.points;
    if (mesh.quad_faces[q] == face) sum += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm();
  }
  return sum;
}

std::ptrdiff_t segments(const ShellMesh& mesh, int edge) {
  return std::count_if(mesh.segments.begin(), mesh.segments.end(),
                       [&](const auto& segment) { return segment.edge == edge; });
}

TEST(EdgeSuppression, CrossesAnEdgeThatForcesPoorQuads) {
  int edge = 0;
  const CadModel model = plate_with_slanted_edge(edge);
  MeshOptions keep;
  keep.sizing.kept_edges = {edge};
  const ShellMesh crossed = meshed(model, 1.5), whole = meshed(model, 1.5, keep);
  for (const ShellMesh* mesh : {&crossed, &whole}) {
    EXPECT_EQ(validate(*mesh), std::vector<std::string>{});
    EXPECT_NEAR(area(*mesh, 1) + area(*mesh, 2), 800, 0.1);  // but for the tip
    for (const Vector3& point : mesh->points) EXPECT_EQ(point.z(), 0);
  }
  ASSERT_EQ(crossed.crossed_edges.size(), 1U);
  EXPECT_EQ(crossed.crossed_edges[0].edge, edge);
  EXPECT_TRUE(whole.crossed_edges.empty());
  EXPECT_LT(10 * segments(crossed, edge), segments(whole, edge));  // those of the tip stay
  EXPECT_LT(outside(crossed), 0.5 * outside(whole));
  // Faces keep their area, as far as quads follow the edge.
  EXPECT_NEAR(area(crossed, 1) / 160, 1, 0.1);
}

TEST(EdgeSuppression, LeavesWhatUsersName) {
  int edge = 0;
  const CadModel model = plate_with_slanted_edge(edge);
  std::vector<MeshOptions> all(4);
  all[0].keep_features = true;
  all[1].sizing.kept_faces = {1};
  all[2].sizing.edge_sizes = {{edge, 1.5}};
  all[3].sizing.spacings[edge].segments = 30;
  for (const MeshOptions& options : all) {
    const ShellMesh mesh = meshed(model, 1.5, options);
    EXPECT_TRUE(mesh.crossed_edges.empty());
    EXPECT_GT(segments(mesh, edge), 20);
  }
}

TEST(EdgeSuppression, LeavesEdgesWithoutPoorQuadsAndCreases) {
  for (const double size : {2.0, 4.0}) {
    const ShellMesh flat =
        meshed(sheet({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{20, 0}, {40, 0}, {40, 20}, {20, 20}}}), size);
    EXPECT_TRUE(flat.crossed_edges.empty());
    const CadModel box(std::make_shared<CadShape>(BRepPrimAPI_MakeBox(40, 30, 1).Shape(), "box"));
    EXPECT_TRUE(meshed(box, size).crossed_edges.empty());
  }
}

TEST(EdgeSuppression, KeepsSolidsClosedAndNodesOnTheirFaces) {
  const CadModel model = rounded_box();
  for (const int order : {1, 2}) {
    MeshOptions options;
    options.order = order;
    options.sizing.elements_per_circle = 8;
    const ShellMesh mesh = meshed(model, 6, options);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    for (const Vector3& p : mesh.points) {
      BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(gp_Pnt(p.x(), p.y(), p.z())),
                                          model.shape().shape);
      EXPECT_LT(distance.Value(), order == 2 ? 0.05 : 1e-4);
    }
    for (const auto& edge : mesh.crossed_edges) EXPECT_EQ(segments(mesh, edge.edge), 0);
  }
}

/// The distance of a point from the nearest of close points of the quads.
double distance_from_quads(const ShellMesh& mesh, const Vector3& point) {
  constexpr int steps = 40;
  double least = std::numeric_limits<double>::max();
  for (const auto& [a, b, c, d] : mesh.quads) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
        const auto& p = mesh.points;
        const Vector3 at = (1 - v) * ((1 - u) * p[a] + u * p[b]) + v * ((1 - u) * p[d] + u * p[c]);
        least = std::min(least, (at - point).norm());
      }
    }
  }
  return least;
}

TEST(EdgeSuppression, ReportsTellHowFarEdgesLieFromTheQuads) {
  int edge = 0;
  ExecutionContext context(1);
  const auto reported = [&](const ShellMesh& mesh) {
    return make_report(mesh, measure(mesh), context, "")["crossed_edges"];
  };
  const auto flat = reported(meshed(plate_with_slanted_edge(edge), 1.5));
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_NEAR(flat[0]["distance"], 0, 1e-9);
  MeshOptions options;
  options.sizing.elements_per_circle = 8;
  const ShellMesh mesh = meshed(rounded_box(), 6, options);
  const auto round = reported(mesh);
  ASSERT_EQ(round.size(), mesh.crossed_edges.size());
  double most = 0;
  for (std::size_t i = 0; i < round.size(); ++i) {
    double farthest = 0;
    for (const Vector3& point : mesh.crossed_edges[i].line)
      farthest = std::max(farthest, distance_from_quads(mesh, point));
    EXPECT_NEAR(round[i]["distance"], farthest, 0.05);
    most = std::max(most, farthest);
  }
  EXPECT_GT(most, 0.01);
}

/// What CalculiX prints as the total reaction in z to a pressure of 1 on the elements of one face's group,
/// where the nodes at x = -10 are held.
double reaction(const ShellMesh& mesh, int face, const test::TemporaryFolder& folder) {
  std::string rim;
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    if (mesh.points[node].x() < -9.99) rim += fmt::format("{}\n", node + 1);
  write_mesh(mesh, folder / "mesh.inp");
  test::write_text(
      folder / "job.inp",
      fmt::format("*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=Steel\n*ELASTIC\n210000, 0.3\n*SHELL SECTION, "
                  "ELSET=Eall, MATERIAL=Steel\n1\n*NSET, NSET=Rim\n{}*BOUNDARY\nRim, 1, 6\n*STEP\n*STATIC\n"
                  "*DLOAD\nFace{}, P, 1\n*NODE PRINT, NSET=Rim, TOTALS=ONLY\nRF\n*END STEP\n",
                  rim, face));
  const test::ProcessResult run = test::run(
      "cd '" + folder.path().string() +
      "' && OMP_NUM_THREADS=1 timeout 120 ccx job >log.txt 2>&1; grep -A2 'total force' job.dat | tail -1");
  double x = 0, y = 0, z = 0;
  EXPECT_EQ(std::sscanf(run.out.c_str(), "%lf %lf %lf", &x, &y, &z), 3) << run.out;
  return std::abs(z);
}

TEST(EdgeSuppression, LoadsOnCrossedFacesSumUpInCalculix) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "CalculiX (ccx) is not installed";
  // The plate with the slanted edge, and a strip beside it that is held.
  const CadModel model = sheet({{{0, 0}, {40, 0}, {40, 8}},
                                {{0, 0}, {40, 8}, {40, 20}, {0, 20}},
                                {{-10, 0}, {0, 0}, {0, 20}, {-10, 20}}});
  MeshOptions options;
  for (const CadEdge& cad : model.shape().edges)
    if (cad.faces.size() == 2 && cad.length < 30) options.sizing.kept_edges.insert(cad.number);
  const ShellMesh mesh = meshed(model, 2, options);
  ASSERT_EQ(mesh.crossed_edges.size(), 1U);
  const test::TemporaryFolder folder;
  const double triangle = reaction(mesh, 1, folder), rest = reaction(mesh, 2, folder);
  EXPECT_NEAR(triangle + rest, 800, 0.8);  // the areas of the CAD faces are 160 and 640
  EXPECT_NEAR(triangle, 160, 8);
}

TEST(EdgeSuppression, IsTheSameOnAnyNumberOfThreads) {
  const CadModel model = rounded_box();
  const ShellMesh one = meshed(model, 3), four = meshed(model, 3, {}, 4);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.quads, four.quads);
  EXPECT_EQ(one.crossed_edges, four.crossed_edges);
}

}  // namespace
}  // namespace quadrille
