/// Every small polygon is filled as told, and dislocations that cancel out go away.

#include "mesher/quads/cavities.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/quads/polygon_filling.hpp"

namespace quadrille {
namespace {

using Quad = std::array<int, 4>;

struct Polygon {
  std::vector<Vector3> outline;
  std::vector<int> corners;
};

/// Corners on a circle, straight sides; two enclose a lens.
Polygon polygon(const std::vector<int>& sides) {
  Polygon result;
  const auto n = static_cast<double>(sides.size());
  const double bulge = sides.size() == 2 ? 1.2 : 0;
  const auto corner = [&](double i) {
    const double angle = 2 * std::numbers::pi * i / n;
    return Vector3(std::cos(angle), std::sin(angle), 0);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    result.corners.push_back(static_cast<int>(result.outline.size()));
    const Vector3 from = corner(static_cast<double>(i)), to = corner(static_cast<double>(i) + 1),
                  out = corner(static_cast<double>(i) + 0.5);
    for (int k = 0; k < sides[i]; ++k) {
      const double t = static_cast<double>(k) / sides[i];
      result.outline.push_back((1 - t) * from + t * to + bulge * t * (1 - t) * out);
    }
  }
  return result;
}

std::vector<PolygonFilling> polygon_fillings(const std::vector<Vector3>& outline,
                                             const std::vector<int>& corners, int most) {
  std::vector<PolygonFilling> result;
  EXPECT_FALSE(fill_polygon(outline, corners, {.most_irregular = most}, [&](const PolygonFilling& filling) {
    result.push_back(filling);
    return false;
  }));
  return result;
}

std::map<int, int> valences(const std::vector<Quad>& quads) {
  std::map<int, int> count;
  for (const Quad& quad : quads)
    for (const int node : quad) ++count[node];
  return count;
}

/// Quads on both sides of each side but those of the outline, which they have to their left; one quad at a
/// corner, two at the other nodes of the outline; a disc.
void expect_fills(const Polygon& shape, const PolygonFilling& filling) {
  std::set<std::pair<int, int>> sides;
  for (const Quad& quad : filling.quads)
    for (int k = 0; k < 4; ++k)
      ASSERT_TRUE(sides.insert({quad[k], quad[(k + 1) % 4]}).second) << "a side has two quads to its left";
  const int outline = static_cast<int>(shape.outline.size());
  int open = 0;
  for (const auto& [a, b] : sides) {
    if (sides.contains({b, a})) continue;
    ++open;
    ASSERT_LT(a, outline);
    ASSERT_EQ(b, (a + 1) % outline);
  }
  ASSERT_EQ(open, outline);
  std::map<int, int> uses = valences(filling.quads);
  for (int i = 0; i < outline; ++i) {
    const bool corner = std::find(shape.corners.begin(), shape.corners.end(), i) != shape.corners.end();
    ASSERT_EQ(uses[i], corner ? 1 : 2);
    ASSERT_EQ(filling.places[i], shape.outline[i]);
  }
  int irregular = 0;
  for (int i = outline; i < static_cast<int>(filling.places.size()); ++i) {
    ASSERT_TRUE(uses[i] >= 3 && uses[i] <= 5);
    irregular += uses[i] != 4;
  }
  ASSERT_EQ(irregular, filling.irregular);
  ASSERT_EQ(filling.quads.size(), outline / 2 - 1 + filling.places.size() - outline);
}

/// Calls with every polygon of so many sides of one to `most` segments.
template <class Visit>
void for_each_polygon(int corners, int most, Visit visit) {
  std::vector<int> sides(corners, 1);
  while (true) {
    visit(sides);
    int i = 0;
    while (i < corners && sides[i] == most) sides[i++] = 1;
    if (i == corners) return;
    ++sides[i];
  }
}

TEST(PolygonFilling, FillsWhatItSaysItFills) {
  int filled = 0;
  for (int corners = 2; corners <= 6; ++corners)
    for_each_polygon(
        corners,
        corners == 6   ? 4
        : corners == 5 ? 5
                       : 6,
        [&](const std::vector<int>& sides) {
          const Polygon shape = polygon(sides);
          for (const PolygonFilling& filling : polygon_fillings(shape.outline, shape.corners, 2)) {
            SCOPED_TRACE(testing::PrintToString(sides));
            ASSERT_NO_FATAL_FAILURE(expect_fills(shape, filling));
            EXPECT_EQ(filling.irregular % 2, corners % 2);
            ++filled;
          }
        });
  EXPECT_GT(filled, 1000);
}

TEST(PolygonFilling, FindsAFillingWhereverThereIsRoom) {
  // Facing sides may differ by two, odd polygons need that each side is shorter than those beside it
  // together.
  for_each_polygon(4, 3, [&](const std::vector<int>& more) {
    std::vector<int> sides = more;
    for (int& side : sides) side += 5;
    if ((sides[0] + sides[1] + sides[2] + sides[3]) % 2 != 0) return;
    const Polygon shape = polygon(sides);
    const auto fillings = polygon_fillings(shape.outline, shape.corners, 2);
    ASSERT_FALSE(fillings.empty()) << testing::PrintToString(sides);
    const bool grid = sides[0] == sides[2] && sides[1] == sides[3];
    for (const PolygonFilling& filling : fillings) EXPECT_EQ(filling.irregular, grid ? 0 : 2);
  });
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{
           {2, 2, 2}, {3, 4, 5}, {2, 2, 2, 2, 2}, {3, 3, 2, 3, 3}, {4, 4}, {5, 7}, {3, 3, 3, 3, 3, 3}}) {
    const Polygon shape = polygon(sides);
    EXPECT_FALSE(polygon_fillings(shape.outline, shape.corners, 2).empty()) << testing::PrintToString(sides);
  }
}

TEST(PolygonFilling, FoldsNothingInRoundPolygons) {
  for (int corners = 3; corners <= 5; ++corners) {
    const Polygon shape = polygon(std::vector<int>(corners, 6));
    const auto fillings = polygon_fillings(shape.outline, shape.corners, 1);
    ASSERT_EQ(fillings.size(), 1);
    const auto& p = fillings[0].places;
    for (const auto& [a, b, c, d] : fillings[0].quads)
      EXPECT_GT(folded_scaled_jacobian(p[a], p[b], p[c], p[d], {0, 0, 1}), 0.4);
  }
}

TEST(PolygonFilling, KeepsToTheQuadsAllowed) {
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{{4, 4, 4, 4}, {7, 6, 5, 6}, {4, 4, 4}}) {
    const Polygon shape = polygon(sides);
    std::set<std::size_t> counts;
    for (const auto& filling : polygon_fillings(shape.outline, shape.corners, 2))
      counts.insert(filling.quads.size());
    ASSERT_FALSE(counts.empty());
    const int least = static_cast<int>(*counts.begin());
    const auto found = [&](const FillingLimits& limits) {
      return fill_polygon(shape.outline, shape.corners, limits, [&](const PolygonFilling& filling) {
        EXPECT_GE(filling.quads.size(), limits.least_quads);
        EXPECT_LE(filling.quads.size(), limits.most_quads);
        return true;
      });
    };
    EXPECT_TRUE(found({2, least, least}));
    EXPECT_FALSE(found({2, 1, 1}));
    EXPECT_FALSE(found({2, 1000, 2000}));
  }
}

TEST(PolygonFilling, KeepsToTheIrregularNodesAllowed) {
  const Polygon uneven = polygon({6, 4, 4, 4}), triangle = polygon({4, 4, 4});
  EXPECT_FALSE(polygon_fillings(uneven.outline, uneven.corners, 2).empty());
  EXPECT_TRUE(polygon_fillings(uneven.outline, uneven.corners, 1).empty());
  EXPECT_TRUE(polygon_fillings(triangle.outline, triangle.corners, 0).empty());
  EXPECT_TRUE(polygon_fillings(polygon({4}).outline, {0}, 2).empty());
}

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
