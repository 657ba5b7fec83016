/// Faces and edges with the same nodes: each node of one is that of the other, moved, whatever both are like.

#include "mesher/edges/matching.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/io/io.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

constexpr double pi = 3.14159265358979323846;

CadModel model_of(const TopoDS_Shape& shape, const char* name) {
  return CadModel(std::make_shared<CadShape>(shape, name));
}

CadModel drilled_box() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(60, 40, 20).Shape();
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-5, 15, 9), gp::DX()), 5, 80).Shape();
  return model_of(BRepAlgoAPI_Cut(box, drill).Shape(), "box");
}

TopoDS_Edge turned(const TopoDS_Edge& edge, double angle) {
  gp_Trsf turn;
  turn.SetRotation(gp::OZ(), angle);
  return TopoDS::Edge(BRepBuilderAPI_Transform(edge, turn, true).Shape());
}

/// A plane sector of a ring between two curved sides, as of a fan with bent blades.
TopoDS_Face sector_face(double angle, double bend) {
  TColgp_Array1OfPnt points(1, 7);
  for (int i = 0; i < 7; ++i) {
    const double r = 20 + 40 * i / 6.0, at = bend * std::sin(0.1 * r);
    points.SetValue(i + 1, gp_Pnt(r * std::cos(at), r * std::sin(at), 0));
  }
  const TopoDS_Edge first = BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(points).Curve()).Edge();
  const TopoDS_Edge second = turned(first, angle);
  const auto arc = [&](const gp_Pnt& from) {
    const gp_Pnt middle = from.Rotated(gp::OZ(), 0.5 * angle), to = from.Rotated(gp::OZ(), angle);
    return BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(from, middle, to).Value()).Edge();
  };
  BRepBuilderAPI_MakeWire wire(first, arc(points.Value(7)), second, arc(points.Value(1)));
  return BRepBuilderAPI_MakeFace(wire.Wire(), true).Face();
}

CadModel blade_sector(double bend = 0.15) {
  return model_of(BRepPrimAPI_MakePrism(sector_face(pi / 6, bend), gp_Vec(0, 0, 15)).Shape(), "sector");
}

/// The number of the first entity whose middle lies where it is wanted.
int face_at(const CadModel& model, const std::function<bool(const Vector3&)>& wanted) {
  for (const FaceId id : model.shape().faces.ids()) {
    const CadFace& face = model.shape().faces[id];
    if (wanted(FaceSurface(face).point({0.5 * (face.u_min + face.u_max), 0.5 * (face.v_min + face.v_max)})))
      return id.number();
  }
  ADD_FAILURE() << "no such face";
  return 1;
}
int edge_at(const CadModel& model, const std::function<bool(const Vector3&)>& wanted) {
  for (const CadEdge& edge : model.shape().edges)
    if (wanted(EdgeCurve(edge).point(0.5 * (edge.first + edge.last)))) return edge.number;
  ADD_FAILURE() << "no such edge";
  return 1;
}
auto lies_at(int coordinate, double value) {
  return [=](const Vector3& p) { return std::abs(p[coordinate] - value) < 1e-9; };
}
auto lies_at_angle(double angle, double bend) {
  return [=](const Vector3& p) {
    const double r = std::hypot(p.x(), p.y());
    return std::abs(std::atan2(p.y(), p.x()) - bend * std::sin(0.1 * r) - angle) < 0.02;
  };
}

MatchedPair faces(int first, int second) {
  return {2, first, second};
}

ShellMesh mesh_with(const CadModel& model, const std::vector<MatchedPair>& matches, MeshOptions options = {},
                    int threads = 1) {
  options.sizing.matches = matches;
  ExecutionContext context(threads);
  return mesh(model, options, context);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

/// The nodes on a face or edge.
std::set<int> nodes_on(const ShellMesh& mesh, int dimension, int number) {
  std::set<int> result;
  for (std::size_t i = 0; dimension == 2 && i < mesh.quads.size(); ++i) {
    if (mesh.quad_faces[i] != number) continue;
    result.insert(mesh.quads[i].begin(), mesh.quads[i].end());
    if (mesh.order == 2) result.insert(mesh.midsides[i].begin(), mesh.midsides[i].end());
  }
  for (const auto& segment : mesh.segments) {
    if (dimension != 1 || segment.edge != number) continue;
    result.insert(segment.nodes.begin(), segment.nodes.end());
    if (mesh.order == 2) result.insert(segment.middle);
  }
  return result;
}

/// Each node of the first is paired once with one of the second, which lies where it goes.
void expect_matched(const ShellMesh& mesh, const CadModel& model) {
  EXPECT_EQ(joined(validate(mesh)), "");
  ASSERT_FALSE(mesh.matches.empty());
  for (const auto& match : mesh.matches) {
    SCOPED_TRACE(match.entities[0]);
    std::set<int> from, to;
    double apart = 0;
    for (const auto& [a, b] : match.nodes) {
      EXPECT_TRUE(from.insert(a).second && to.insert(b).second);
      apart = std::max(apart, (match.motion(mesh.points[a]) - mesh.points[b]).norm());
    }
    EXPECT_LT(apart, 1e-9 * model.diagonal());
    EXPECT_EQ(from, nodes_on(mesh, match.dimension, match.entities[0]));
    EXPECT_EQ(to, nodes_on(mesh, match.dimension, match.entities[1]));
    EXPECT_FALSE(from.empty());
  }
}

TEST(Matching, FacesOfABoxAreTranslated) {
  const CadModel model = drilled_box();
  const int left = face_at(model, lies_at(0, 0)), right = face_at(model, lies_at(0, 60));
  for (const int order : {1, 2}) {
    for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
      SCOPED_TRACE(order);
      MeshOptions options;
      options.order = order;
      options.strategy = strategy;
      options.sizing.size = 4;
      // One side asks for more nodes on its edges than the other.
      options.sizing.edge_sizes[edge_at(
          model, [](const Vector3& p) { return std::abs(p.x() - 60) + std::abs(p.z() - 20) < 1e-9; })] = 1;
      const ShellMesh mesh = mesh_with(model, {faces(left, right)}, options);
      expect_matched(mesh, model);
      EXPECT_EQ(mesh.matches[0].motion.angle, 0);
      EXPECT_LT((mesh.matches[0].motion.translation - Vector3(60, 0, 0)).norm(), 1e-9);
    }
  }
}

TEST(Matching, FacesOfASectorAreTurned) {
  for (const double bend : {0.0, 0.15}) {
    const CadModel model = blade_sector(bend);
    const int first = face_at(model, lies_at_angle(0, bend)),
              second = face_at(model, lies_at_angle(pi / 6, bend));
    for (const int order : {1, 2}) {
      SCOPED_TRACE(order);
      MeshOptions options;
      options.order = order;
      options.sizing.size = 3;
      const ShellMesh mesh = mesh_with(model, {faces(first, second)}, options);
      expect_matched(mesh, model);
      EXPECT_NEAR(mesh.matches[0].motion.angle, pi / 6, 1e-9);
      EXPECT_LT(mesh.matches[0].motion.axis.cross(Vector3::UnitZ()).norm(), 1e-9);
      EXPECT_LT(mesh.matches[0].motion.center.norm(), 1e-7);
    }
  }
}

TEST(Matching, WhatBothFacesShareStays) {
  const CadModel model =
      model_of(BRepPrimAPI_MakeCylinder(gp_Ax2(gp::Origin(), gp::DZ()), 30, 20, pi / 6).Shape(), "wedge");
  const int first = face_at(model, lies_at(1, 0)), second = face_at(model, [](const Vector3&p) {
                                                     return std::abs(p.y() - p.x() * std::tan(pi / 6)) < 1e-9;
                                                   });
  const ShellMesh mesh = mesh_with(model, {faces(first, second)});
  expect_matched(mesh, model);
  EXPECT_NEAR(mesh.matches[0].motion.angle, pi / 6, 1e-9);
  EXPECT_TRUE(std::any_of(mesh.matches[0].nodes.begin(), mesh.matches[0].nodes.end(),
                          [](const auto& pair) { return pair[0] == pair[1]; }));
}

TEST(Matching, ABoxCanBePeriodicInAllDirections) {
  const CadModel model = model_of(BRepPrimAPI_MakeBox(20, 20, 20).Shape(), "cube");
  std::vector<MatchedPair> pairs;
  for (const int k : {0, 1, 2})
    pairs.push_back(faces(face_at(model, lies_at(k, 0)), face_at(model, lies_at(k, 20))));
  std::swap(pairs[1].first, pairs[1].second);
  MeshOptions options;
  options.sizing.size = 3;
  options.order = 2;
  options.sizing.vertex_sizes[1] = 0.5;
  const ShellMesh mesh = mesh_with(model, pairs, options);
  expect_matched(mesh, model);
  for (const auto& match : mesh.matches) EXPECT_EQ(match.motion.angle, 0);
}

TEST(Matching, EdgesAreMatchedAlone) {
  const CadModel plate = model_of(sector_face(pi / 6, 0.15), "sheet");
  const int first = edge_at(plate, lies_at_angle(0, 0.15)),
            second = edge_at(plate, lies_at_angle(pi / 6, 0.15));
  const CadModel box = drilled_box();
  const auto along_z = [&](double x, double y) {
    return edge_at(box, [=](const Vector3& p) { return (p - Vector3(x, y, 10)).norm() < 1e-9; });
  };
  for (const int order : {1, 2}) {
    MeshOptions options;
    options.order = order;
    const ShellMesh sheet = mesh_with(plate, {{1, first, second}}, options);
    expect_matched(sheet, plate);
    EXPECT_NEAR(sheet.matches[0].motion.angle, pi / 6, 1e-9);
    options.sizing.edge_sizes[along_z(60, 40)] = 0.7;
    const ShellMesh solid = mesh_with(box, {{1, along_z(0, 0), along_z(60, 40)}}, options);
    expect_matched(solid, box);
    EXPECT_EQ(solid.matches[0].motion.angle, 0);
  }
}

TEST(Matching, IsTheSameOnAnyNumberOfThreads) {
  const CadModel model = blade_sector();
  const std::vector<MatchedPair> pairs{
      faces(face_at(model, lies_at_angle(0, 0.15)), face_at(model, lies_at_angle(pi / 6, 0.15)))};
  const ShellMesh one = mesh_with(model, pairs, {}, 1), two = mesh_with(model, pairs, {}, 2);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.matches[0].nodes, two.matches[0].nodes);
}

/// The message with which a match is refused.
std::string refusal(const CadModel& model, const std::vector<MatchedPair>& pairs, MeshOptions options = {}) {
  try {
    mesh_with(model, pairs, std::move(options));
  } catch (const Error& error) {
    EXPECT_EQ(error.subject(), "match");
    return error.what();
  }
  return "";
}

TEST(Matching, WhatNoMotionMapsIsRefused) {
  const CadModel model = model_of(BRepPrimAPI_MakeBox(60, 40, 20).Shape(), "box");
  const int left = face_at(model, lies_at(0, 0)), right = face_at(model, lies_at(0, 60)),
            front = face_at(model, lies_at(1, 0));
  const std::string text = refusal(model, {faces(left, front)});
  EXPECT_NE(text.find("Face" + std::to_string(front)), std::string::npos) << text;
  EXPECT_NE(text.find(" mm apart"), std::string::npos) << text;
  MeshOptions options;
  options.faces = {left, front};
  EXPECT_NE(refusal(model, {faces(left, right)}, options).find("not among the faces to mesh"),
            std::string::npos);
}

TEST(Matching, FilesTellThePairs) {
  const CadModel model = drilled_box();
  const int left = face_at(model, lies_at(0, 0)), right = face_at(model, lies_at(0, 60));
  const ShellMesh mesh = mesh_with(model, {faces(left, right)});
  const test::TemporaryFolder folder;
  write_mesh(mesh, folder / "box.inp", {});
  const std::string inp = test::file_text(folder / "box.inp");
  EXPECT_NE(inp.find("NSET=Match1_a"), std::string::npos);
  EXPECT_NE(inp.find("NSET=Match1_b"), std::string::npos);
  for (const MshVersion version : {MshVersion::v2_2, MshVersion::v4_1}) {
    WriteOptions options;
    options.msh_version = version;
    write_mesh(mesh, folder / "box.msh", options);
    const std::string text = test::file_text(folder / "box.msh");
    std::istringstream section(text.substr(std::min(text.find("$Periodic"), text.size())));
    std::string word;
    int links = 0, dimension = 0, to = 0, from = 0;
    double value = 0;
    std::size_t nodes = 0;
    section >> word >> links >> dimension >> to >> from >> word;
    for (int i = 0; i < 16; ++i) {
      section >> value;
      if (i == 3) {
        EXPECT_NEAR(value, 60, 1e-9);
      }
    }
    section >> nodes;
    EXPECT_EQ(links, 1);
    EXPECT_EQ(dimension, 2);
    EXPECT_EQ(to, right);
    EXPECT_EQ(from, left);
    EXPECT_EQ(nodes, mesh.matches[0].nodes.size());
  }
}

/// A ring under inner pressure moves as Lame says: here a twelfth of it, whose sides are linked.
TEST(Matching, ALinkedSectorMovesAsTheWholeRing) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  constexpr double young = 210000, poisson = 0.3, inner = 20, outer = 60, pressure = 100;
  const CadModel model = model_of(sector_face(pi / 6, 0.15), "sheet");
  const auto arc = [&](double radius) {
    return edge_at(model, [=](const Vector3& p) { return std::abs(p.norm() - radius) < 1e-6; });
  };
  MeshOptions options;
  options.order = 2;
  options.sizing.size = 2;
  const ShellMesh mesh = mesh_with(
      model, {{1, edge_at(model, lies_at_angle(0, 0.15)), edge_at(model, lies_at_angle(pi / 6, 0.15))}},
      options);
  const auto& match = mesh.matches.at(0);
  std::string equations;
  const Eigen::Matrix3d turn = match.motion.rotation();
  for (const auto& [a, b] : match.nodes)
    for (const int k : {0, 1})
      equations += fmt::format("*EQUATION\n3\n{}, {}, 1, {}, 1, {}, {}, 2, {}\n", b + 1, k + 1, a + 1,
                               -turn(k, 0), a + 1, -turn(k, 1));
  const std::set<int> bore = nodes_on(mesh, 1, arc(inner));
  const int held = *std::find_if(bore.begin(), bore.end(), [&](int node) {
    return std::none_of(match.nodes.begin(), match.nodes.end(),
                        [&](const auto& pair) { return pair[0] == node || pair[1] == node; });
  });
  const Vector3& at = mesh.points[held];  // does not go round
  equations += fmt::format("*EQUATION\n2\n{0}, 2, {1}, {0}, 1, {2}\n", held + 1, at.x(), -at.y());
  const test::TemporaryFolder folder;
  WriteOptions write;
  write.element = InpElement::cpe8;
  write_mesh(mesh, folder / "mesh.inp", write);
  test::write_text(folder / "job.inp",
                   fmt::format("*INCLUDE, INPUT=mesh.inp\n*MATERIAL, NAME=Material\n*ELASTIC\n{}, {}\n"
                               "*SOLID SECTION, ELSET=Eall, MATERIAL=Material\n{}*STEP\n*STATIC\n*DSLOAD\n"
                               "Surface_Edge{}, P, {}\n*NODE FILE, OUTPUT=2D\nU\n*END STEP\n",
                               young, poisson, equations, arc(inner), pressure));
  const auto solved = test::run("cd " + folder.path().string() + " && timeout 120 ccx job 2>&1");
  ASSERT_EQ(solved.out.find("ERROR"), std::string::npos) << solved.out;
  std::istringstream result(test::file_text(folder / "job.frd"));
  std::string text;
  bool moves = false;
  int looked_at = 0;
  constexpr double expected = (1 + poisson) * pressure * inner * inner /
                              (young * (outer * outer - inner * inner)) *
                              ((1 - 2 * poisson) * inner + outer * outer / inner);
  while (std::getline(result, text)) {
    if (text.starts_with(" -4")) moves = text.substr(5, 4) == "DISP";
    if (!moves || !text.starts_with(" -1")) continue;
    const int node = std::stoi(text.substr(3, 10)) - 1;
    if (!bore.contains(node)) continue;
    ++looked_at;
    const Vector3 moved(std::stod(text.substr(13, 12)), std::stod(text.substr(25, 12)), 0);
    EXPECT_LT((moved - expected * mesh.points[node].normalized()).norm(), 0.01 * expected);
  }
  EXPECT_EQ(looked_at, static_cast<int>(bore.size()));
}

}  // namespace
}  // namespace quadrille
