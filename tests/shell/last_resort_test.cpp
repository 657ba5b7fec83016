/// Faces that are meshed with nodes off their surface.

#include "mesher/shell/last_resort.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <memory>

#include "mesher/boundary.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/quadrille.hpp"

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
  ASSERT_EQ(mesh.off.size(), mesh.points.size());
  EXPECT_EQ(*std::max_element(mesh.off.begin(), mesh.off.end()), 0);
  for (std::size_t i = mesh.nodes.size(); i < mesh.points.size(); ++i)
    EXPECT_NEAR(mesh.points[i].head<2>().norm(), 5, 1e-7);
}

TEST(LastResort, SpansNoLoopThatCrossesItself) {
  const std::vector<gp_Pnt> bow{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}};
  EXPECT_THROW(off_surface(polygon(bow), 0.25), FaceProblem);
  EXPECT_GT(off_surface(polygon({bow[0], bow[1], bow[3], bow[2]}), 0.25).quads.size(), 20U);
}

}  // namespace
}  // namespace quadrille
