/// Rows of given heights along closed loops: holes with and without corners, thin tips, and rows that do not
/// fit.

#include "mesher/faces/loop_rows.hpp"

#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille {
namespace {

/// A plate of 100 x 60 with a hole. The hole's edges are Edge5 and so on.
CadModel plate_with(const TopoDS_Wire& hole) {
  BRepBuilderAPI_MakePolygon outline;
  for (const gp_Pnt& at : {gp_Pnt(0, 0, 0), gp_Pnt(100, 0, 0), gp_Pnt(100, 60, 0), gp_Pnt(0, 60, 0)})
    outline.Add(at);
  outline.Close();
  BRepBuilderAPI_MakeFace face(gp_Pln(), outline.Wire());
  face.Add(TopoDS::Wire(hole.Reversed()));
  return CadModel(std::make_shared<CadShape>(face.Face(), "plate"));
}

TopoDS_Wire rectangle() {
  BRepBuilderAPI_MakePolygon result;
  for (const gp_Pnt& at : {gp_Pnt(40, 25, 0), gp_Pnt(60, 25, 0), gp_Pnt(60, 35, 0), gp_Pnt(40, 35, 0)})
    result.Add(at);
  result.Close();
  return result.Wire();
}

TopoDS_Wire circle() {
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp_Pnt(50, 30, 0), gp::DZ()), 10)));
}

/// Two arcs that meet at tips of 37 degrees.
TopoDS_Wire lens() {
  const gp_Pnt left(35, 30, 0), right(65, 30, 0);
  BRepBuilderAPI_MakeWire result(
      BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(left, gp_Pnt(50, 27.5, 0), right).Value()));
  result.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(right, gp_Pnt(50, 32.5, 0), left).Value()));
  return result;
}

MeshOptions with_layers(int edges, const SizeLayers& layers) {
  MeshOptions options;
  options.sizing.size = 4;
  for (int edge = 5; edge < 5 + edges; ++edge) {
    options.sizing.edge_sizes[edge] = 2;
    options.sizing.layers.edges[edge] = layers;
  }
  return options;
}

/// The quads with a side on the edges, and then those beyond them: the heights of each row at all its quads.
std::vector<std::vector<double>> heights_of_rows(const ShellMesh& mesh, int rows) {
  std::vector<char> below(mesh.points.size(), 0);
  for (const auto& segment : mesh.segments)
    if (segment.edge >= 5) below[segment.nodes[0]] = below[segment.nodes[1]] = 1;
  std::vector<std::vector<double>> result;
  std::vector<char> used(mesh.quads.size(), 0);
  for (int row = 0; row < rows; ++row) {
    std::vector<char> above(mesh.points.size(), 0);
    result.emplace_back();
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      for (int k = 0; k < 4 && !used[i]; ++k) {
        const int a = mesh.quads[i][k], b = mesh.quads[i][(k + 1) % 4], c = mesh.quads[i][(k + 2) % 4],
                  d = mesh.quads[i][(k + 3) % 4];
        if (!below[a] || !below[b] || below[c] || below[d]) continue;
        const Vector3 along = (mesh.points[b] - mesh.points[a]).normalized();
        for (const auto& [from, to] : {std::pair(a, d), std::pair(b, c)})
          result.back().push_back((mesh.points[to] - mesh.points[from]).cross(along).norm());
        above[c] = above[d] = 1;
        used[i] = 1;
      }
    }
    below = above;
  }
  return result;
}

struct Case {
  std::string name;
  std::function<TopoDS_Wire()> hole;
  int edges;
};

TEST(LoopRows, HaveTheHeightsAskedFor) {
  for (const Case& one : {Case{"rectangle", rectangle, 4}, {"circle", circle, 1}, {"lens", lens, 2}}) {
    for (const int order : {1, 2}) {
      SCOPED_TRACE(one.name + " " + std::to_string(order));
      const CadModel model = plate_with(one.hole());
      const SizeLayers layers{0.1, 1.3, 6};
      MeshOptions options = with_layers(one.edges, layers);
      options.order = order;
      ExecutionContext context(2);
      const ShellMesh made = mesh(model, options, context);
      EXPECT_EQ(made.triangles.size(), 0U);
      for (const auto& quad : made.quads) EXPECT_GT(quad_scaled_jacobian(made.points, quad), 0.15);
      int on_wall = 0;
      for (const auto& segment : made.segments) on_wall += segment.edge >= 5 ? 1 : 0;
      double wanted = layers.first;
      for (const auto& row : heights_of_rows(made, layers.count)) {
        EXPECT_GE(row.size(), 2U * static_cast<unsigned>(on_wall));
        for (const double height : row) EXPECT_NEAR(height, wanted, 0.05 * wanted);
        wanted *= layers.ratio;
      }
      EXPECT_LT(made.quads.size(),
                2500U);  // quads as small as the first row is high would be a hundred thousand
    }
  }
}

TEST(LoopRows, NameTheEdgeWhereTheyDoNotFit) {
  const CadModel model = plate_with(circle());
  ExecutionContext context(1);
  try {
    mesh(model, with_layers(1, {2, 1.3, 8}), context);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("`layers` along Edge5 do not fit into Face1"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace quadrille
