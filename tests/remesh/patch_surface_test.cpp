/// Points of one face of a triangulation are found among long narrow triangles and on the right sheet.

#include "mesher/remesh/patch_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace quadrille {
namespace {

/// A tube of radius 1 from z = 0 to 10, of triangles from end to end, cut into two faces at z = 5.
struct Tube {
  static constexpr int around = 200;
  TriangleMesh mesh;
  std::vector<int> patches;

  Tube() {
    for (const double z : {0.0, 5.0, 10.0})
      for (int i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        mesh.points.push_back({std::cos(angle), std::sin(angle), z});
      }
    for (int patch = 0; patch < 2; ++patch)
      for (int i = 0; i < around; ++i) {
        const int a = patch * around + i, b = patch * around + (i + 1) % around;
        mesh.triangles.push_back({a, b, b + around});
        mesh.triangles.push_back({a, b + around, a + around});
        patches.insert(patches.end(), 2, patch);
      }
  }
};

TEST(PatchSurface, FindsTheNearestPointOfItsFace) {
  const Tube tube;
  const TriangulatedSurface whole(tube.mesh);
  const SurfaceLocator locator(tube.mesh, tube.patches, 2);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0, 6.28), height(-1, 11), radius(0.7, 1.5);
  for (int i = 0; i < 200; ++i) {
    const double turn = angle(random), z = height(random), r = radius(random);
    const Vector3 target(r * std::cos(turn), r * std::sin(turn), z);
    for (const int patch : {0, 1}) {
      const PatchSurface surface(whole, locator, patch);
      Vector2 uv;
      Vector3 normal;
      const Vector3 found = surface.find(target, uv, normal);
      EXPECT_LE((found - target).norm(), (locator.nearest(patch, target).point - target).norm() + 1e-12);
      const Vector3 outward(std::cos(turn), std::sin(turn), 0);
      EXPECT_GT(normal.dot(outward), 0.99);
      const auto& corners = tube.mesh.triangles[static_cast<std::size_t>(uv.x())];
      const Vector3 side = tube.mesh.points[corners[1]] - tube.mesh.points[corners[0]],
                    other = tube.mesh.points[corners[2]] - tube.mesh.points[corners[0]];
      EXPECT_LT(std::abs((found - tube.mesh.points[corners[0]]).dot(side.cross(other).normalized())), 1e-9)
          << "on the triangle of its parameters";
    }
  }
}

/// A walk from strip to strip around the tube ends where it comes no closer; the tree of boxes goes on.
TEST(PatchSurface, MovesAlongNarrowTriangles) {
  const Tube tube;
  const TriangulatedSurface whole(tube.mesh);
  const SurfaceLocator locator(tube.mesh, tube.patches, 2);
  const PatchSurface surface(whole, locator, 0);
  for (int i = -45; i <= 45; ++i) {
    const double turn = 2 * std::numbers::pi * (i + 0.5) / Tube::around;
    const Vector3 target(1.1 * std::cos(turn), 1.1 * std::sin(turn), 4);
    Vector2 uv(0, 0);
    Vector3 normal;
    const Vector3 found = surface.move(uv, target, normal);
    EXPECT_LT((found - locator.nearest(0, target).point).norm(), 1e-9) << i;
  }
}

/// A thin plate folded over, whose two sheets look up and down: what is below is another sheet.
TEST(PatchSurface, StaysOnItsSheet) {
  TriangleMesh mesh;
  constexpr int n = 10;
  const auto add_point = [&](double x, double z) {
    for (const double y : {0.0, 1.0}) mesh.points.push_back({x, y, z});
  };
  for (int i = 0; i <= n; ++i) add_point(i, 0.1);
  for (int i = n; i >= 0; --i) add_point(i, 0);
  for (int i = 0; i <= 2 * n; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  const TriangulatedSurface whole(mesh);
  const SurfaceLocator locator(mesh, std::vector<int>(mesh.triangles.size(), 0), 1);
  const PatchSurface surface(whole, locator, 0);
  const Vector3 target(3.3, 0.5, 0.02);  // nearer to the sheet below
  ASSERT_EQ(locator.nearest(0, target).point.z(), 0);
  for (const int start : {0, 2 * n + 2}) {
    Vector2 uv(start, 0);
    Vector3 normal;
    const bool above = start == 0;
    EXPECT_NEAR(surface.move(uv, target, normal).z(), above ? 0.1 : 0, 1e-12);
    EXPECT_NEAR(normal.z(), above ? 1 : -1, 1e-9);
  }
}

}  // namespace
}  // namespace quadrille
