/// Inverted quads that are mended by nodes off the surface.

#include "mesher/quads/improve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/mesh/quality.hpp"

namespace quadrille {
namespace {

/// Four quads around node 4, in the plane z = 0.
QuadMesh star(const Vector3& middle) {
  QuadMesh mesh;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) mesh.points.emplace_back(x, y, 0);
  mesh.points[4] = middle;
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};
  return mesh;
}

double worst(const QuadMesh& mesh) {
  double least = 1;
  for (const auto& [a, b, c, d] : mesh.quads)
    least =
        std::min(least, quad_scaled_jacobian(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
  return least;
}

TEST(UnfoldInSpace, MovesTheFreeNodeOfInvertedQuads) {
  QuadMesh mesh = star({3, 3, 0});
  const QuadMesh before = mesh;
  ASSERT_LE(worst(mesh), 0);
  std::vector<char> fixed(9, 1);
  fixed[4] = 0;
  const std::vector<char> moved = unfold_in_space(mesh.quads, mesh.points, fixed, 1e9, ExecutionContext());
  EXPECT_GT(worst(mesh), 0.9);
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(moved[i], i == 4 ? 1 : 0) << i;
    if (i == 4) continue;
    EXPECT_EQ(mesh.points[i], before.points[i]) << i;
  }
}

TEST(UnfoldInSpace, LeavesValidQuadsAlone) {
  QuadMesh mesh = star({1.2, 0.9, 0});
  const std::vector<char> moved =
      unfold_in_space(mesh.quads, mesh.points, std::vector<char>(9, 0), 1e9, ExecutionContext());
  EXPECT_EQ(std::count(moved.begin(), moved.end(), 1), 0);
  EXPECT_EQ(mesh.points[4], Vector3(1.2, 0.9, 0));
}

TEST(UnfoldInSpace, EndsWhereAllNodesAreFixed) {
  QuadMesh mesh = star({3, 3, 0});
  unfold_in_space(mesh.quads, mesh.points, std::vector<char>(9, 1), 1e9, ExecutionContext());
  EXPECT_LE(worst(mesh), 0);
}

}  // namespace
}  // namespace quadrille
