/// Measures of quads with known values, and counts over meshes made by hand.

#include "mesher/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

constexpr double pi = std::numbers::pi;

Vector3 flat(double x, double y) {
  return {x, y, 0};
}

/// A grid of n x n unit squares in the plane; `face_of` gives the face of a cell.
ShellMesh grid(int n, int (*face_of)(int, int)) {
  ShellMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.push_back(flat(i, j));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
      mesh.quad_faces.push_back(face_of(i, j));
    }
  return mesh;
}

TEST(QuadQ, IsOneForRectanglesOfAnyShapeAndPlace) {
  EXPECT_NEAR(quad_q(flat(0, 0), flat(1, 0), flat(1, 1), flat(0, 1)), 1, 1e-12);
  EXPECT_NEAR(quad_q({1, 2, 3}, {1, 12, 3}, {1, 12, 4}, {1, 2, 4}), 1, 1e-12);
}

TEST(QuadQ, FallsWithTheWorstAngle) {
  // A rhombus of 60 and 120 degrees: off by 30 degrees of 90.
  const double h = std::sqrt(3) / 2;
  EXPECT_NEAR(quad_q(flat(0, 0), flat(1, 0), flat(1.5, h), flat(0.5, h)), 2.0 / 3, 1e-12);
  // A trapezium with one pair of 45 degrees.
  EXPECT_NEAR(quad_q(flat(0, 0), flat(3, 0), flat(2, 1), flat(1, 1)), 0.5, 1e-12);
}

TEST(QuadQ, IsZeroForStraightReflexAndFoldedCorners) {
  EXPECT_DOUBLE_EQ(quad_q(flat(0, 0), flat(1, 0), flat(2, 0), flat(1, 1)), 0);
  EXPECT_DOUBLE_EQ(quad_q(flat(0, 0), flat(2, 0), flat(0.2, 0.2), flat(0, 2)), 0);
  EXPECT_DOUBLE_EQ(quad_q(flat(0, 0), flat(1, 1), flat(1, 0), flat(0, 1)), 0);
  EXPECT_DOUBLE_EQ(quad_q(flat(0, 0), flat(0, 0), flat(1, 0), flat(1, 1)), 0);
}

TEST(ScaledJacobian, IsTheLeastSine) {
  const double h = std::sqrt(3) / 2;
  EXPECT_NEAR(quad_scaled_jacobian(flat(0, 0), flat(7, 0), flat(7, 2), flat(0, 2)), 1, 1e-12);
  EXPECT_NEAR(quad_scaled_jacobian(flat(0, 0), flat(1, 0), flat(1.5, h), flat(0.5, h)), h, 1e-12);
}

TEST(ScaledJacobian, DoesNotDependOnOrientationOrFirstCorner) {
  const Vector3 a = flat(0, 0), b = flat(2, 0.3), c = flat(1.7, 1), d = flat(-0.2, 1.4);
  const double reference = quad_scaled_jacobian(a, b, c, d);
  EXPECT_NEAR(quad_scaled_jacobian(b, c, d, a), reference, 1e-14);
  EXPECT_NEAR(quad_scaled_jacobian(d, c, b, a), reference, 1e-14);
}

TEST(ScaledJacobian, IsNotPositiveForBadQuads) {
  EXPECT_NEAR(quad_scaled_jacobian(flat(0, 0), flat(1, 0), flat(2, 0), flat(1, 1)), 0, 1e-15);
  EXPECT_LT(quad_scaled_jacobian(flat(0, 0), flat(2, 0), flat(0.2, 0.2), flat(0, 2)), 0);
  EXPECT_LE(quad_scaled_jacobian(flat(0, 0), flat(1, 1), flat(1, 0), flat(0, 1)), 0);
  EXPECT_DOUBLE_EQ(quad_scaled_jacobian(flat(0, 0), flat(0, 0), flat(0, 0), flat(0, 0)), 0);
}

TEST(ScaledJacobian, EqualsTheSineOfQForConvexQuads) {
  const Vector3 a = flat(0, 0), b = flat(1.2, -0.1), c = flat(1.4, 1.1), d = flat(0.1, 0.8);
  EXPECT_NEAR(std::sin(pi / 2 * quad_q(a, b, c, d)), quad_scaled_jacobian(a, b, c, d), 1e-12);
}

TEST(Quality, OfAGridOfSquares) {
  const QualitySummary summary = quality(grid(4, [](int, int) { return 1; }));
  EXPECT_EQ(summary.nodes, 25);
  EXPECT_EQ(summary.quads, 16);
  EXPECT_EQ(summary.triangles, 0);
  EXPECT_NEAR(summary.q_min, 1, 1e-12);
  EXPECT_NEAR(summary.q_mean, 1, 1e-12);
  EXPECT_NEAR(summary.sj_mean, 1, 1e-12);
  EXPECT_EQ(summary.inverted, 0);
  EXPECT_EQ(summary.q_histogram[19], 16);
  EXPECT_DOUBLE_EQ(summary.irregular_percent, 0);
  ASSERT_EQ(summary.valence_counts.size(), 5u);
  EXPECT_EQ(summary.valence_counts[4], 9);
  EXPECT_NEAR(summary.aspect_max, 1, 1e-12);
  EXPECT_NEAR(summary.edge_median, 1, 1e-12);
  EXPECT_NEAR(summary.warping_max_degrees, 0, 1e-6);
}

TEST(Quality, LeavesNodesBetweenFacesOutOfTheIrregularOnes) {
  // Two faces: the column of nodes between them is on a CAD edge.
  const QualitySummary summary = quality(grid(4, [](int i, int) { return i < 2 ? 1 : 2; }));
  EXPECT_EQ(std::accumulate(summary.valence_counts.begin(), summary.valence_counts.end(), 0), 6);
}

TEST(Quality, CountsIrregularNodesOfACube) {
  ShellMesh cube;
  for (int i = 0; i < 8; ++i) cube.points.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  cube.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  cube.quad_faces.assign(6, 1);
  const QualitySummary summary = quality(cube);
  EXPECT_DOUBLE_EQ(summary.irregular_percent, 100);
  ASSERT_EQ(summary.valence_counts.size(), 4u);
  EXPECT_EQ(summary.valence_counts[3], 8);
}

TEST(Quality, CountsElementsThatFoldAtSecondOrder) {
  ShellMesh mesh = test::ShellGrid(3, 2, 0).mesh();
  EXPECT_EQ(quality(mesh).inverted, 0);
  EXPECT_NEAR(quality(mesh).jacobian_min, 1, 1e-9);
  // The lower side of an inner element, bulged up over the upper one: two elements share it, and one of them
  // folds.
  const int node = mesh.midsides[8][0];
  ASSERT_EQ(node, mesh.midsides[2][2]);
  mesh.points[node].y() += 0.45;
  const QualitySummary summary = quality(mesh);
  EXPECT_EQ(summary.inverted, 1);
  EXPECT_LT(summary.jacobian_min, 0);
  EXPECT_NEAR(summary.sj_min, 1, 1e-9);
}

TEST(Quality, LeastJacobianOfFlatQuadsIsThatOfTheirCorners) {
  ShellMesh mesh;
  mesh.points = {flat(0, 0), flat(2, 0), flat(1.5, 1), flat(0, 1)};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.quad_faces = {1};
  // Corner parallelograms 2, 2, 1.5, 1.5; the mean is the area, 1.75.
  EXPECT_NEAR(quality(mesh).jacobian_min, 1.5 / 1.75, 1e-12);
  mesh.order = 2;
  mesh.midsides = {{4, 5, 6, 7}};
  mesh.points.insert(mesh.points.end(), {flat(1, 0), flat(1.75, 0.5), flat(0.75, 1), flat(0, 0.5)});
  EXPECT_NEAR(quality(mesh).jacobian_min, 1.5 / 1.75, 1e-12);
}

TEST(Quality, MeasuresAspectWarpingAndInversion) {
  ShellMesh mesh;
  mesh.points = {flat(0, 0), flat(4, 0), flat(4, 1), flat(0, 1), flat(8, 0), flat(5, 0.2)};
  mesh.quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  mesh.quad_faces = {1, 1};
  QualitySummary summary = quality(mesh);
  EXPECT_GE(summary.aspect_max, 4);
  EXPECT_EQ(summary.inverted, 1);
  EXPECT_LT(summary.sj_min, 0);
  EXPECT_EQ(std::accumulate(summary.q_histogram.begin(), summary.q_histogram.end(), 0), 2);

  ShellMesh warped;
  warped.points = {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, 0.5}};
  warped.quads = {{0, 1, 2, 3}};
  warped.quad_faces = {1};
  summary = quality(warped);
  // Each corner's normal is (-+0.5, -+0.5, 1): tilted by atan(sqrt(0.5)) from the mean (0, 0, 1).
  EXPECT_NEAR(summary.warping_max_degrees, std::atan(std::sqrt(0.5)) * 180 / pi, 1e-9);
}

TEST(Quality, OfNothingIsZero) {
  const QualitySummary summary = quality(ShellMesh{});
  EXPECT_EQ(summary.quads, 0);
  EXPECT_DOUBLE_EQ(summary.q_mean, 0);
  EXPECT_DOUBLE_EQ(summary.edge_max, 0);
}

TEST(QuadQualities, AreThoseOfTheQuads) {
  ShellMesh mesh;
  mesh.points = {flat(0, 0), flat(1, 0), flat(1, 1), flat(0, 1), flat(3, 0), flat(2, 1)};
  mesh.quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  const std::vector<double> q = quad_qualities(mesh);
  ASSERT_EQ(q.size(), 2u);
  EXPECT_NEAR(q[0], 1, 1e-12);
  EXPECT_NEAR(q[1], 0.5, 1e-12);
}

}  // namespace
}  // namespace quadrille
