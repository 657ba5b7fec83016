/// The problem of inverted quads names the place, what lies there, and the edges around it.

#include "mesher/shell/face_mesher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mesher/mesh/quad_geometry.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/meshed_model.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

/// A square of 10 by 10 with a grid of quads of about 1.
struct Square {
  testing::MeshedModel parts{testing::sheet({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}}), 1};
  FaceMesh& mesh = *parts.faces[face_id(1)];
  std::vector<int> inverted;

  int point_near(const Vector3& place) const {
    const auto& points = mesh.points;
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
      return (a - place).norm() < (b - place).norm();
    });
    return static_cast<int>(nearest - points.begin());
  }

  /// The problem once a point was pulled across quads around it.
  FaceProblem problem_of(int moved, const Vector3& to) {
    const bool turned = quad_area_vector(mesh.points, mesh.quads[0]).z() < 0;
    mesh.points[moved] = to;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      double least = 1;
      for (int k = 0; k < 4; ++k) {
        const auto at = [&](int corner) { return mesh.points[mesh.quads[i][corner % 4]].head<2>().eval(); };
        const Vector2 next = at(k + 1) - at(k), before = at(k + 3) - at(k);
        least = std::min(least, (turned ? -1 : 1) * (next.x() * before.y() - next.y() * before.x()));
      }
      if (least < 0) inverted.push_back(static_cast<int>(i));
    }
    const FaceChart chart = make_chart(parts.model.shape(), face_id(1), parts.nodes, ChartKind::own);
    return inverted_problem(parts.model.shape(), face_id(1), chart, parts.nodes, mesh, inverted);
  }
};

bool says(const FaceProblem& problem, const std::string& part) {
  return std::string(problem.what()).find(part) != std::string::npos;
}

TEST(InvertedQuads, FarFromEdgesLieInsideTheFace) {
  Square square;
  const int node = square.point_near({5, 5, 0});
  const FaceProblem problem = square.problem_of(node, {6.4, 6.4, 0});
  ASSERT_GT(square.inverted.size(), 1U);
  EXPECT_EQ(problem.cause(), Cause::inverted);
  EXPECT_EQ(problem.face(), face_id(1));
  EXPECT_TRUE(says(problem, std::to_string(square.inverted.size()) + " inverted quads") &&
              says(problem, "inside the face"))
      << problem.what();
  EXPECT_TRUE(problem.edges.empty());
}

TEST(InvertedQuads, NameTheVertexOrTheEdgeAndItsNeighbors) {
  Square square;
  const CadShape& shape = square.parts.model.shape();
  const int corner = square.point_near({0, 0, 0});
  const FaceProblem at_vertex = square.problem_of(corner, {1.8, 1.8, 0});
  EXPECT_TRUE(says(at_vertex, "1 inverted quad ")) << at_vertex.what();
  EXPECT_TRUE(says(at_vertex, ", Vertex")) << at_vertex.what();
  EXPECT_EQ(at_vertex.edges.size(), 2U);
  for (const EdgeId edge : at_vertex.edges) {
    const CadEdge& cad = shape.edges[edge];
    EXPECT_LT(std::min(shape.vertices[cad.first_vertex].norm(), shape.vertices[cad.last_vertex].norm()),
              1e-9);
  }

  Square other;
  const int on_edge = other.point_near({5, 0, 0});
  const FaceProblem at_edge = other.problem_of(on_edge, {3.6, 0.3, 0});
  ASSERT_EQ(at_edge.edges.size(), 1U);
  EXPECT_TRUE(says(at_edge, "a node of Edge" + std::to_string(at_edge.edges[0].number()))) << at_edge.what();
}

TEST(InvertedQuads, AreTheFaultOfCurvesThatLieOffTheirEdges) {
  Square square;
  const CadShape& shape = square.parts.model.shape();
  FaceChart chart = make_chart(shape, face_id(1), square.parts.nodes, ChartKind::own);
  const auto cause = [&] {
    return inverted_problem(shape, face_id(1), chart, square.parts.nodes, square.mesh, {0}).cause();
  };
  EXPECT_EQ(cause(), Cause::inverted);
  chart.boundary.uv[2] += Vector2(3, 3);  // three segments away from its node
  EXPECT_EQ(cause(), Cause::stray_curves);
}

}  // namespace
}  // namespace quadrille
