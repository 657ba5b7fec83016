/// Templates against all ways to cut polygons into quads.

#include "mesher/quads/patch_templates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesher/shell/validate.hpp"
#include "tests/support/quad_grid.hpp"

namespace quadrille {
namespace {

using namespace testing;

TEST(PatchTemplates, CountsThoseWithoutNodesInside) {
  // Ways to cut a 2 n-gon into quads: C(3 m, m) / (2 m + 1), m = n - 1.
  for (const auto& [sides, ways] : {std::pair{4, 1}, {6, 3}, {8, 12}, {10, 55}}) {
    const auto& all = patch_templates(sides);
    EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const PatchTemplate& t) { return t.interior == 0; }),
              ways);
  }
  EXPECT_TRUE(patch_templates(5).empty());
  EXPECT_TRUE(patch_templates(12).empty());
}

TEST(PatchTemplates, FillThePolygonOnceEach) {
  for (int sides = 4; sides <= 10; sides += 2) {
    std::set<std::set<std::array<int, 4>>> seen;
    for (const PatchTemplate& filling : patch_templates(sides)) {
      QuadMesh mesh;
      mesh.points.resize(sides + filling.interior);
      for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points[i] = {double(i), double(i * i), 0};
      std::set<std::array<int, 4>> quads;
      for (int k = 0; k < filling.quads; ++k) {
        std::array<int, 4> quad;
        std::copy(filling.corners[k].begin(), filling.corners[k].end(), quad.begin());
        mesh.quads.push_back(quad);
        quads.insert(quad);
      }
      ASSERT_EQ(validate(mesh), std::vector<std::string>{});
      EXPECT_EQ(euler(mesh), 1);
      EXPECT_LE(*std::max_element(filling.uses.begin(), filling.uses.end()), PatchTemplate::max_uses);
      SideSet rim;
      for (int i = 0; i < sides; ++i) rim.insert({i, (i + 1) % sides});
      EXPECT_EQ(open_sides(mesh), rim);
      EXPECT_TRUE(seen.insert(quads).second);
    }
    EXPECT_FALSE(seen.empty());
  }
}

/// All fillings within the limit, the cheapest first, of equals the one listed first.
std::vector<const PatchTemplate*> fillings_by_cost(int sides, const FillingCosts& costs) {
  std::vector<std::pair<double, const PatchTemplate*>> priced;
  for (const PatchTemplate& filling : patch_templates(sides)) {
    double sum = filling.interior_cost + costs.resize[filling.interior] + costs.drift[filling.interior];
    for (int i = 0; i < sides; ++i) sum += costs.uses[i][filling.uses[i]];
    if (sum <= costs.limit) priced.emplace_back(sum, &filling);
  }
  std::stable_sort(priced.begin(), priced.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const PatchTemplate*> result;
  result.reserve(priced.size());
  for (const auto& [cost, filling] : priced) result.push_back(filling);
  return result;
}

TEST(PatchTemplates, CheapestAreThoseOfAllTried) {
  std::mt19937 random(5);
  // Whole numbers, so that many fillings cost the same.
  const auto below = [&](unsigned n) { return static_cast<double>(random() % n); };
  for (int round = 0; round < 4000; ++round) {
    const int sides = 4 + 2 * (round % 4);
    FillingCosts costs;
    for (auto& node : costs.uses)
      for (double& cost : node) cost = below(4);
    for (double& cost : costs.resize) cost = 0.25 * below(4);
    for (double& cost : costs.drift) cost = 0.125 * below(4) - 0.25;
    costs.limit = below(20);
    const std::vector<const PatchTemplate*> all = fillings_by_cost(sides, costs);
    const CheapestFillings cheapest = cheapest_fillings(sides, costs);
    ASSERT_EQ(cheapest.size(), std::min(all.size(), std::size_t{CheapestFillings::static_capacity}));
    for (std::size_t i = 0; i < cheapest.size(); ++i) ASSERT_EQ(cheapest[i], all[i]) << "round " << round;
  }
  EXPECT_TRUE(cheapest_fillings(5, {}).empty());
}

}  // namespace
}  // namespace quadrille
