/// Plane and axisymmetric elements: meshes turn into the plane z = 0, and CalculiX finds known answers with
/// them.

#include "mesher/io/plane_mesh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <TopoDS.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

/// A face in the plane through `origin`, whose local x and y run along `x` and `x` turned left about
/// `normal`.
TopoDS_Face placed(const TopoDS_Face& face, const gp_Pnt& origin, const gp_Dir& normal, const gp_Dir& x) {
  gp_Trsf turn;
  turn.SetTransformation(gp_Ax3(origin, normal, x), gp_Ax3());
  return TopoDS::Face(BRepBuilderAPI_Transform(face, turn).Shape());
}

TopoDS_Edge line(double x1, double y1, double x2, double y2) {
  return BRepBuilderAPI_MakeEdge(gp_Pnt(x1, y1, 0), gp_Pnt(x2, y2, 0));
}

/// A quarter of a circle about the origin, from x to y.
TopoDS_Edge arc(double radius) {
  return BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(), radius), 0, M_PI / 2);
}

TopoDS_Face face_of(const std::vector<TopoDS_Edge>& edges) {
  BRepBuilderAPI_MakeWire wire;
  for (const TopoDS_Edge& edge : edges) wire.Add(edge);
  return BRepBuilderAPI_MakeFace(gp_Pln(), wire.Wire());
}

/// A quarter of a square plate with a hole of radius 1: Edge1 on the symmetry line y = 0, Edge2 the loaded
/// side.
TopoDS_Face quarter_plate(double half_width) {
  const double w = half_width;
  return face_of({line(1, 0, w, 0), line(w, 0, w, w), line(w, w, 0, w), line(0, w, 0, 1), arc(1)});
}

/// A quarter of a ring: Edge1 on y = 0, Edge2 outside, Edge3 on x = 0, Edge4 inside.
TopoDS_Face quarter_ring(double inner, double outer) {
  return face_of({line(inner, 0, outer, 0), arc(outer), line(0, outer, 0, inner), arc(inner)});
}

/// A rectangle: Edge1 below, Edge2 on the right, Edge3 above, Edge4 on the left.
TopoDS_Face rectangle(double left, double right, double height) {
  return face_of({line(left, 0, right, 0), line(right, 0, right, height), line(right, height, left, height),
                  line(left, height, left, 0)});
}

ShellMesh mesh_of(const TopoDS_Face& face, double size, int order,
                  const std::map<int, double>& edge_sizes = {}) {
  MeshOptions options;
  options.sizing.size = size;
  options.sizing.edge_sizes = edge_sizes;
  options.order = order;
  ExecutionContext context(1);
  return mesh(CadModel(std::make_shared<CadShape>(face, "face")), options, context);
}

WriteOptions with(InpElement element) {
  WriteOptions options;
  options.element = element;
  return options;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::usage);
    EXPECT_EQ(error.subject(), "element");
    return error.what();
  }
  return "";
}

double area_of(const ShellMesh& mesh) {
  double sum = 0;
  for (const auto& q : mesh.quads) {
    const auto& p = mesh.points;
    const double area = 0.5 * (p[q[2]] - p[q[0]]).cross(p[q[3]] - p[q[1]]).z();
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

/// What CalculiX writes about the node at a place in the file: stresses xx, yy, zz; displacements x, y.
struct Answer {
  std::array<double, 3> stress{};
  std::array<double, 2> displacement{};
};

constexpr double young = 210000, poisson = 0.3;

/// Solves the mesh of thickness 0.1 with these supports and loads.
Answer solve(ShellMesh mesh, InpElement element, const std::string& supports, const std::string& loads,
             const Vector3& place) {
  const TemporaryFolder folder;
  mesh.thicknesses = {
      0.1};  // so that the file has sections; CalculiX makes plates solid: thick ones have other stresses
  write_mesh(mesh, folder / "mesh.inp", with(element));
  test::write_text(
      folder / "job.inp",
      fmt::format("*MATERIAL, NAME=Material\n*ELASTIC\n{}, {}\n*INCLUDE, INPUT=mesh.inp\n*BOUNDARY\n"
                  "{}*STEP\n*STATIC\n*DSLOAD\n{}*NODE FILE, OUTPUT=2D\nU\n*EL FILE\nS\n*END STEP\n",
                  young, poisson, supports, loads));
  const auto solved = test::run("cd " + folder.path().string() + " && timeout 120 ccx job 2>&1");
  EXPECT_EQ(solved.out.find("ERROR"), std::string::npos) << solved.out;
  EXPECT_EQ(solved.out.find("WARNING"), std::string::npos) << solved.out;
  const ShellMesh written = read_mesh(folder / "mesh.inp");
  int node = 0;
  for (std::size_t i = 0; i < written.points.size(); ++i)
    if ((written.points[i] - place).norm() < 1e-6) node = static_cast<int>(i) + 1;
  EXPECT_GT(node, 0) << "no node at " << place.transpose();
  std::istringstream result(test::file_text(folder / "job.frd"));
  std::string text, block;
  Answer answer;
  const auto number = [&](std::size_t i) { return std::stod(text.substr(13 + 12 * i, 12)); };
  while (std::getline(result, text)) {
    if (text.starts_with(" -4")) block = text.substr(5, 4);
    if (!text.starts_with(" -1") || block.empty() || std::stoi(text.substr(3, 10)) != node) continue;
    if (block == "DISP") answer.displacement = {number(0), number(1)};
    if (block == "STRE") answer.stress = {number(0), number(1), number(2)};
  }
  return answer;
}

/// Howland's plate, by Heywood's formula: 3 in an infinite plate.
TEST(PlaneElements, PlateWithAHoleHasItsStressConcentration) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  const double half_width = 15, share = 1 / half_width;
  const double expected = (2 + std::pow(1 - share, 3)) / (1 - share);
  const TopoDS_Face upright = placed(quarter_plate(half_width), gp_Pnt(0, 4, 0), -gp::DY(), gp::DX());
  const ShellMesh mesh = mesh_of(upright, 1.5, 2, {{5, 0.05}});
  for (const InpElement element : {InpElement::cps8, InpElement::cps8r}) {
    const Answer top = solve(mesh, element, "Edge1, 2\nEdge4, 1\n", "Surface_Edge2, P, -1\n", {0, 1, 0});
    EXPECT_NEAR(top.stress[0] / expected, 1, 0.02) << name_of(element);
  }
}

/// Lame's displacement of a ring under inner pressure that cannot grow along its axis.
double lame_displacement(double pressure, double inner, double outer) {
  const double a2 = inner * inner, b2 = outer * outer;
  return (1 + poisson) * pressure * a2 / (young * (b2 - a2)) * ((1 - 2 * poisson) * inner + b2 / inner);
}

TEST(PlaneElements, ThickCylinderMovesAsLameSays) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  const TopoDS_Face section = placed(rectangle(10, 20, 10), gp_Pnt(), -gp::DY(), gp::DX());  // axis z
  for (const InpElement element :
       {InpElement::cax8, InpElement::cax8r, InpElement::cax4, InpElement::cax4r}) {
    const ShellMesh mesh = mesh_of(section, 0.5, order_of(element));
    const Answer inside = solve(mesh, element, "Edge1, 2\nEdge3, 2\n", "Surface_Edge4, P, 100\n", {10, 0, 0});
    EXPECT_NEAR(inside.displacement[0] / lame_displacement(100, 10, 20), 1, 0.01) << name_of(element);
    if (order_of(element) == 1) continue;  // their stress is that at mid-element
    EXPECT_NEAR(inside.stress[2] / (100.0 * 500 / 300), 1, 0.02) << name_of(element);
  }
}

TEST(PlaneElements, RingInPlaneStrainMovesAsLameSays) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  const TopoDS_Face ring = placed(quarter_ring(10, 20), gp_Pnt(5, 0, 0), gp::DX(), gp::DY());  // plane y-z
  for (const InpElement element :
       {InpElement::cpe8, InpElement::cpe8r, InpElement::cpe4, InpElement::cpe4r}) {
    const ShellMesh mesh = mesh_of(ring, 0.7, order_of(element));
    const Answer inside = solve(mesh, element, "Edge1, 2\nEdge3, 1\n", "Surface_Edge4, P, 100\n", {10, 0, 0});
    EXPECT_NEAR(inside.displacement[0] / lame_displacement(100, 10, 20), 1, 0.01) << name_of(element);
    if (order_of(element) == 1) continue;
    EXPECT_NEAR(inside.stress[1] / (100.0 * 500 / 300), 1, 0.02) << name_of(element);
  }
}

TEST(PlaneMesh, TurnsFromAnyPlaneAndKeepsXWhereItCan) {
  const TopoDS_Face face = rectangle(1, 3, 5);  // 2 by 5
  struct Case {
    gp_Dir normal, along;
    Vector3 x, y;
  };
  const double half = std::sqrt(0.5);
  const Case cases[] = {{gp::DZ(), gp::DX(), Vector3::UnitX(), Vector3::UnitY()},
                        {-gp::DZ(), gp::DX(), Vector3::UnitX(), Vector3::UnitY()},
                        {gp::DY(), gp::DX(), Vector3::UnitX(), Vector3::UnitZ()},
                        {gp::DX(), gp::DZ(), Vector3::UnitY(), Vector3::UnitZ()},
                        {gp_Dir(0, 1, -1), gp::DX(), Vector3::UnitX(), Vector3(0, half, half)},
                        {gp_Dir(1, -1, 0), gp::DZ(), Vector3(half, half, 0), Vector3::UnitZ()}};
  for (const Case& c : cases) {
    for (const int order : {1, 2}) {
      const ShellMesh mesh = mesh_of(placed(face, gp_Pnt(7, 8, 9), c.normal, c.along), 1, order);
      const PlaneMesh plane = in_plane(mesh, InpElement::cps4, "a.inp");
      for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Vector3 wanted(mesh.points[i].dot(c.x), mesh.points[i].dot(c.y), 0);
        EXPECT_NEAR((plane.mesh.points[i] - wanted).norm(), 0, 1e-6) << plane.turn;
        EXPECT_EQ(plane.mesh.points[i].z(), 0);
      }
      EXPECT_NEAR(area_of(plane.mesh), 10, 1e-6);
      for (std::size_t i = 0; i < plane.mesh.midsides.size(); ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          const auto& p = plane.mesh.points;
          const auto& quad = plane.mesh.quads[i];
          EXPECT_NEAR((p[plane.mesh.midsides[i][j]] - (p[quad[j]] + p[quad[(j + 1) % 4]]) / 2).norm(), 0,
                      1e-6);
        }
    }
  }
}

TEST(PlaneMesh, TellsHowItWasTurned) {
  const TopoDS_Face face = rectangle(1, 3, 5);
  const auto turn = [](const TopoDS_Face& f) {
    return in_plane(mesh_of(f, 1, 1), InpElement::cps4, "a.inp").turn;
  };
  EXPECT_EQ(turn(face), "");
  EXPECT_EQ(
      turn(placed(face, gp_Pnt(0, 4, 0), -gp::DY(), gp::DX())),
      "Rotated into the plane z = 0: the point (x, y) here is x (1, 0, 0) + y (0, 0, 1) + -4 (0, -1, 0) in "
      "the model");
  const TemporaryFolder folder;
  const ShellMesh mesh = mesh_of(placed(face, gp_Pnt(0, 4, 0), -gp::DY(), gp::DX()), 1, 1);
  write_mesh(mesh, folder / "a.inp", with(InpElement::cpe4));
  EXPECT_NE(test::file_text(folder / "a.inp").find("\n** Rotated into the plane z = 0"), std::string::npos);
}

TEST(PlaneMesh, RefusesWhatDoesNotFit) {
  const TemporaryFolder folder;
  const auto writes = [&](const ShellMesh& mesh, InpElement element) {
    return refusal([&] { write_mesh(mesh, folder / "a.inp", with(element)); });
  };
  EXPECT_EQ(writes(test::ShellGrid(4, 1, 0).mesh(), InpElement::cps8), "`element` CPS8 needs order 2, not 1");
  EXPECT_EQ(writes(test::ShellGrid(4, 2, 0).mesh(), InpElement::s4r), "`element` S4R needs order 1, not 2");
  EXPECT_EQ(writes(test::ShellGrid(4, 2, 0).mesh(), InpElement::m3d8r), "");
  ShellMesh bent = mesh_of(rectangle(1, 3, 5), 1, 1);
  bent.points.front().z() = 0.5;
  EXPECT_NE(writes(bent, InpElement::cpe4).find("CPE4 needs a mesh in one plane, and Face1 leaves the plane"),
            std::string::npos);
  EXPECT_EQ(writes(bent, InpElement::m3d4), "");
  const ShellMesh across = mesh_of(rectangle(-1, 3, 5), 1, 1);
  EXPECT_NE(writes(across, InpElement::cax4).find("Face1 reaches to the radius -1:"), std::string::npos);
  EXPECT_EQ(writes(across, InpElement::cps4), "");
}

TEST(PlaneMesh, MembranesHaveSectionsOfTheirOwn) {
  const TemporaryFolder folder;
  ShellMesh mesh = mesh_of(rectangle(1, 3, 5), 1, 2);
  mesh.thicknesses = {2.0};
  write_mesh(mesh, folder / "a.inp", with(InpElement::m3d8r));
  const std::string text = test::file_text(folder / "a.inp");
  EXPECT_NE(text.find("*ELEMENT, TYPE=M3D8R, ELSET=Face1\n"), std::string::npos);
  EXPECT_NE(text.find("*MEMBRANE SECTION, ELSET=Thickness2, MATERIAL=Material\n2\n"), std::string::npos);
  ShellMesh::VaryingThickness varying;
  varying.face = 1;
  varying.thinnest = 1;
  varying.thickest = 3;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    varying.nodes.push_back(static_cast<int>(i));
    varying.thicknesses.push_back(1 + mesh.points[i].y() * 2 / 5);
  }
  mesh.varying_thicknesses = {varying};
  EXPECT_EQ(refusal([&] { write_mesh(mesh, folder / "a.inp", with(InpElement::m3d8r)); }),
            "`element` M3D8R needs a constant thickness, and that of Face1 varies: choose a shell");
}

}  // namespace
}  // namespace quadrille
