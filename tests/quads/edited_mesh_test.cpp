/// Outlines of patches, what their fillings cost, and the mesh that is written back.

#include "mesher/quads/edited_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/quad_grid.hpp"

namespace quadrille {
namespace {

using testing::euler;
using testing::grid;
using testing::open_sides;

/// Quads of a grid of four columns, by column and row.
SmallPatch patch_of(const std::vector<std::array<int, 2>>& places) {
  SmallPatch patch;
  for (const auto& [i, j] : places) EXPECT_TRUE(patch.add(4 * j + i));
  return patch;
}

const std::vector<std::array<int, 2>> block{{1, 1}, {2, 1}, {1, 2}, {2, 2}};

TEST(EditedMesh, TracesThePolygonAroundAPatch) {
  SurfaceMesh mesh = grid(4, 4);
  EditedMesh edited(mesh, {});
  Outline outline;
  ASSERT_TRUE(edited.trace(patch_of(block), outline));
  ASSERT_EQ(outline.length(), 8);
  ASSERT_EQ(outline.inside_count(), 1);
  EXPECT_EQ(outline.inside[0], 12);  // the middle of 5 by 5 nodes
  double area = 0;
  for (int i = 0; i < 8; ++i) {
    const Vector3 &a = edited.point(outline.ring[i]), &b = edited.point(outline.ring[(i + 1) % 8]);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    const bool is_corner = a.x() != 2 && a.y() != 2;
    EXPECT_EQ(outline.uses[i], is_corner ? 1 : 2);
    EXPECT_EQ(edited.topology().origin(outline.sides[i]), outline.ring[i]);
    EXPECT_EQ(edited.topology().end(outline.sides[i]), outline.ring[(i + 1) % 8]);
  }
  EXPECT_EQ(area, 4) << "counter-clockwise";
}

TEST(EditedMesh, RefusesPatchesThatAreNoDiscOrWhoseNodesMustStay) {
  SurfaceMesh mesh = grid(4, 4);
  mesh.fixed[6] = 1;
  EditedMesh edited(mesh, {});
  const auto traces = [&](const std::vector<std::array<int, 2>>& places) {
    Outline outline;
    return edited.trace(patch_of(places), outline);
  };
  EXPECT_TRUE(traces({{1, 1}, {2, 1}}));
  EXPECT_FALSE(traces({{1, 1}, {2, 2}})) << "they meet at a node";
  EXPECT_FALSE(traces({{0, 0}, {2, 2}})) << "two pieces";
  EXPECT_FALSE(traces({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}})) << "twelve sides";
  EXPECT_FALSE(traces({{0, 0}, {1, 0}, {0, 1}, {1, 1}})) << "a fixed node inside";
}

/// In a grid each node has as many quads as its angle asks for, and a filling with other numbers costs more.
TEST(EditedMesh, ARegularPatchCostsNothing) {
  SurfaceMesh mesh = grid(4, 4);
  EditedMesh edited(mesh, {});
  for (const auto& places : {block, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}}) {
    Outline outline;
    ASSERT_TRUE(edited.trace(patch_of(places), outline));
    FillingCosts costs{};
    EXPECT_NEAR(edited.find_costs(outline, costs), 0, 1e-12);
    for (int i = 0; i < outline.length(); ++i)
      for (int uses = 1; uses <= PatchTemplate::max_uses; ++uses)
        EXPECT_EQ(costs.uses[i][uses] < 1e-12, uses == outline.uses[i]) << i << ' ' << uses;
  }
}

TEST(EditedMesh, LaysAFillingWithoutFolds) {
  SurfaceMesh mesh = grid(4, 4);
  EditedMesh edited(mesh, {});
  Outline outline;
  ASSERT_TRUE(edited.trace(patch_of(block), outline));
  int square = 0;
  for (const PatchTemplate& filling : patch_templates(8)) {
    const Filling laid = edited.laid(outline, filling);
    EXPECT_LE(laid.worst(), 1);
    square += laid.worst() > 0.999;
  }
  EXPECT_EQ(square, 1) << "one filling alone is the grid that was there";
}

TEST(EditedMesh, WritesBackWhatIsUsedFixedPointsFirst) {
  SurfaceMesh mesh = grid(4, 4);
  const SurfaceMesh before = mesh;
  EditedMesh edited(mesh, {});
  const std::vector<int> old_quads{5, 6, 9, 10};
  // A middle node of its own in place of the one that was there.
  const int node = edited.add_node_like(12);
  std::vector<EditedMesh::Quad> quads;
  for (const int quad : old_quads) {
    quads.push_back(edited.topology().quad(quad));
    std::replace(quads.back().begin(), quads.back().end(), 12, node);
  }
  EXPECT_NEAR(edited.worst(quads), 1, 1e-12);
  EXPECT_FALSE(edited.too_long(quads, quads));
  ASSERT_TRUE(edited.topology().replace(old_quads, quads));
  const std::vector<int> kept = edited.write_back();
  ASSERT_EQ(mesh.mesh.points.size(), 25U);
  EXPECT_EQ(kept.back(), node);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), 12), 0);
  EXPECT_TRUE(std::is_sorted(mesh.fixed.begin(), mesh.fixed.end(), std::greater()));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] == node) continue;
    EXPECT_EQ(mesh.mesh.points[i], before.mesh.points[kept[i]]);
    EXPECT_EQ(mesh.fixed[i], before.fixed[kept[i]]);
  }
  EXPECT_EQ(mesh.mesh.quads.size(), 16U);
  EXPECT_EQ(open_sides(mesh.mesh).size(), 16U);
  EXPECT_EQ(euler(mesh.mesh), 1);
}

}  // namespace
}  // namespace quadrille
