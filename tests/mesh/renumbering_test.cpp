/// Large meshes in another order are the same meshes.

#include "mesher/mesh/renumbering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Points and triangles in random order.
TriangleMesh shuffled(const TriangleMesh& mesh, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> to(mesh.points.size());
  for (std::size_t v = 0; v < to.size(); ++v) to[v] = static_cast<int>(v);
  std::shuffle(to.begin(), to.end(), generator);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < to.size(); ++v) result.points[to[v]] = mesh.points[v];
  std::shuffle(result.triangles.begin(), result.triangles.end(), generator);
  for (auto& triangle : result.triangles) {
    for (int& v : triangle) v = to[v];
  }
  return result;
}

TEST(Renumbering, KeepsEveryTriangleAndBringsNeighborsTogether) {
  TriangleMesh mesh = shuffled(grid(500, 400, 1), 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.tags.push_back(static_cast<int>(t));
  mesh.points.emplace_back(-1, -1, 0);  // no triangle uses it
  const RenumberedMesh ordered = order_by_place(mesh);
  ASSERT_EQ(ordered.mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(ordered.mesh.points.size() + 1, mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<int, 3> back = ordered.mesh.triangles[t];
    for (int& v : back) {
      ASSERT_EQ(ordered.mesh.points[v], mesh.points[ordered.old_point[v]]);
      v = ordered.old_point[v];
    }
    ASSERT_EQ(back, mesh.triangles[ordered.mesh.tags[t]]);
  }
  double apart = 0;  // numbers of a triangle's points
  for (const auto& [a, b, c] : ordered.mesh.triangles) apart += std::max({a, b, c}) - std::min({a, b, c});
  EXPECT_LT(apart / static_cast<double>(mesh.triangles.size()),
            0.02 * static_cast<double>(mesh.points.size()));
}

TEST(Renumbering, QuadsStayWhereTheyAreAndComeByPlace) {
  constexpr int across = 60, fixed = 3;
  std::vector<Vector3> points;
  points.reserve((across + 1) * (across + 1));
  for (int v = 0; v < (across + 1) * (across + 1); ++v)
    points.emplace_back(v % (across + 1), v / (across + 1), 0);
  std::mt19937 generator(6);
  std::vector<int> to(points.size());
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), generator);
  std::vector<Vector3> scattered(points.size());
  for (std::size_t v = 0; v < to.size(); ++v) scattered[to[v]] = points[v];
  std::vector<std::array<int, 4>> quads;
  for (int v = 0; v < (across + 1) * across; ++v)
    if (v % (across + 1) < across)
      quads.push_back({to[v], to[v + 1], to[v + across + 2], to[v + across + 1]});
  std::shuffle(quads.begin(), quads.end(), generator);
  std::vector<std::array<int, 4>> before = quads;
  const std::vector<int> old_point = order_by_place(scattered, fixed, quads);
  ASSERT_EQ(old_point.size(), scattered.size());
  double apart = 0;  // numbers of a quad's nodes
  for (auto& quad : quads) {
    const auto [low, high] = std::minmax_element(quad.begin(), quad.end());
    apart += *high - *low;
    for (int& v : quad) v = old_point[v];
  }
  EXPECT_LT(apart / static_cast<double>(quads.size()), 0.1 * static_cast<double>(points.size()));
  for (int v = 0; v < fixed; ++v) EXPECT_EQ(old_point[v], v);
  std::sort(before.begin(), before.end());
  std::sort(quads.begin(), quads.end());
  EXPECT_EQ(quads, before);
}

}  // namespace
}  // namespace quadrille
