/// Midside nodes lie on curves and surfaces, in the middle of their sides, each once.

#include "mesher/shell/midsides.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <gp_Elips.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesher/shell/assembly.hpp"
#include "tests/support/meshed_model.hpp"

namespace quadrille {
namespace {

/// A shell of second order, with what it was made from. No element of it folds, so nodes stay where they were
/// put.
struct SecondOrder {
  testing::MeshedModel parts;
  ShellNumbering numbering;
  ShellMesh mesh;
  std::size_t corner_nodes;
  Midsides midsides;

  explicit SecondOrder(const TopoDS_Shape& shape)
      : parts(CadModel(std::make_shared<CadShape>(shape, "solid")), 2) {
    ExecutionContext context(1);
    mesh = assemble(parts.geometry, parts.nodes, parts.faces, 1, context);
    number_as_assembled();
    corner_nodes = mesh.points.size();
    midsides = add_midsides(parts.parts, numbering, mesh, context);
  }

 private:
  void number_as_assembled() {
    for (const Vector3& point : parts.nodes.points) {
      const auto found = std::find(mesh.points.begin(), mesh.points.end(), point);
      numbering.nodes.push_back(found == mesh.points.end() ? -1
                                                           : static_cast<int>(found - mesh.points.begin()));
    }
    numbering.first_quad = {0};
    for (const auto& face : parts.faces)
      numbering.first_quad.push_back(numbering.first_quad.back() + face->quads.size());
    for (const EdgeId edge : parts.nodes.edges.ids())
      for (int k = 0; k < parts.nodes.edges[edge].segments(); ++k) numbering.segments.push_back({edge, k});
  }
};

/// The middle of an ellipse's parameters is not as far from both ends.
TEST(Midsides, LieHalfwayOnTheirCurves) {
  const TopoDS_Edge ellipse = BRepBuilderAPI_MakeEdge(gp_Elips(gp_Ax2(), 9, 4)).Edge();
  const SecondOrder shell(BRepBuilderAPI_MakeFace(gp_Pln(), BRepBuilderAPI_MakeWire(ellipse)).Face());
  const ShellMesh& mesh = shell.mesh;
  ASSERT_FALSE(mesh.segments.empty());
  EXPECT_EQ(shell.midsides.first_inner, shell.corner_nodes + mesh.segments.size());
  for (const auto& segment : mesh.segments) {
    EXPECT_GE(static_cast<std::size_t>(segment.middle), shell.corner_nodes);
    EXPECT_LT(static_cast<std::size_t>(segment.middle), shell.midsides.first_inner);
    const Vector3 &a = mesh.points[segment.nodes[0]], &b = mesh.points[segment.nodes[1]],
                  &middle = mesh.points[segment.middle];
    EXPECT_NEAR((middle - a).norm(), (middle - b).norm(), 1e-8);
    EXPECT_NEAR(std::hypot(middle.x() / 9, middle.y() / 4), 1, 1e-9);
  }
}

TEST(Midsides, LieOnTheirSurfacesNearTheMiddle) {
  for (const TopoDS_Shape& solid :
       {BRepPrimAPI_MakeCylinder(5, 8).Shape(), BRepPrimAPI_MakeSphere(5).Shape()}) {
    const SecondOrder shell(solid);
    const ShellMesh& mesh = shell.mesh;
    ASSERT_EQ(mesh.midsides.size(), mesh.quads.size());
    ASSERT_EQ(shell.midsides.parameters.size(), mesh.points.size() - shell.midsides.first_inner);
    for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
      const FaceId face = shell.numbering.face_of(quad);
      const FaceSurface surface(shell.parts.model.shape().faces[face]);
      for (int k = 0; k < 4; ++k) {
        const auto node = static_cast<std::size_t>(mesh.midsides[quad][k]);
        const Vector3 &a = mesh.points[mesh.quads[quad][k]], &b = mesh.points[mesh.quads[quad][(k + 1) % 4]];
        EXPECT_LT((mesh.points[node] - 0.5 * (a + b)).norm(), 0.15 * (b - a).norm());
        if (node < shell.midsides.first_inner) continue;
        Vector2 uv = shell.midsides.parameters[node - shell.midsides.first_inner];
        EXPECT_LT((surface.point(uv) - mesh.points[node]).norm(), 1e-7);
        EXPECT_LT((surface.nearest(uv, 0.5 * (a + b)) - mesh.points[node]).norm(), 1e-6);
      }
    }
  }
}

TEST(Midsides, OfASideAreOneNodeForBothQuads) {
  const SecondOrder shell(BRepPrimAPI_MakeSphere(5).Shape());
  std::map<std::pair<int, int>, int> middles;
  std::size_t sides = 0;
  for (std::size_t quad = 0; quad < shell.mesh.quads.size(); ++quad)
    for (int k = 0; k < 4; ++k, ++sides) {
      const auto& corners = shell.mesh.quads[quad];
      const int node = shell.mesh.midsides[quad][k];
      EXPECT_EQ(middles.try_emplace(std::minmax(corners[k], corners[(k + 1) % 4]), node).first->second, node);
    }
  EXPECT_EQ(2 * middles.size(), sides);
  EXPECT_EQ(shell.mesh.points.size(), shell.corner_nodes + middles.size());
}

}  // namespace
}  // namespace quadrille
