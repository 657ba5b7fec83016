/// Rows of given heights along closed loops and open chains: holes with and without corners, thin tips, ends
/// on other edges and free ends, and rows that do not fit.

#include "mesher/faces/loop_rows.hpp"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

TopoDS_Wire polygon(const std::vector<std::array<double, 2>>& corners) {
  BRepBuilderAPI_MakePolygon result;
  for (const auto& [x, y] : corners) result.Add(gp_Pnt(x, y, 0));
  result.Close();
  return result.Wire();
}

/// A plane face. The edges of the outline have the first numbers, from 1; those of the hole follow.
CadModel plane(const TopoDS_Wire& outline, const TopoDS_Wire& hole = {}) {
  BRepBuilderAPI_MakeFace face(gp_Pln(), outline);
  if (!hole.IsNull()) face.Add(TopoDS::Wire(hole.Reversed()));
  return CadModel(std::make_shared<CadShape>(face.Face(), "plate"));
}

/// A plate of 100 x 60 with a hole. The hole's edges are Edge5 and so on.
CadModel plate_with(const TopoDS_Wire& hole) {
  return plane(polygon({{0, 0}, {100, 0}, {100, 60}, {0, 60}}), hole);
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

/// The quads of a face with a side on the edges, and then those beyond them: the heights of each row at all
/// its quads.
std::vector<std::vector<double>> heights_of_rows(const ShellMesh& mesh, int rows, const std::set<int>& edges,
                                                 int face = 1) {
  std::vector<char> below(mesh.points.size(), 0);
  for (const auto& segment : mesh.segments)
    if (edges.contains(segment.edge)) below[segment.nodes[0]] = below[segment.nodes[1]] = 1;
  std::vector<std::vector<double>> result;
  std::vector<char> used(mesh.quads.size(), 0);
  for (int row = 0; row < rows; ++row) {
    std::vector<char> above(mesh.points.size(), 0);
    result.emplace_back();
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      for (int k = 0; k < 4 && !used[i] && mesh.quad_faces[i] == face; ++k) {
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
      for (const auto& row : heights_of_rows(made, layers.count, {5, 6, 7, 8})) {
        EXPECT_GE(row.size(), 2U * static_cast<unsigned>(on_wall));
        for (const double height : row) EXPECT_NEAR(height, wanted, 0.05 * wanted);
        wanted *= layers.ratio;
      }
      EXPECT_LT(made.quads.size(),
                2500U);  // quads as small as the first row is high would be a hundred thousand
    }
  }
}

/// A section of 100 by 12, whose lower side is Edge5 and whose upper side is Edge6, with a sharp trailing
/// edge.
TopoDS_Wire airfoil() {
  constexpr int n = 24;
  const auto side = [&](double sign) {
    TColgp_Array1OfPnt points(0, n);
    for (int i = 0; i <= n; ++i) {
      const double x = 0.5 * (1 - std::cos(M_PI * i / n));
      const double half = 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                                 0.1036 * x * x * x * x);
      points.SetValue(i, gp_Pnt(100 * x, sign * 100 * half, 0));
    }
    return BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(points).Curve()).Edge();
  };
  return BRepBuilderAPI_MakeWire(side(-1), side(1));
}

struct Chain {
  std::string name;
  CadModel model;
  std::set<int> edges;
};

std::vector<Chain> chains() {
  const TopoDS_Wire ell = polygon({{0, 0}, {60, 0}, {60, 25}, {25, 25}, {25, 70}, {0, 70}});
  std::vector<Chain> result;
  result.push_back({"plate with a hole", plate_with(circle()), {1}});
  result.push_back({"both long edges", plate_with(circle()), {1, 3}});
  result.push_back({"three edges", plate_with(circle()), {1, 2, 3}});
  result.push_back({"outer corner", plane(ell), {1, 2}});
  result.push_back({"inner corner", plane(ell), {3, 4}});
  result.push_back({"sharp ends", plane(polygon({{0, 0}, {100, 0}, {80, 60}, {45, 60}}), circle()), {1}});
  result.push_back({"blunt ends", plane(polygon({{0, 0}, {100, 0}, {130, 60}, {-40, 60}}), circle()), {1}});
  result.push_back(
      {"airfoil", plane(polygon({{-150, -150}, {250, -150}, {250, 150}, {-150, 150}}), airfoil()), {6}});
  return result;
}

TEST(ChainRows, HaveTheHeightsAskedFor) {
  const SizeLayers layers{0.1, 1.3, 7};
  for (const auto& [name, model, edges] : chains()) {
    for (const int order : {1, 2}) {
      SCOPED_TRACE(name + " " + std::to_string(order));
      MeshOptions options;
      options.order = order;
      options.sizing.size = 4;
      for (const int edge : edges) options.sizing.layers.edges[edge] = layers;
      ExecutionContext context(2);
      const ShellMesh made = mesh(model, options, context);
      EXPECT_EQ(made.warnings, std::vector<std::string>{});
      EXPECT_EQ(validate(made), std::vector<std::string>{});
      double least_q = 1;
      for (const auto& quad : made.quads) least_q = std::min(least_q, quad_q(made.points, quad));
      EXPECT_GT(least_q, 0.3);
      int on_wall = 0;
      for (const auto& segment : made.segments) on_wall += edges.contains(segment.edge) ? 1 : 0;
      double wanted = layers.first;
      for (const auto& row : heights_of_rows(made, layers.count, edges)) {
        EXPECT_GE(row.size(), 2U * static_cast<unsigned>(on_wall));
        for (const double height : row) EXPECT_NEAR(height, wanted, 0.05 * wanted);
        wanted *= layers.ratio;
      }
    }
  }
}

/// The number of the edge of a model whose middle is nearest to a point.
int edge_near(const CadModel& model, const Vector3& at) {
  double nearest = 1e9;
  int result = 0;
  for (const CadEdge& edge : model.shape().edges) {
    const double distance = (EdgeCurve(edge).point(0.5 * (edge.first + edge.last)) - at).norm();
    if (distance < nearest) result = edge.number;
    nearest = std::min(nearest, distance);
  }
  return result;
}

TEST(ChainRows, LeaveTheFaceAcrossAsItIs) {
  const TopoDS_Shape drilled =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(100, 60, 8).Shape(),
                      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(50, 30, -1), gp::DZ()), 10, 10).Shape());
  const CadModel model(std::make_shared<CadShape>(drilled, "drilled"));
  const SizeLayers layers{0.1, 1.3, 6};
  for (const Vector3& at : {Vector3(50, 0, 8), Vector3(40, 30, 8)}) {
    const int edge = edge_near(model, at);
    MeshOptions options;
    options.sizing.size = 4;
    options.sizing.layers.edges[edge] = layers;
    ExecutionContext context(2);
    const ShellMesh made = mesh(model, options, context);
    EXPECT_EQ(validate(made, true), std::vector<std::string>{});
    EXPECT_EQ(made.warnings, std::vector<std::string>{});
    for (const FaceId face : model.shape().edges[edge_id(edge)].faces) {
      const std::vector<double> heights = heights_of_rows(made, 1, {edge}, face.number())[0];
      ASSERT_FALSE(heights.empty());
      const double lowest = *std::min_element(heights.begin(), heights.end());
      const bool is_top = model.shape().faces[face].wires.size() == 2;
      if (is_top) {
        EXPECT_NEAR(lowest, layers.first, 0.05 * layers.first);
      } else if (at.x() < 45) {
        EXPECT_GT(lowest, 2);  // the wall of the hole
      }
    }
  }
}

TEST(ChainRows, WarnWhereTheyCannotEnd) {
  const auto warnings = [](const CadModel& model, const std::map<int, SizeLayers>& layers) {
    MeshOptions options;
    options.sizing.size = 4;
    options.sizing.layers.edges = layers;
    ExecutionContext context(2);
    const ShellMesh made = mesh(model, options, context);
    EXPECT_EQ(validate(made), std::vector<std::string>{});
    std::string all;
    for (const std::string& warning : made.warnings) all += warning + "\n";
    return all;
  };
  const CadModel wedge = plane(polygon({{0, 0}, {100, 0}, {60, 30}, {50, 30}})), plate = plate_with(circle());
  EXPECT_EQ(warnings(wedge, {{1, {0.5, 1.3, 4}}}),
            "`layers` on Edge1 give sizes but no rows: its angle of 31 degrees with Edge4 in Face1 is too "
            "sharp for rows to end there\n");
  EXPECT_NE(warnings(plate, {{1, {0.5, 1.3, 4}}, {2, {0.5, 1.3, 5}}})
                .find("Edge1 give sizes but no rows: its rows would end on Edge2, which has other layers"),
            std::string::npos);
  EXPECT_NE(warnings(plate, {{1, {2, 1.3, 9}}}).find("which is too short for them"), std::string::npos);
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
