/// Shaken and folded grids: what moves, what stays, and how often the surface is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "mesher/mesh/quality.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/quad_grid.hpp"
#include "tests/support/sample_quads.hpp"

namespace quadrille {
namespace {

/// A plane that counts how often it is asked.
class CountingPlane : public PlanarSurface {
 public:
  Vector3 move(Vector2& uv, const Vector3& target, Vector3& normal) const override {
    ++calls;
    return PlanarSurface::move(uv, target, normal);
  }
  mutable std::atomic<int> calls{0};
};

/// A grid of squares of side 1 in the plane, its rim fixed.
SurfaceMesh grid(int n) {
  SurfaceMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      mesh.mesh.points.push_back({double(i), double(j), 0});
      mesh.parameters.push_back({double(i), double(j)});
      mesh.normals.push_back({0, 0, 1});
      mesh.fixed.push_back(i == 0 || j == 0 || i == n || j == n);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      mesh.mesh.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return mesh;
}

void relax(SurfaceMesh& mesh, const MeshSurface& surface, int sweeps = 8) {
  ImproveOptions options;
  options.smoothing_sweeps = sweeps;
  ExecutionContext context(1);
  smooth(mesh, surface, options, context);
}

QualitySummary quality_of(const SurfaceMesh& mesh) {
  return quality(sample::shell(mesh));
}

TEST(Smooth, BringsShakenNodesOfAGridBack) {
  SurfaceMesh mesh = grid(12);
  std::mt19937 random(7);
  for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i)
    if (!mesh.fixed[i])
      mesh.mesh.points[i] += Vector3(random() % 1000 - 499.5, random() % 1000 - 499.5, 0) * 0.0006;
  ASSERT_LT(quality_of(mesh).q_mean, 0.8);
  relax(mesh, PlanarSurface(), 60);
  EXPECT_GT(quality_of(mesh).q_min, 0.9);
}

TEST(Smooth, NeverMovesFixedNodes) {
  for (const auto& [name, before, surface] : sample::samples(12)) {
    SurfaceMesh after = before;
    relax(after, *surface);
    int moved = 0;
    for (std::size_t i = 0; i < before.fixed.size(); ++i) {
      if (before.fixed[i]) {
        EXPECT_EQ(after.mesh.points[i], before.mesh.points[i]) << name;
        EXPECT_EQ(after.parameters[i], before.parameters[i]) << name;
      } else {
        moved += after.mesh.points[i] != before.mesh.points[i];
      }
    }
    EXPECT_GT(moved, 0) << name;
    EXPECT_EQ(after.mesh.quads, before.mesh.quads) << name;
  }
}

TEST(Smooth, KeepsRowsBesideConcaveArcsThin) {
  // A quarter of a ring, whose rows averages would leave as wide as they are.
  constexpr int segments = 4, rows = 4;
  constexpr double inner = 2, outer = 10;
  SurfaceMesh mesh = testing::grid(segments, rows);
  for (Vector3& point : mesh.mesh.points) {
    const double angle = M_PI_2 * (1 - point.x() / segments),
                 radius = inner + (outer - inner) * point.y() / rows;
    point = {radius * std::cos(angle), radius * std::sin(angle), 0};
  }
  relax(mesh, PlanarSurface(), 60);
  const double side = 2 * inner * std::sin(M_PI_4 / segments), outer_row = (outer - inner) / rows;
  // The nodes on the straight sides stay, and hold those next to them.
  const auto radius = [&](int row) { return mesh.mesh.points[row * (segments + 1) + segments / 2].norm(); };
  EXPECT_LT(radius(1) - inner, 1.05 * side);
  // The arc outside curves away from the mesh: nothing is kept near it.
  EXPECT_GT(outer - radius(rows - 1), 0.9 * outer_row);
  EXPECT_GT(quality_of(mesh).q_min, 0.5);
}

TEST(Smooth, RaisesTheMeanAndNeverLosesTheWorst) {
  for (const auto& [name, before, surface] : sample::samples(16)) {
    SurfaceMesh after = before;
    relax(after, *surface);
    const QualitySummary was = quality_of(before), is = quality_of(after);
    EXPECT_GT(is.q_mean, was.q_mean + 0.1) << name;
    EXPECT_GE(is.sj_min, std::min(was.sj_min, 0.0)) << name;
    EXPECT_LE(is.inverted, was.inverted) << name;
  }
}

TEST(Smooth, StaysOnTheSurface) {
  for (const auto& [name, before, surface] : sample::samples(12)) {
    SurfaceMesh after = before;
    relax(after, *surface);
    for (std::size_t i = 0; i < after.mesh.points.size(); ++i) {
      Vector2 uv = after.parameters[i];
      Vector3 normal = after.normals[i];
      EXPECT_LT((surface->move(uv, after.mesh.points[i], normal) - after.mesh.points[i]).norm(), 1e-12)
          << name;
    }
  }
}

TEST(Smooth, UntanglesWhatWasThrownAbout) {
  // Nodes thrown far across their neighbors: quads inverted, folded over and lying on one another.
  for (const double far : {1.3, 2.2}) {
    SurfaceMesh mesh = grid(14);
    std::mt19937 random(11);
    for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i)
      if (!mesh.fixed[i] && random() % 4 == 0)
        mesh.mesh.points[i] += Vector3(random() % 1000 - 499.5, random() % 1000 - 499.5, 0) * 0.002 * far;
    ASSERT_GT(quality_of(mesh).inverted, 20);
    relax(mesh, PlanarSurface());
    EXPECT_EQ(quality_of(mesh).inverted, 0);
    EXPECT_GT(quality_of(mesh).q_min, 0);
  }
}

TEST(Smooth, TurnsBackAQuadFoldedAgainstTheSurface) {
  // Convex by itself, but upside down: only the surface normal tells.
  SurfaceMesh mesh = grid(4);
  mesh.mesh.points[6] = {2.6, 2.4, 0};
  mesh.mesh.points[12] = {1.1, 1.2, 0};
  relax(mesh, PlanarSurface());
  for (const auto& q : mesh.mesh.quads) {
    const auto& x = mesh.mesh.points;
    EXPECT_GT((x[q[2]] - x[q[0]]).cross(x[q[3]] - x[q[1]]).z(), 0);
  }
}

TEST(Smooth, AsksTheSurfaceRarely) {
  SurfaceMesh still = grid(10);
  const CountingPlane plane;
  relax(still, plane);
  EXPECT_EQ(plane.calls, 0);
  SurfaceMesh mesh = sample::rectangle(16, 2, 1);
  const auto count = static_cast<int>(mesh.mesh.points.size());
  relax(mesh, plane, 6);
  EXPECT_GT(plane.calls, 0);
  EXPECT_LT(plane.calls, 12 * count);
}

TEST(Smooth, LeavesNodesOfTrianglesAlone) {
  SurfaceMesh mesh = grid(4);
  mesh.mesh.quads.pop_back();
  mesh.mesh.triangles = {{18, 19, 24}};
  mesh.mesh.points[18] += Vector3(0.3, 0.2, 0);
  const Vector3 before = mesh.mesh.points[18];
  relax(mesh, PlanarSurface());
  EXPECT_EQ(mesh.mesh.points[18], before);
}

TEST(Smooth, GivesTheSameResultTwice) {
  for (const auto& [name, before, surface] : sample::samples(10)) {
    SurfaceMesh first = before, second = before;
    relax(first, *surface);
    relax(second, *surface);
    EXPECT_EQ(first.mesh.points, second.mesh.points) << name;
  }
}

TEST(Smooth, LooksWhetherToGoOnAllTheWhile) {
  EXPECT_EQ(sample::rare_looks([](SurfaceMesh& mesh, ExecutionContext& context) {
              smooth(mesh, PlanarSurface(), {}, context);
            }),
            "");
}

TEST(Smooth, StopsWhenCancelled) {
  SurfaceMesh mesh = sample::rectangle(8, 1, 1);
  ExecutionContext context(1);
  context.cancel();
  EXPECT_THROW(smooth(mesh, PlanarSurface(), {}, context), Error);
}

TEST(Smooth, AcceptsAnEmptyMesh) {
  SurfaceMesh mesh;
  relax(mesh, PlanarSurface());
  EXPECT_TRUE(mesh.mesh.quads.empty());
}

}  // namespace
}  // namespace quadrille
