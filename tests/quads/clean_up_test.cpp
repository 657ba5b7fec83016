/// Meshes that are cleaned up stay valid with their boundary.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mesher/mesh/quality.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/quad_grid.hpp"
#include "tests/support/sample_quads.hpp"

namespace quadrille {
namespace {

using namespace testing;
constexpr double straight = 1e-9;

double planar_area(const QuadMesh& mesh) {
  double sum = 0;
  for (const auto& q : mesh.quads)
    sum += 0.5 * (mesh.points[q[2]] - mesh.points[q[0]]).cross(mesh.points[q[3]] - mesh.points[q[1]]).z();
  return sum;
}

/// Quads turned away from the surface normals at their nodes.
int turned_over(const SurfaceMesh& mesh) {
  int count = 0;
  for (const auto& q : mesh.mesh.quads) {
    const auto& x = mesh.mesh.points;
    const Vector3 normal = (x[q[2]] - x[q[0]]).cross(x[q[3]] - x[q[1]]);
    for (const int node : q) count += normal.dot(mesh.normals[node]) <= 0;
  }
  return count;
}

void clean(SurfaceMesh& mesh, const MeshSurface& surface = PlanarSurface()) {
  ExecutionContext context(1);
  clean_up(mesh, surface, {}, context);
}

double least_scaled_jacobian(const SurfaceMesh& mesh) {
  return quality(sample::shell(mesh)).sj_min;
}

class CleanUpSamples : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { all = sample::samples(24); }
  static std::vector<sample::Sample> all;
};
std::vector<sample::Sample> CleanUpSamples::all;

TEST_F(CleanUpSamples, StayValidWithTheirBoundary) {
  ASSERT_GE(all.size(), 8u);
  for (const auto& [name, before, surface] : all) {
    SCOPED_TRACE(name);
    ASSERT_EQ(validate(before.mesh), std::vector<std::string>{});
    SurfaceMesh after = before;
    clean(after, *surface);
    EXPECT_EQ(validate(after.mesh, true), std::vector<std::string>{});
    EXPECT_EQ(turned_over(after), 0);
    EXPECT_EQ(euler(after.mesh), euler(before.mesh));
    EXPECT_EQ(after.parameters.size(), after.mesh.points.size());
    EXPECT_EQ(after.normals.size(), after.mesh.points.size());
    EXPECT_EQ(after.fixed.size(), after.mesh.points.size());
    // The fixed points come first, in their old order, where they were; their sides are the same.
    std::vector<int> number(before.mesh.points.size(), -1);
    int next = 0;
    for (std::size_t i = 0; i < before.fixed.size(); ++i) {
      if (!before.fixed[i]) continue;
      ASSERT_EQ(after.mesh.points[next], before.mesh.points[i]);
      EXPECT_TRUE(after.fixed[next]);
      number[i] = next++;
    }
    EXPECT_EQ(std::count(after.fixed.begin(), after.fixed.end(), 1), next);
    SideSet expected;
    for (const auto& [a, b] : open_sides(before.mesh)) expected.insert({number[a], number[b]});
    EXPECT_EQ(open_sides(after.mesh), expected);
  }
}

TEST_F(CleanUpSamples, BecomeFarMoreRegularAndWellShaped) {
  for (const auto& [name, before, surface] : all) {
    SCOPED_TRACE(name);
    SurfaceMesh after = before;
    clean(after, *surface);
    ExecutionContext context(1);
    smooth(after, *surface, {}, context);
    const QualitySummary was = quality(sample::shell(before)), is = quality(sample::shell(after));
    EXPECT_GT(was.irregular_percent, 15);
    EXPECT_LT(is.irregular_percent, 0.5 * was.irregular_percent);
    EXPECT_GT(is.q_mean, 0.8);
    EXPECT_GT(is.q_min, 0.35);
    EXPECT_NEAR(is.quads, was.quads, 0.1 * was.quads);
  }
}

TEST_F(CleanUpSamples, KeepTheArea) {
  for (const auto& [name, before, surface] : all) {
    if (dynamic_cast<const PlanarSurface*>(surface.get()) == nullptr) continue;
    SurfaceMesh after = before;
    clean(after);
    EXPECT_NEAR(planar_area(after.mesh), planar_area(before.mesh), 1e-12 * before.mesh.quads.size()) << name;
  }
}

TEST_F(CleanUpSamples, GiveTheSameResultTwice) {
  for (const auto& [name, before, surface] : all) {
    SurfaceMesh first = before, second = before;
    clean(first, *surface);
    clean(second, *surface);
    EXPECT_EQ(first.mesh.quads, second.mesh.quads) << name;
    EXPECT_EQ(first.mesh.points, second.mesh.points) << name;
  }
}

TEST_F(CleanUpSamples, StayOnTheirSurface) {
  for (const auto& [name, before, surface] : all) {
    SurfaceMesh after = before;
    clean(after, *surface);
    for (std::size_t i = 0; i < after.mesh.points.size(); ++i) {
      Vector2 uv = after.parameters[i];
      Vector3 normal = after.normals[i];
      const Vector3 place = surface->move(uv, after.mesh.points[i], normal);
      EXPECT_LT((place - after.mesh.points[i]).norm(), 1e-12) << name;
      EXPECT_LT((normal - after.normals[i]).norm(), 1e-12) << name;
    }
  }
}

TEST(CleanUp, LeavesARegularGridAlone) {
  const SurfaceMesh before = grid(6, 5);
  SurfaceMesh after = before;
  clean(after);
  EXPECT_EQ(after.mesh.quads.size(), before.mesh.quads.size());
  EXPECT_DOUBLE_EQ(quality(sample::shell(after)).irregular_percent, 0);
}

TEST(CleanUp, CollapsesADoublet) {
  SurfaceMesh mesh = grid(4, 4);
  // The quad 6, 7, 12, 11 is parted by a node with two quads.
  const int node = static_cast<int>(mesh.mesh.points.size());
  mesh.mesh.points.push_back({1.6, 1.4, 0});
  mesh.parameters.push_back({1.6, 1.4});
  mesh.normals.push_back({0, 0, 1});
  mesh.fixed.push_back(0);
  mesh.mesh.quads[5] = {6, 7, 12, node};
  mesh.mesh.quads.push_back({6, node, 12, 11});
  clean(mesh);
  EXPECT_EQ(mesh.mesh.quads.size(), 16u);
  EXPECT_DOUBLE_EQ(quality(sample::shell(mesh)).irregular_percent, 0);
}

TEST(CleanUp, MergesASlenderQuad) {
  // One node of a grid is doubled: between its two copies lies a quad with two corners under 45 degrees.
  SurfaceMesh mesh = grid(6, 6);
  const int node = 24, copy = static_cast<int>(mesh.mesh.points.size());
  mesh.mesh.points.push_back({3, 3.2, 0});
  mesh.parameters.push_back({3, 3.2});
  mesh.normals.push_back({0, 0, 1});
  mesh.fixed.push_back(0);
  mesh.mesh.points[node] = {3, 2.8, 0};
  for (auto& quad : mesh.mesh.quads) {
    const bool above = std::find(quad.begin(), quad.end(), 31) != quad.end();
    if (above) std::replace(quad.begin(), quad.end(), node, copy);
  }
  mesh.mesh.quads.push_back({23, node, 25, copy});
  ASSERT_EQ(validate(mesh.mesh, true), std::vector<std::string>{});
  clean(mesh);
  EXPECT_EQ(mesh.mesh.quads.size(), 36u);
  EXPECT_DOUBLE_EQ(quality(sample::shell(mesh)).irregular_percent, 0);
}

TEST(CleanUp, OpensAStraightCornerOnTheBoundary) {
  // The side from the boundary node 2 inwards is turned away: its one quad is straight there.
  for (const int rows : {2, 4}) {
    SurfaceMesh mesh = grid(4, rows);
    mesh.mesh.quads[1] = {1, 2, 3, 6};
    mesh.mesh.quads[2] = {3, 8, 7, 6};
    ASSERT_TRUE(validate(mesh.mesh).empty());
    ASSERT_LT(least_scaled_jacobian(mesh), straight);
    clean(mesh);
    EXPECT_TRUE(validate(mesh.mesh, true).empty());
    EXPECT_GT(least_scaled_jacobian(mesh), 0.3) << rows;
  }
}

TEST(CleanUp, OpensStraightCornersInARowOfQuads) {
  // Between two straight sides, one row of quads leaning so far that its ends are straight.
  SurfaceMesh mesh = grid(5, 1);
  mesh.mesh.quads = {{0, 1, 2, 6}, {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 5, 9, 8}, {5, 11, 10, 9}};
  ASSERT_TRUE(validate(mesh.mesh).empty());
  ASSERT_LT(least_scaled_jacobian(mesh), straight);
  clean(mesh);
  EXPECT_TRUE(validate(mesh.mesh, true).empty());
  EXPECT_GT(least_scaled_jacobian(mesh), 0.3);
}

TEST(CleanUp, BelievesTheAnglesOfTheCurves) {
  // A disc of eight sides: four corners of 135 degrees carry one quad. On a circle they would be straight.
  SurfaceMesh disc;
  const auto add = [&](double x, double y, bool fixed) {
    disc.mesh.points.push_back({x, y, 0});
    disc.parameters.push_back({x, y});
    disc.normals.push_back({0, 0, 1});
    disc.fixed.push_back(fixed);
    disc.boundary_angles.push_back(0);
  };
  for (int i = 0; i < 8; ++i)
    add(std::cos(i * std::numbers::pi / 4), std::sin(i * std::numbers::pi / 4), true);
  add(0, 0, false);
  disc.mesh.quads = {{0, 1, 2, 8}, {2, 3, 4, 8}, {4, 5, 6, 8}, {6, 7, 0, 8}};
  ASSERT_TRUE(validate(disc.mesh, true).empty());
  const auto quads_at = [](const SurfaceMesh& mesh, int node) {
    return std::count_if(mesh.mesh.quads.begin(), mesh.mesh.quads.end(), [&](const auto& quad) {
      return std::find(quad.begin(), quad.end(), node) != quad.end();
    });
  };
  SurfaceMesh octagon = disc, circle = disc;
  clean(octagon);
  EXPECT_EQ(octagon.mesh.quads.size(), 4u);
  std::fill_n(circle.boundary_angles.begin(), 8, std::numbers::pi);
  clean(circle);
  EXPECT_TRUE(validate(circle.mesh, true).empty());
  EXPECT_EQ(circle.boundary_angles.size(), circle.mesh.points.size());
  for (int node = 0; node < 8; ++node) EXPECT_EQ(quads_at(circle, node), 2) << node;
}

TEST(CleanUp, KeepsTrianglesAndOtherOptions) {
  SurfaceMesh odd = grid(4, 4);
  odd.mesh.quads.pop_back();
  odd.mesh.triangles = {{18, 19, 24}};
  const Vector3 before = odd.mesh.points[18];
  odd.fixed[24] = odd.fixed[19] = odd.fixed[23] = 1;
  clean(odd);
  EXPECT_EQ(validate(odd.mesh), std::vector<std::string>{});
  ASSERT_EQ(odd.mesh.triangles.size(), 1u);
  EXPECT_EQ(odd.mesh.points[odd.mesh.triangles[0][0]], before);

  SurfaceMesh untouched = sample::rectangle(8, 1, 1);
  const auto quads = untouched.mesh.quads;
  ImproveOptions options;
  options.clean_up = false;
  ExecutionContext context(1);
  clean_up(untouched, PlanarSurface(), options, context);
  EXPECT_EQ(untouched.mesh.quads, quads);
}

TEST(CleanUp, LooksWhetherToGoOnAllTheWhile) {
  EXPECT_EQ(sample::rare_looks([](SurfaceMesh& mesh, ExecutionContext& context) {
              clean_up(mesh, PlanarSurface(), {}, context);
            }),
            "");
}

TEST(CleanUp, StopsWhenCancelled) {
  SurfaceMesh mesh = sample::rectangle(8, 1, 1);
  ExecutionContext context(1);
  context.cancel();
  EXPECT_THROW(clean_up(mesh, PlanarSurface(), {}, context), Error);
}

TEST(CleanUp, AcceptsAnEmptyMesh) {
  SurfaceMesh mesh;
  clean(mesh);
  EXPECT_TRUE(mesh.mesh.quads.empty());
}

}  // namespace
}  // namespace quadrille
