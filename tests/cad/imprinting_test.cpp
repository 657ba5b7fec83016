/// Parts that touch or cross share faces and lines afterwards, and numbers and names follow.

#include "geometry/cad/imprinting.hpp"

#include <gtest/gtest.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shell.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Pln.hxx>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/shape_parts.hpp"
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

/// Two squares of 4 in one arrangement.
struct Arrangement {
  const char* name;
  gp_Pnt at;         ///< of the second square; the first one spans x and y from 0
  gp_Dir along, up;  ///< sides of the second square
  double side;
  double common;  ///< area that both have
  int together;   ///< edges of the result at which both meet
};

const std::vector<Arrangement> arrangements{
    {"crossing", {2, 0, -2}, gp::DY(), gp::DZ(), 4, 0, 1},
    {"side by side", {4, 0, 0}, gp::DX(), gp::DY(), 4, 0, 1},
    {"side by side, opposed", {4, 0, 0}, gp::DY(), gp::DX(), 4, 0, 1},
    {"T", {2, 0, 0}, gp::DY(), gp::DZ(), 4, 0, 1},
    {"T, opposed", {2, 0, 0}, gp::DZ(), gp::DY(), 4, 0, 1},
    {"L", {4, 0, 0}, gp::DY(), gp::DZ(), 4, 0, 1},
    {"one inside the other", {1, 1, 0}, gp::DX(), gp::DY(), 2, 4, 4},
    {"face on face", {0, 0, 0}, gp::DX(), gp::DY(), 4, 16, 0},
    {"face on face, opposed", {0, 0, 0}, gp::DY(), gp::DX(), 4, 16, 0},
    {"overlapping", {2, 0, 0}, gp::DX(), gp::DY(), 4, 8, 2},
};

TopoDS_Shape square(const gp_Pnt& at, const gp_Dir& along, const gp_Dir& up, double side) {
  const gp_Pln plane(gp_Ax3(at, along.Crossed(up), along));
  return BRepBuilderAPI_MakeFace(plane, 0, side, 0, side).Face();
}

TopoDS_Shape shell_of(const TopoDS_Shape& face) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  return shell;
}

TopoDS_Shape solid_on(const TopoDS_Shape& face, const gp_Vec& height) {
  return BRepPrimAPI_MakePrism(face, height).Shape();
}

/// For each side of a quad: the directions in which quads run along it.
std::map<std::array<int, 2>, std::vector<bool>> sides_of(const ShellMesh& mesh) {
  std::map<std::array<int, 2>, std::vector<bool>> sides;
  for (const auto& quad : mesh.quads)
    for (int k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      sides[{std::min(a, b), std::max(a, b)}].push_back(a < b);
    }
  return sides;
}

/// Sheets of every form and arrangement are joined, keep their area and are oriented alike.
TEST(Imprinting, SheetsOfEveryForm) {
  for (const Arrangement& it : arrangements) {
    const TopoDS_Shape first = square({0, 0, 0}, gp::DX(), gp::DY(), 4),
                       second = square(it.at, it.along, it.up, it.side);
    for (const auto& [form, parts] : std::map<std::string, std::vector<TopoDS_Shape>>{
             {"faces", {first, second}},
             {"shells", {shell_of(first), shell_of(second)}},
             {"turned shells", {shell_of(first).Reversed(), shell_of(second)}},
             {"mixed", {first, shell_of(second)}},
         }) {
      SCOPED_TRACE(std::string(it.name) + ", " + form);
      const CadModel model = model_of(parts).imprinted();
      EXPECT_NEAR(model.area(), 16 + it.side * it.side - it.common, 1e-9);
      ASSERT_EQ(model.pieces().size(), 2u);
      for (const std::vector<int>& own : model.pieces()) EXPECT_FALSE(own.empty());
      int together = 0;
      for (const CadEdge& edge : model.shape().edges) together += edge.faces.size() > 1;
      EXPECT_EQ(together, it.together);
      expect_joined(model);
      for (const auto& [nodes, runs] : sides_of(meshed(model))) {
        if (runs.size() == 2) {
          EXPECT_NE(runs[0], runs[1]);
        }
      }
    }
  }
}

TEST(Imprinting, SolidsOfEveryArrangement) {
  for (const Arrangement& it : arrangements) {
    SCOPED_TRACE(it.name);
    const TopoDS_Shape sheet = square({0, 0, 0}, gp::DX(), gp::DY(), 4),
                       other = square(it.at, it.along, it.up, it.side);
    const TopoDS_Shape below = solid_on(sheet, {0, 0, -1}), slanted = solid_on(other, {0.5, 0.5, 1});
    const CadModel solids = model_of({below, slanted}).imprinted();
    EXPECT_GE(solids.solid_count(), 2);
    expect_joined(solids);
    const CadModel mixed = model_of({below, shell_of(other)}).imprinted();
    EXPECT_EQ(mixed.pieces().size(), 7u);
    expect_joined(mixed);
  }
}

/// The pieces of a face on both sides of a line where another meets it go on as the face did.
TEST(Imprinting, PiecesOfAFaceAreAlike) {
  // The neighbor is opposed to the first square, so that it or both pieces of that are reversed.
  const CadModel model =
      model_of({square({0, 0, 0}, gp::DX(), gp::DY(), 4), square({2, 0, 0}, gp::DY(), gp::DZ(), 4),
                square({4, 0, 0}, gp::DY(), gp::DX(), 4)})
          .imprinted();
  std::set<bool> upwards;
  const ShellMesh mesh = meshed(model);
  for (const auto& quad : mesh.quads) {
    const Vector3 normal =
        (mesh.points[quad[2]] - mesh.points[quad[0]]).cross(mesh.points[quad[3]] - mesh.points[quad[1]]);
    if (std::abs(normal.x()) < 1e-6) upwards.insert(normal.z() > 0);
  }
  EXPECT_EQ(upwards.size(), 1u);
  ASSERT_EQ(model.problems().size(), 3u);
  EXPECT_NE(model.problems()[1].find("reversed"), std::string::npos) << model.problems()[1];
  EXPECT_NE(model.problems()[2].find("cannot agree"), std::string::npos) << model.problems()[2];
}

/// Closed skins that share a piece stay outward, and so opposed across it.
TEST(Imprinting, ClosedShellsStayOutward) {
  std::vector<TopoDS_Shape> shells;
  for (const TopoDS_Shape& box : {BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(4, 4, 4)).Shape(),
                                  BRepPrimAPI_MakeBox(gp_Pnt(2, 0, 4), gp_Pnt(6, 4, 8)).Shape()})
    shells.push_back(TopExp_Explorer(box, TopAbs_SHELL).Current());
  const CadModel model = model_of(shells).imprinted();
  for (const std::string& problem : model.problems())
    EXPECT_EQ(problem.find("reversed"), std::string::npos) << problem;
  expect_joined(model);
}

/// A tube whose seam is two edges on each other, as IGES files have it, and its ends.
TEST(Imprinting, ATubeWithAnOpenSeamIsKept) {
  const double round = 2 * std::acos(-1);
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp_Ax3(), 3);
  const BRep_Builder builder;
  const auto vertex = [](double z) { return BRepBuilderAPI_MakeVertex(gp_Pnt(3, 0, z)).Vertex(); };
  const TopoDS_Vertex low = vertex(0), high = vertex(5);
  const auto line = [&](double u) {
    const TopoDS_Edge edge =
        BRepBuilderAPI_MakeEdge(new Geom2d_Line({u, 0}, gp_Dir2d(0, 1)), surface, low, high, 0, 5).Edge();
    BRepLib::BuildCurves3d(edge);
    return edge;
  };
  const auto circle = [&](const TopoDS_Vertex& at, double v) {
    const TopoDS_Edge edge =
        BRepBuilderAPI_MakeEdge(new Geom2d_Line({0, v}, gp_Dir2d(1, 0)), surface, at, at, 0, round).Edge();
    BRepLib::BuildCurves3d(edge);
    return edge;
  };
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, circle(low, 0));
  builder.Add(wire, line(round));
  builder.Add(wire, circle(high, 5).Reversed());
  builder.Add(wire, line(0).Reversed());
  wire.Closed(Standard_True);
  const TopoDS_Face tube = BRepBuilderAPI_MakeFace(surface, wire).Face();
  const auto end = [&](double z) {
    const gp_Ax2 axes(gp_Pnt(0, 0, z), gp::DZ());
    return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, 3)).Edge()))
        .Face();
  };
  const CadModel apart = model_of({tube, end(0), end(5)}), model = apart.imprinted();
  ASSERT_EQ(apart.edge_count(), 6);
  EXPECT_EQ(model.edge_count(), 3);
  EXPECT_EQ(model.face_count(), 3);
  for (const std::vector<int>& own : model.edge_pieces()) EXPECT_EQ(own.size(), 1u);
  EXPECT_NEAR(model.area(), apart.area(), 1e-6 * apart.area());
  expect_joined(model);
  for (const auto& [nodes, runs] : sides_of(meshed(model))) EXPECT_EQ(runs.size(), 2u);
}

/// A pipe as a line that turns around an axis, as IGES files have it.
TopoDS_Shape turned_line(const gp_Ax1& axis, const gp_Pnt& from, const gp_Pnt& to,
                         double angle = 2 * std::acos(-1)) {
  const TopoDS_Edge line = BRepBuilderAPI_MakeEdge(from, to).Edge();
  const BRepAdaptor_Curve curve(line);
  const Handle(Geom_Surface) surface = new Geom_SurfaceOfRevolution(curve.Curve().Curve(), axis);
  return BRepBuilderAPI_MakeFace(surface, 0, angle, curve.FirstParameter(), curve.LastParameter(), 1e-7)
      .Face();
}

/// Equal pipes that cross graze each other in two points. As turned lines they may keep the fuse busy for a
/// minute.
TEST(Imprinting, PipesThatCrossAreCylinders) {
  const TopoDS_Shape upright = turned_line({{0, 0, 0}, gp::DZ()}, {5, 0, -10}, {5, 0, 10}),
                     level = turned_line({{0, 0, 0}, gp::DX()}, {-10, 5, 0}, {10, 5, 0});
  for (const double tolerance : {0.0, 0.5}) {
    const CadModel model = model_of({upright, level.Reversed()}).imprinted(tolerance);
    EXPECT_GE(model.face_count(), 6);
    EXPECT_NEAR(model.area(), 2 * 200 * std::acos(-1), 1);
    for (const CadFace& face : model.shape().faces)
      EXPECT_EQ(BRepAdaptor_Surface(face.face).GetType(), GeomAbs_Cylinder);
    expect_joined(model);
  }
}

/// OpenCASCADE crashes on it if asked to make the turned line a cylinder (SweptToElementary).
TEST(Imprinting, APlateMayShareAnEdgeWithATurnedLine) {
  const TopoDS_Shape half = turned_line({{0, 0, 0}, gp::DZ()}, {5, 0, -10}, {5, 0, 10}, std::acos(-1));
  const gp_Pnt corners[] = {{5, 0, -10}, {5, -20, -10}, {5, -20, 10}, {5, 0, 10}};
  BRepBuilderAPI_MakeWire outline;
  for (const TopoDS_Edge& edge : edges_of(half))
    if (const BRepAdaptor_Curve curve(edge);
        curve.GetType() == GeomAbs_Line && curve.Value(curve.FirstParameter()).X() > 0)
      outline.Add(edge);
  for (int i = 0; i < 3; ++i) outline.Add(BRepBuilderAPI_MakeEdge(corners[i], corners[i + 1]).Edge());
  TopoDS_Shell shell;
  const BRep_Builder builder;
  builder.MakeShell(shell);
  builder.Add(shell, half);
  builder.Add(shell, BRepBuilderAPI_MakeFace(outline.Wire()).Face());
  const CadModel model = model_of({shell}).imprinted(0);
  EXPECT_EQ(model.face_count(), 2);
  EXPECT_NEAR(model.area(), 5 * std::acos(-1) * 20 + 20 * 20, 1);
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
