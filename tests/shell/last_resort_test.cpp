/// Faces that are meshed with nodes off their surface.

#include "mesher/shell/last_resort.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <gp_Circ.hxx>

#include <algorithm>
#include <cmath>
#include <memory>

#include "mesher/mesh/quality.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/stages/stages.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

/// Meshes Face1 of a shape as if no remedy had helped it.
FaceMesh off_surface(const TopoDS_Shape& shape, double reach) {
  const CadModel model(std::make_shared<CadShape>(shape, "model"));
  MeshOptions options;
  options.sizing.size = 2;
  ExecutionContext context(1);
  const SettledBoundary boundary = settle_boundary(model, options, context);
  const FaceProblem problem(Cause::no_mesh, FaceId::from_number(1), "Face1 has no mesh");
  return mesh_off_surface(model.shape(), problem, boundary.nodes, boundary.field, reach, false, options,
                          context);
}

double least_jacobian(const FaceMesh& mesh) {
  double least = 1;
  const auto& p = mesh.points;
  for (const auto& [a, b, c, d] : mesh.quads)
    least = std::min(least, quad_scaled_jacobian(p[a], p[b], p[c], p[d]));
  return least;
}

TopoDS_Shape polygon(const std::vector<gp_Pnt>& points) {
  BRepBuilderAPI_MakePolygon wire;
  for (const gp_Pnt& point : points) wire.Add(point);
  wire.Close();
  return BRepBuilderAPI_MakeFace(wire.Wire()).Face();
}

TEST(LastResort, KeepsNodesOnTheSurfaceWhereTheyCanBe) {
  const FaceMesh mesh = off_surface(BRepPrimAPI_MakeCylinder(5, 10).Shape(), 0.25);
  EXPECT_GT(mesh.quads.size(), 20U);
  EXPECT_GT(least_jacobian(mesh), 0);
  EXPECT_TRUE(mesh.off.empty());
  for (std::size_t i = mesh.nodes.size(); i < mesh.points.size(); ++i)
    EXPECT_NEAR(mesh.points[i].head<2>().norm(), 5, 1e-7);
}

TEST(LastResort, SpansNoLoopThatCrossesItself) {
  const std::vector<gp_Pnt> bow{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}};
  EXPECT_THROW(off_surface(polygon(bow), 0.25), FaceProblem);
  EXPECT_GT(off_surface(polygon({bow[0], bow[1], bow[3], bow[2]}), 0.25).quads.size(), 20U);
}

/// Between a circle and one that touches it from inside: a tip of zero degrees.
TopoDS_Shape crescent(double radius, double inner, double angle) {
  BRepBuilderAPI_MakeWire outline;
  const auto arc = [](double r, double middle, double from, double to) {
    return BRepBuilderAPI_MakeEdge(
               GC_MakeArcOfCircle(gp_Circ(gp_Ax2(gp_Pnt(middle, 0, 0), gp::DZ()), r), from, to, Standard_True)
                   .Value())
        .Edge();
  };
  const double middle = radius - inner;  // of the inner circle: both pass through (radius, 0)
  outline.Add(arc(radius, 0, 0, angle));
  const gp_Pnt out(radius * std::cos(angle), radius * std::sin(angle), 0),
      in(middle + inner * std::cos(angle), inner * std::sin(angle), 0);
  outline.Add(BRepBuilderAPI_MakeEdge(out, in).Edge());
  outline.Add(arc(inner, middle, 0, angle));
  return BRepBuilderAPI_MakeFace(outline.Wire()).Face();
}

TEST(LastResort, ATipOfZeroDegreesIsNoEndOfTheFace) {
  for (const double inner : {5.0, 8.0, 9.0, 9.5})
    for (const double angle : {0.3, 0.8, 1.5})
      for (const double size : {0.5, 1.0, 2.0}) {
        const CadModel model(std::make_shared<CadShape>(crescent(10, inner, angle), "crescent"));
        MeshOptions options;
        options.sizing.size = size;
        options.keep_features = true;
        SCOPED_TRACE(::testing::Message() << inner << " " << angle << " " << size);
        ExecutionContext context(1);
        try {
          const ShellMesh shell = mesh(model, options, context);
          EXPECT_EQ(quality(shell).inverted, 0);
          for (const auto& off : shell.off_geometry) EXPECT_LE(off.distance, shell.size_min);
        } catch (const Error& e) {
          ADD_FAILURE() << e.what();
        }
      }
}

TEST(LastResort, NodesOfTwoFacesMoveTogether) {
  // Two squares of 3 by 3 quads side by side. The middle node of their edge lies beyond the next one.
  const CadModel model = testing::sheet({{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{3, 0}, {6, 0}, {6, 3}, {3, 3}}});
  MeshOptions options;
  options.sizing.size = options.sizing.size_min = 1;
  ExecutionContext context(1);
  SettledBoundary boundary = settle_boundary(model, options, context);
  FaceMeshes meshes(2);
  const auto mesh_again = [&] {
    for (const FaceId face : meshes.ids()) {
      const FaceProblem problem(Cause::no_mesh, face, "no mesh");
      meshes[face] =
          mesh_off_surface(model.shape(), problem, boundary.nodes, boundary.field, 1, true, options, context);
    }
  };
  const auto shared = std::find_if(model.shape().edges.begin(), model.shape().edges.end(),
                                   [](const CadEdge& edge) { return edge.faces.size() == 2; });
  const auto& nodes = boundary.nodes.edges[EdgeId::from_number(shared->number)].nodes;
  ASSERT_GE(nodes.size(), 4U);
  mesh_again();
  const Vector3 place = boundary.nodes.points[nodes[1]];
  const Vector3 wrong = boundary.nodes.points[nodes[2]] + 0.5 * (boundary.nodes.points[nodes[2]] - place);
  boundary.nodes.points[nodes[1]] = wrong;
  for (const FaceId face : meshes.ids())
    for (std::size_t i = 0; i < meshes[face]->nodes.size(); ++i)
      if (meshes[face]->nodes[i] == nodes[1]) meshes[face]->points[i] = wrong;
  EXPECT_LE(std::min(least_jacobian(*meshes[FaceId::from_number(1)]),
                     least_jacobian(*meshes[FaceId::from_number(2)])),
            0);
  BoundaryNodes kept = boundary.nodes;
  EXPECT_FALSE(unfold_with_edges(model.shape(), FaceId::from_number(1), 0.01, kept, meshes, context));
  EXPECT_EQ(kept.points[nodes[1]], wrong) << "changed without success";
  ASSERT_TRUE(unfold_with_edges(model.shape(), FaceId::from_number(1), 3, boundary.nodes, meshes, context));
  for (const FaceId face : meshes.ids()) {
    EXPECT_GT(least_jacobian(*meshes[face]), 0);
    for (std::size_t i = 0; i < meshes[face]->nodes.size(); ++i)
      EXPECT_EQ(meshes[face]->points[i], boundary.nodes.points[meshes[face]->nodes[i]]) << "torn apart";
  }
  EXPECT_FALSE(boundary.nodes.off.empty());
}

}  // namespace
}  // namespace quadrille
