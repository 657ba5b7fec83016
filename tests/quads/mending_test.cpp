/// Grids with sides turned and nodes moved get better, never worse, and keep their boundary and area.

#include "mesher/quads/mending.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "geometry/base/error.hpp"
#include "mesher/quads/criteria_patch.hpp"

namespace quadrille {
namespace {

using Quad = std::array<int, 4>;

/// A grid of n by n squares of side 1 with a fixed boundary, which comes first among the points.
SurfaceMesh grid(int n) {
  SurfaceMesh result;
  std::map<std::pair<int, int>, int> number;
  for (const bool boundary : {true, false})
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        if ((i == 0 || j == 0 || i == n || j == n) != boundary) continue;
        number[{i, j}] = static_cast<int>(result.mesh.points.size());
        result.mesh.points.emplace_back(i, j, 0);
        result.parameters.emplace_back(i, j);
        result.fixed.push_back(boundary ? 1 : 0);
      }
  result.normals.assign(result.mesh.points.size(), Vector3(0, 0, 1));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      result.mesh.quads.push_back(
          {number[{i, j}], number[{i + 1, j}], number[{i + 1, j + 1}], number[{i, j + 1}]});
  return result;
}

/// The common side of two quads goes one corner further round the hexagon that they make.
bool turn_side(std::vector<Quad>& quads, int one, int two) {
  Quad &p = quads[one], &q = quads[two];
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      if (p[k] != q[(j + 1) & 3] || p[(k + 1) & 3] != q[j]) continue;
      const int a = p[k], b = p[(k + 1) & 3], c = p[(k + 2) & 3], d = p[(k + 3) & 3], e = q[(j + 2) & 3],
                f = q[(j + 3) & 3];
      // The hexagon is b, c, d, a, e, f.
      p = {c, d, a, e};
      q = {e, f, b, c};
      return true;
    }
  return false;
}

QuadObjective objective(const SurfaceMesh& mesh, const Quad& q) {
  const auto& p = mesh.mesh.points;
  return measure_objective(p[q[0]], p[q[1]], p[q[2]], p[q[3]]);
}

int poor_quads(const SurfaceMesh& mesh) {
  return static_cast<int>(std::count_if(mesh.mesh.quads.begin(), mesh.mesh.quads.end(), [&](const Quad& q) {
    return objective(mesh, q).value > outside_objective;
  }));
}

double objective(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const Quad& q : mesh.mesh.quads) sum += std::min(20.0, objective(mesh, q).value);
  return sum;
}

double least_sine(const SurfaceMesh& mesh) {
  double least = 1;
  for (const Quad& q : mesh.mesh.quads) least = std::min(least, objective(mesh, q).least_sine);
  return least;
}

std::set<std::pair<int, int>> open_sides(const SurfaceMesh& mesh) {
  std::set<std::pair<int, int>> sides;
  for (const Quad& q : mesh.mesh.quads)
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(sides.insert({q[k], q[(k + 1) & 3]}).second);
  std::set<std::pair<int, int>> open;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) open.insert({a, b});
  return open;
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  const auto& p = mesh.mesh.points;
  for (const auto& [a, b, c, d] : mesh.mesh.quads) sum += (p[c] - p[a]).cross(p[d] - p[b]).z() / 2;
  return sum;
}

TEST(Mending, TurnsASideBack) {
  SurfaceMesh mesh = grid(6);
  const SurfaceMesh before = mesh;
  ASSERT_TRUE(turn_side(mesh.mesh.quads, 14, 15));
  ASSERT_GT(poor_quads(mesh), 0);
  std::vector<char> changed;
  EXPECT_GT(mend_quads(mesh, PlanarSurface(), outside_objective, -1, changed, {}), 0);
  EXPECT_EQ(poor_quads(mesh), 0);
  EXPECT_EQ(mesh.mesh.quads.size(), before.mesh.quads.size());
  ASSERT_EQ(changed.size(), mesh.mesh.points.size());
  EXPECT_GT(std::count(changed.begin(), changed.end(), 1), 0);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    if (changed[i]) continue;
    EXPECT_EQ(mesh.mesh.points[i], before.mesh.points[i]);
  }
}

TEST(Mending, LeavesGoodQuadsAlone) {
  SurfaceMesh mesh = grid(5);
  const SurfaceMesh before = mesh;
  std::vector<char> changed;
  EXPECT_EQ(mend_quads(mesh, PlanarSurface(), outside_objective, -1, changed, {}), 0);
  EXPECT_EQ(mesh.mesh.quads, before.mesh.quads);
  EXPECT_EQ(std::count(changed.begin(), changed.end(), 1), 0);
}

/// Any sides turned, nodes moved: fewer poor quads, no worse ones, the same boundary and area.
TEST(Mending, NeverMakesAMeshWorse) {
  int mended = 0, poor_before = 0, poor_after = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const int n = 4 + seed % 5;
    SurfaceMesh mesh = grid(n);
    std::uniform_real_distribution<double> shift(-0.15, 0.15);
    for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i) {
      if (mesh.fixed[i]) continue;
      mesh.mesh.points[i] += Vector3(shift(random), shift(random), 0);
      mesh.parameters[i] = mesh.mesh.points[i].head<2>();
    }
    for (int attempt = 0; attempt < 200; ++attempt) {
      const auto count = mesh.mesh.quads.size();
      const auto saved = mesh.mesh.quads;
      turn_side(mesh.mesh.quads, static_cast<int>(random() % count), static_cast<int>(random() % count));
      if (least_sine(mesh) <= 0) mesh.mesh.quads = saved;
    }
    const SurfaceMesh before = mesh;
    std::vector<char> changed;
    mended += mend_quads(mesh, PlanarSurface(), outside_objective, -1, changed, {});
    EXPECT_LE(poor_quads(mesh), poor_quads(before));
    EXPECT_LE(objective(mesh), objective(before));
    EXPECT_GE(least_sine(mesh), std::min(0.3, least_sine(before)) - 1e-9);
    EXPECT_GT(least_sine(mesh), 0);
    EXPECT_NEAR(area(mesh), n * n, 1e-9);
    EXPECT_EQ(open_sides(mesh), open_sides(before));
    for (std::size_t i = 0; i < mesh.fixed.size(); ++i) {
      if (!mesh.fixed[i]) break;
      EXPECT_EQ(mesh.mesh.points[i], before.mesh.points[i]);
    }
    poor_before += poor_quads(before);
    poor_after += poor_quads(mesh);
  }
  EXPECT_GT(mended, 30);
  EXPECT_LT(poor_after, 0.2 * poor_before);
}

TEST(Mending, UnfoldsWhatIsTurnedOver) {
  SurfaceMesh mesh = grid(6);
  ASSERT_TRUE(turn_side(mesh.mesh.quads, 14, 15));
  int node = -1;
  for (const int corner : mesh.mesh.quads[14])
    if (!mesh.fixed[corner]) node = corner;
  mesh.mesh.points[node] += Vector3(1.2, 0.9, 0);
  mesh.parameters[node] = mesh.mesh.points[node].head<2>();
  ASSERT_LE(least_sine(mesh), 0);
  std::vector<char> changed;
  EXPECT_GT(mend_quads(mesh, PlanarSurface(), folded_objective, -1, changed, {}), 0);
  EXPECT_GT(least_sine(mesh), 0);
  EXPECT_NEAR(area(mesh), 36, 1e-9);
}

TEST(Mending, StopsWhenCancelled) {
  SurfaceMesh mesh = grid(6);
  ASSERT_TRUE(turn_side(mesh.mesh.quads, 14, 15));
  ExecutionContext context(1);
  context.cancel();
  std::vector<char> changed;
  EXPECT_THROW(mend_quads(mesh, PlanarSurface(), outside_objective, -1, changed, context), Error);
}

}  // namespace
}  // namespace quadrille
