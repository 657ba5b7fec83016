/// Dislocations that cancel out go away.

#include "mesher/quads/improve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesher/mesh/quad_geometry.hpp"
#include "tests/support/polygons.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// A rectangle 8 wide, in bands of 6 one above the other: rows[i] segments lie below band i. Where a band has
/// more above than below, or fewer, that takes two irregular nodes.
SurfaceMesh bands(const std::vector<int>& rows) {
  SurfaceMesh mesh;
  std::map<std::pair<long, long>, int> numbers;
  const double top = 6 * (static_cast<double>(rows.size()) - 1);
  const auto number = [&](const Vector3& at) {
    const auto [found, is_new] =
        numbers.emplace(std::pair(std::lround(1e6 * at.x()), std::lround(1e6 * at.y())), numbers.size());
    if (is_new) {
      mesh.mesh.points.push_back(at);
      mesh.parameters.push_back({at.x(), at.y()});
      mesh.normals.push_back({0, 0, 1});
      mesh.fixed.push_back(at.x() == 0 || at.x() == 8 || at.y() == 0 || at.y() == top);
    }
    return found->second;
  };
  for (std::size_t band = 0; band + 1 < rows.size(); ++band) {
    Polygon shape;
    const double y = 6 * static_cast<double>(band);
    const std::array corners{Vector3(0, y, 0), Vector3(8, y, 0), Vector3(8, y + 6, 0), Vector3(0, y + 6, 0)};
    const std::array segments{rows[band], 6, rows[band + 1], 6};
    for (int i = 0; i < 4; ++i) {
      shape.corners.push_back(static_cast<int>(shape.outline.size()));
      for (int k = 0; k < segments[i]; ++k)
        shape.outline.push_back(corners[i] + (corners[(i + 1) % 4] - corners[i]) * k / segments[i]);
    }
    const auto fillings = polygon_fillings(shape.outline, shape.corners, 2);
    for (const Quad& quad : fillings.at(0).quads) {
      Quad& added = mesh.mesh.quads.emplace_back();
      for (int k = 0; k < 4; ++k) added[k] = number(fillings[0].places[quad[k]]);
    }
  }
  return mesh;
}

/// The lower half widens from 8 rows to 10, and the upper half narrows again.
SurfaceMesh two_dislocations() {
  return bands({8, 10, 8});
}

int irregular_inside(const SurfaceMesh& mesh) {
  int count = 0;
  for (const auto& [node, quads] : valences(mesh.mesh.quads)) count += !mesh.fixed[node] && quads != 4;
  return count;
}

TEST(Cavities, TakeAwayDislocationsThatCancelOut) {
  SurfaceMesh mesh = two_dislocations();
  ASSERT_EQ(irregular_inside(mesh), 4);
  std::vector<Vector3> rim;
  for (std::size_t i = 0; i < mesh.fixed.size(); ++i)
    if (mesh.fixed[i]) rim.push_back(mesh.mesh.points[i]);
  EXPECT_GT(remesh_cavities(mesh, PlanarSurface(), {}), 0);
  EXPECT_EQ(irregular_inside(mesh), 0);
  ASSERT_GE(mesh.mesh.points.size(), rim.size());
  for (std::size_t i = 0; i < rim.size(); ++i) EXPECT_EQ(mesh.mesh.points[i], rim[i]);
  double area = 0;
  const auto& p = mesh.mesh.points;
  for (const auto& [a, b, c, d] : mesh.mesh.quads) {
    EXPECT_GT(folded_scaled_jacobian(p[a], p[b], p[c], p[d], {0, 0, 1}), 0.2);
    area += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).z();
  }
  EXPECT_NEAR(area, 96, 1e-9);
}

/// A row of bands that is chosen so that patches which take in the nearest irregular nodes leave eight.
TEST(Cavities, ChooseWhereTheyGrowTo) {
  SurfaceMesh mesh = bands({8, 10, 12, 10, 12, 10, 8, 10});
  ASSERT_EQ(irregular_inside(mesh), 14);
  remesh_cavities(mesh, PlanarSurface(), {});
  EXPECT_LE(irregular_inside(mesh), 6);
}

TEST(Cavities, LeaveAGridAlone) {
  SurfaceMesh mesh = two_dislocations();
  remesh_cavities(mesh, PlanarSurface(), {});
  const auto before = mesh.mesh.quads;
  EXPECT_EQ(remesh_cavities(mesh, PlanarSurface(), {}), 0);
  EXPECT_EQ(mesh.mesh.quads, before);
}

TEST(Cavities, KeepFixedNodes) {
  SurfaceMesh mesh = two_dislocations();
  std::vector<Vector3> kept;
  for (const auto& [node, quads] : valences(mesh.mesh.quads))
    if (quads == 3 && !mesh.fixed[node]) mesh.fixed[node] = 1;
  for (std::size_t i = 0; i < mesh.fixed.size(); ++i)
    if (mesh.fixed[i]) kept.push_back(mesh.mesh.points[i]);
  remesh_cavities(mesh, PlanarSurface(), {});
  for (const Vector3& point : kept)
    EXPECT_EQ(std::count(mesh.mesh.points.begin(), mesh.mesh.points.end(), point), 1);
  std::set<int> used;
  for (const auto& quad : mesh.mesh.quads) used.insert(quad.begin(), quad.end());
  EXPECT_EQ(used.size(), mesh.mesh.points.size());
}

}  // namespace
}  // namespace quadrille
