/// Boundaries that cross themselves: where they do, why, and which numbers of segments would do.

#include "mesher/faces/boundary_crossings.hpp"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>

#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "tests/support/ids.hpp"

namespace quadrille {
namespace {

TopoDS_Wire circle(double radius, bool hole) {
  return BRepBuilderAPI_MakeWire(
      BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(gp::Origin(), hole ? -gp::DZ() : gp::DZ(), gp::DX()), radius)));
}

/// A ring of radii 8 and 10 in a plane, its edges divided into equal segments.
struct Ring {
  CadShape shape;
  FaceSurface surface;
  FaceBoundary boundary;

  static TopoDS_Face face() {
    BRepBuilderAPI_MakeFace result(circle(10, false));
    result.Add(circle(8, true));
    return result.Face();
  }

  Ring(int outside, int inside) : shape(face(), "ring"), surface(shape.faces[face_id(1)]) {
    BoundaryNodes nodes;
    nodes.plans.resize(shape.faces.size());
    nodes.vertex_nodes = IdVector<VertexId, int>(shape.vertices.size(), -1);
    for (const VertexId vertex : shape.vertices.ids()) {
      nodes.vertex_nodes[vertex] = static_cast<int>(nodes.points.size());
      nodes.points.push_back(shape.vertices[vertex]);
    }
    for (const CadEdge& edge : shape.edges) {
      BoundaryNodes::Edge own;
      const int segments = edge.length > 60 ? outside : inside;
      for (int k = 0; k <= segments; ++k) {
        own.parameters.push_back(edge.first + (edge.last - edge.first) * k / segments);
        const bool is_end = k == 0 || k == segments;
        own.nodes.push_back(is_end ? nodes.vertex_nodes[edge.first_vertex]
                                   : static_cast<int>(nodes.points.size()));
        if (!is_end) nodes.points.push_back(EdgeCurve(edge).point(own.parameters.back()));
      }
      nodes.edges.push_back(own);
    }
    boundary = face_boundary(shape, face_id(1), shape.faces[face_id(1)], surface, nodes);
  }

  std::optional<FaceProblem> problem() const {
    return crossing_problem(face_id(1), shape, boundary, surface);
  }
};

TEST(BoundaryCrossings, OfCoarseSegmentsTellHowManyWouldDo) {
  const Ring coarse(4, 32);  // the sides outside come as near to the center as 7.1
  const auto problem = coarse.problem();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->cause(), Cause::coarse_segments);
  ASSERT_FALSE(problem->stretches.empty());
  int most = 0;
  for (const EdgeStretch& stretch : problem->stretches) {
    EXPECT_LT(stretch.from, stretch.to);
    most = std::max(most, stretch.segments);
  }
  EXPECT_FALSE(Ring(4 * most, 32 * most).problem());
}

TEST(BoundaryCrossings, AreNoneWhereSegmentsMeetAtTheirEndsOnly) {
  const Ring fine(32, 24);
  EXPECT_FALSE(fine.problem());
  EXPECT_FALSE(crowding_problem(face_id(1), fine.boundary, fine.surface)) << "all nodes are ends of segments";
  EXPECT_LT(largest_stray(fine.boundary, fine.surface), 1e-9);
}

TEST(BoundaryCrossings, OfCurvesNameTheirEdges) {
  Ring ring(32, 24);
  auto& segments = ring.boundary.segments;
  // A node of the one circle goes across the other: no number of segments helps.
  const int node = segments[4].b;
  const Vector2 moved = ring.boundary.uv[node] * (ring.boundary.uv[node].norm() > 9 ? 0.5 : 1.5);
  ring.boundary.uv[node] = moved;
  const auto stray = ring.problem();
  ASSERT_TRUE(stray);
  EXPECT_EQ(stray->cause(), Cause::stray_curves) << "the node lies elsewhere in space";
  EXPECT_GT(largest_stray(ring.boundary, ring.surface), 2);
  ring.boundary.points[node] = ring.surface.point(moved);
  const auto crossing = ring.problem();
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->cause(), Cause::crossing_curves);
  EXPECT_EQ(crossing->face(), face_id(1));
  EXPECT_EQ(crossing->edges, (std::vector<EdgeId>{edge_id(1), edge_id(2)}));
}

}  // namespace
}  // namespace quadrille
