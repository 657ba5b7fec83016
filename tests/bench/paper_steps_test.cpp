/// The paper's collapse of boundary triangles and its smoothing.

#include "bench/paper_steps.hpp"

#include <gtest/gtest.h>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/recombine.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

QuadMesh colored(const TriangleMesh& mesh, std::uint64_t seed) {
  RecombineOptions options;
  options.method = Method::paper;
  options.leftovers = Leftovers::leave;
  options.seed = seed;
  ExecutionContext context;
  return recombine(mesh, options, context);
}

double mean_q(const QuadMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.quads)
    sum += quad_q(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
  return sum / static_cast<double>(mesh.quads.size());
}

/// No element has a point twice, and no side comes twice the same way.
bool is_manifold(const QuadMesh& mesh) {
  std::set<std::pair<int, int>> sides;
  const auto add = [&](const auto& elements) {
    for (const auto& corners : elements) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const int a = corners[i], b = corners[(i + 1) % corners.size()];
        if (a == b || !sides.insert({a, b}).second) return false;
      }
    }
    return true;
  };
  return add(mesh.quads) && add(mesh.triangles);
}

TEST(CollapseBoundaryTriangles, JoinsTheEndsOfTheBoundarySide) {
  // Two squares over a flat triangle on the boundary.
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.quads = {{0, 2, 3, 4}, {2, 1, 5, 3}};
  EXPECT_EQ(collapse_boundary_triangles(mesh), 1);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_EQ(mesh.points[0], Vector3(1, 0, 0));
  EXPECT_EQ(mesh.quads[1], (std::array<int, 4>{2, 0, 5, 3}));
  EXPECT_TRUE(is_manifold(mesh));
}

TEST(CollapseBoundaryTriangles, LeavesInnerTrianglesAndEars) {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -1, 0}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.triangles = {{0, 4, 1}};  // two sides on the boundary
  EXPECT_EQ(collapse_boundary_triangles(mesh), 0);
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

TEST(CollapseBoundaryTriangles, TakesMostOfWhatColorsLeave) {
  std::size_t left = 0;
  int collapsed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    QuadMesh mesh = colored(grid(20, 15, seed), seed);
    const std::size_t before = mesh.triangles.size();
    const int count = collapse_boundary_triangles(mesh);
    EXPECT_EQ(mesh.triangles.size() + static_cast<std::size_t>(count), before);
    EXPECT_TRUE(is_manifold(mesh));
    left += mesh.triangles.size();
    collapsed += count;
  }
  EXPECT_GT(collapsed, 0) << "no sample has a triangle to collapse";
  EXPECT_LT(left, static_cast<std::size_t>(collapsed));
}

TEST(SmoothPoor, RaisesTheMeanAndHoldsTheBoundary) {
  const TriangleMesh triangles = grid(20, 15, 4);
  RecombineOptions options;
  options.method = Method::paper;
  ExecutionContext context;
  QuadMesh mesh = recombine(triangles, options, context);
  const QuadMesh before = mesh;
  EXPECT_GT(smooth_poor(mesh), 0);
  EXPECT_GT(mean_q(mesh), mean_q(before));
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vector3& p = before.points[v];
    const bool on_boundary = p.x() == 0 || p.y() == 0 || p.x() == 20 || p.y() == 15;
    EXPECT_TRUE(!on_boundary || mesh.points[v] == p);
  }
}

TEST(SmoothPoor, LeavesGoodMeshesAlone) {
  ExecutionContext context;
  QuadMesh mesh = recombine(grid(8, 8), {}, context);
  EXPECT_EQ(smooth_poor(mesh), 0);
}

}  // namespace
}  // namespace quadrille
