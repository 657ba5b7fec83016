/// Holes, pockets and bosses that are narrow enough are left out, and nothing else.

#include "mesher/edges/simplified_model.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <gp_Ax2.hxx>

#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/area_check.hpp"
#include "mesher/shell/validate.hpp"

namespace quadrille {
namespace {

TopoDS_Shape box() {
  return BRepPrimAPI_MakeBox(40, 30, 10).Shape();
}

/// Along z from the height z.
TopoDS_Shape cylinder(double x, double y, double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp::DZ()), radius, height).Shape();
}

TopoDS_Shape without(const TopoDS_Shape& shape, const TopoDS_Shape& tool) {
  return BRepAlgoAPI_Cut(shape, tool).Shape();
}

TopoDS_Shape with(const TopoDS_Shape& shape, const TopoDS_Shape& tool) {
  return BRepAlgoAPI_Fuse(shape, tool).Shape();
}

CadModel model_of(const TopoDS_Shape& shape) {
  return CadModel(std::make_shared<CadShape>(shape, "part"));
}

SimplifiedModel without_holes(const TopoDS_Shape& shape, double diameter, const SizingOptions& sizing = {}) {
  const CadModel model = model_of(shape);
  return fill_holes(model, FaceFlags(model.face_count(), 1), sizing, diameter);
}

std::vector<ShellMesh::FilledHole> filled(const TopoDS_Shape& shape, double diameter,
                                          const SizingOptions& sizing = {}) {
  return without_holes(shape, diameter, sizing).holes;
}

ShellMesh meshed(const CadModel& model, double diameter, int order = 1) {
  MeshOptions options;
  options.sizing.size = 3;
  options.fill_holes = diameter;
  options.order = order;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

double area(const ShellMesh& mesh) {
  return std::accumulate(mesh.quads.begin(), mesh.quads.end(), 0.0, [&](double sum, const auto& quad) {
    return sum + quad_area_vector(mesh.points, quad).norm();
  });
}

TEST(HoleFilling, MeshesAPlateAsIfItHadNoSmallHoles) {
  const TopoDS_Shape part = without(without(box(), cylinder(10, 15, -1, 2, 20)), cylinder(28, 15, -1, 5, 20));
  const CadModel model = model_of(part);
  for (const int order : {1, 2}) {
    const ShellMesh mesh = meshed(model, 5, order);
    EXPECT_EQ(validate(mesh), std::vector<std::string>{});
    EXPECT_TRUE(area_differences(model, mesh).empty());
    ASSERT_EQ(mesh.filled_holes.size(), 1U);
    const auto& hole = mesh.filled_holes.front();
    EXPECT_NEAR(hole.diameter, 4, 1e-6);
    EXPECT_NEAR((hole.center.head<2>() - Vector2(10, 15)).norm(), 0, 1e-6);
    EXPECT_FALSE(hole.boss);
    EXPECT_EQ(hole.in.size(), 2U);
    ASSERT_EQ(hole.faces.size(), 1U);
    EXPECT_EQ(mesh.faces[hole.faces[0] - 1].status, FaceStatus::merged);
    EXPECT_EQ(mesh.faces[hole.in[0] - 1].filled_area, mesh.faces[hole.in[1] - 1].filled_area);
    EXPECT_NEAR(mesh.faces[hole.in[0] - 1].filled_area, 4 * std::numbers::pi, 1e-6);
    const double expected = 2 * (1200 + 300 + 400) + 2 * std::numbers::pi * 5 * (10 - 5);
    EXPECT_NEAR(area(mesh) / expected, 1, 0.005);
  }
  EXPECT_TRUE(meshed(model, 3.9).filled_holes.empty());
}

TEST(HoleFilling, FillsAllKindsOfHoles) {
  EXPECT_EQ(filled(without(box(), cylinder(10, 15, 5, 2, 20)), 4).size(), 1U) << "blind";
  const TopoDS_Shape cone = BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(10, 15, 8), gp::DZ()), 2, 4, 2).Shape();
  const TopoDS_Shape countersunk = without(without(box(), cylinder(10, 15, -1, 2, 20)), cone);
  EXPECT_EQ(filled(countersunk, 8).size(), 1U);
  EXPECT_TRUE(filled(countersunk, 7.9).empty()) << "its mouth is wider";
  const TopoDS_Shape slot = without(box(), BRepPrimAPI_MakeBox(gp_Pnt(10, 10, -1), 4, 3, 20).Shape());
  EXPECT_EQ(filled(slot, 5).size(), 1U);
  EXPECT_TRUE(filled(slot, 4.9).empty()) << "its diagonal is longer";
  EXPECT_EQ(filled(without(box(), BRepPrimAPI_MakeSphere(gp_Pnt(10, 10, 10), 2).Shape()), 4).size(), 1U)
      << "dimple";
  const TopoDS_Shape tube = without(cylinder(0, 0, 0, 20, 30), cylinder(0, 0, -1, 18, 40));
  const TopoDS_Shape radial =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 15), gp::DX().Reversed()), 3, 30).Shape();
  const auto in_tube = filled(without(tube, radial), 7);
  ASSERT_EQ(in_tube.size(), 1U);
  EXPECT_EQ(in_tube[0].in.size(), 2U);
}

TEST(HoleFilling, AHoleInAHoleGoesWithIt) {
  const TopoDS_Shape part = without(without(box(), cylinder(10, 15, -1, 2, 20)), cylinder(10, 15, 6, 4, 20));
  const auto inner = filled(part, 5), both = filled(part, 8);
  ASSERT_EQ(inner.size(), 1U);
  EXPECT_EQ(inner[0].faces.size(), 1U);
  ASSERT_EQ(both.size(), 2U) << "the small hole still lies in the lower face";
  const SimplifiedModel result = without_holes(part, 8);
  EXPECT_EQ(std::accumulate(result.gone.begin(), result.gone.end(), 0), 3);
  const ShellMesh mesh = meshed(model_of(part), 8);
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_NEAR(area(mesh), 3800, 1e-6);
}

TEST(HoleFilling, TakesOffLowBossesOnly) {
  const auto low = filled(with(box(), cylinder(10, 15, 10, 2, 4)), 4);
  ASSERT_EQ(low.size(), 1U);
  EXPECT_TRUE(low[0].boss);
  EXPECT_EQ(low[0].faces.size(), 2U);
  EXPECT_TRUE(filled(with(box(), cylinder(10, 15, 10, 2, 5)), 4).empty()) << "higher than wide";
  const TopoDS_Shape upper = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 13), 40, 30, 10).Shape();
  EXPECT_TRUE(filled(with(with(box(), cylinder(10, 15, 9, 2, 5)), upper), 4).empty())
      << "a strut between two walls";
}

TEST(HoleFilling, LeavesWhatIsNoHole) {
  EXPECT_TRUE(filled(box(), 39).empty());
  const TopoDS_Shape cavity = without(without(box(), BRepPrimAPI_MakeBox(gp_Pnt(2, 2, 2), 36, 26, 6).Shape()),
                                      cylinder(10, 15, 5, 2, 20));
  EXPECT_EQ(filled(cavity, 4).size(), 1U) << "only the neck: the cavity is wider";
  const TopoDS_Shape bottle = without(without(box(), cylinder(20, 15, 2, 8, 6)), cylinder(20, 15, 5, 2, 20));
  EXPECT_EQ(filled(bottle, 4).size(), 1U);
}

TEST(HoleFilling, LeavesWhatUsersName) {
  const TopoDS_Shape part = without(box(), cylinder(10, 15, -1, 2, 20));
  const auto hole = filled(part, 4).at(0);
  const CadModel model = model_of(part);
  std::vector<SizingOptions> all(5);
  all[0].kept_faces = {hole.faces[0]};
  all[1].face_sizes = {{hole.faces[0], 1.0}};
  for (const CadEdge& edge : model.shape().edges) {
    if (!edge.closed() || edge.faces.size() != 2 || edge.faces[0] == edge.faces[1]) continue;
    all[2].edge_sizes[edge.number] = 1;
    all[3].kept_edges.insert(edge.number);
    all[4].vertex_sizes[edge.first_vertex.number()] = 1;
  }
  for (const SizingOptions& sizing : all) EXPECT_TRUE(filled(part, 4, sizing).empty());
}

}  // namespace
}  // namespace quadrille
