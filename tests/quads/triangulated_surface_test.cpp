/// Quads improved on the triangulation that they were made of.

#include "mesher/quads/triangulated_surface.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

struct Improved {
  QuadMesh quads;
  std::vector<int> renumbered;
};

Improved improved(const TriangleMesh& mesh, const ImproveOptions& options = {}) {
  ExecutionContext context;
  Improved result;
  result.quads = improve_on(mesh, recombine(mesh, {}, context), options, result.renumbered, context);
  return result;
}

double mean_q(const QuadMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.quads) {
    sum += quad_q(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
  }
  return sum / static_cast<double>(mesh.quads.size());
}

TEST(TriangulatedSurface, MovesToTheNearestPointAcrossTriangles) {
  const TriangleMesh sphere = icosphere(4);
  const TriangulatedSurface surface(sphere);
  Vector2 uv = surface.parameters_of(0);
  Vector3 at = sphere.points[0], normal;
  // Small steps along a great circle, as smoothing takes them.
  const Vector3 axis = at.cross(Vector3(0.3, 0.2, 0.9)).normalized();
  for (int step = 0; step < 60; ++step) {
    const Vector3 target = at + 0.05 * axis.cross(at);
    at = surface.move(uv, target, normal);
    EXPECT_NEAR(at.norm(), 1, 3e-3);
    EXPECT_LT((at - target).norm(), 0.01);
    EXPECT_GT(normal.dot(at.normalized()), 0.99);
  }
}

TEST(TriangulatedSurface, StaysOnTheBoundary) {
  const TriangleMesh square = grid(4, 4);
  const TriangulatedSurface surface(square);
  Vector2 uv = surface.parameters_of(12);
  Vector3 normal;
  EXPECT_NEAR((surface.move(uv, {2.4, 9, 1}, normal) - Vector3(2.4, 4, 0)).norm(), 0, 1e-12);
  EXPECT_TRUE(surface.on_boundary(0));
  EXPECT_FALSE(surface.on_boundary(12));
}

TEST(TriangulatedSurface, PlanarQuadsGetBetterAndKeepTheirBoundary) {
  const TriangleMesh mesh = random_square(2000, 5);
  const Improved result = improved(mesh);
  EXPECT_TRUE(validate(result.quads).empty());
  ExecutionContext context;
  EXPECT_GT(mean_q(result.quads), mean_q(recombine(mesh, {}, context)) + 0.1);
  for (int v = 0; v < 4; ++v) {
    ASSERT_GE(result.renumbered[v], 0);
    EXPECT_EQ(result.quads.points[result.renumbered[v]], mesh.points[v]);
  }
  EXPECT_NEAR(area_vector(result.quads.points, result.quads.quads).z(), 1, 1e-9);
}

TEST(TriangulatedSurface, ClosedSurfacesStayClosedAndInPlace) {
  const Improved result = improved(icosphere(4));
  EXPECT_TRUE(validate(result.quads).empty());
  EXPECT_TRUE(result.quads.triangles.empty());
  for (const Vector3& p : result.quads.points) EXPECT_NEAR(p.norm(), 1, 5e-3);
  EXPECT_GT(mean_q(result.quads), 0.75);
}

TEST(TriangulatedSurface, TagsShareThePointsBetweenThem) {
  TriangleMesh mesh = random_square(1500, 8);
  for (const auto& [a, b, c] : mesh.triangles) {
    mesh.tags.push_back((mesh.points[a] + mesh.points[b] + mesh.points[c]).x() < 1.5 ? 4 : 2);
  }
  const Improved result = improved(mesh);
  EXPECT_TRUE(validate(result.quads).empty());
  ASSERT_EQ(result.quads.quad_tags.size(), result.quads.quads.size());
  std::map<int, double> before, after;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    before[mesh.tags[t]] += area_vector(mesh.points, Triangles{mesh.triangles[t]}).z();
  }
  const auto& quads = result.quads;
  for (std::size_t q = 0; q < quads.quads.size(); ++q) {
    after[quads.quad_tags[q]] += area_vector(quads.points, std::vector{quads.quads[q]}).z();
  }
  for (std::size_t t = 0; t < quads.triangles.size(); ++t) {
    after[quads.triangle_tags[t]] += area_vector(quads.points, Triangles{quads.triangles[t]}).z();
  }
  for (const auto& [tag, area] : before) EXPECT_NEAR(after[tag], area, 1e-9);
}

TEST(TriangulatedSurface, WithoutCleanUpOnlyPlacesChange) {
  const TriangleMesh mesh = random_square(600, 3);
  ImproveOptions options;
  options.clean_up = false;
  ExecutionContext context;
  const Improved result = improved(mesh, options);
  EXPECT_EQ(result.quads.quads.size(), recombine(mesh, {}, context).quads.size());
  EXPECT_EQ(result.quads.points.size(), mesh.points.size());
}

}  // namespace
}  // namespace quadrille
