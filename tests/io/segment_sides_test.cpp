/// Sides of elements on segments, and what bounds faces and edges, on two faces that share an edge.

#include "mesher/io/segment_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

constexpr int n = 3;

TEST(SegmentSides, RunAlongTheirSegments) {
  for (const int order : {1, 2}) {
    const ShellMesh mesh = test::ShellGrid(n, order).mesh();
    const OutputMesh output(mesh);
    const std::vector<SegmentSide> sides = segment_sides(output);
    std::map<int, int> by_segment;
    for (const SegmentSide& side : sides) {
      ++by_segment[side.segment];
      std::array<int, 2> ends{mesh.quads[side.shell][side.side], mesh.quads[side.shell][(side.side + 1) % 4]};
      if (!side.forward) std::swap(ends[0], ends[1]);
      EXPECT_EQ(ends, mesh.segments[side.segment].nodes);
    }
    for (std::size_t i = 0; i < mesh.segments.size(); ++i)
      EXPECT_EQ(by_segment[static_cast<int>(i)], mesh.segments[i].edge == 2 ? 2 : 1)
          << "Edge2 lies between the faces";
    EXPECT_TRUE(std::is_sorted(sides.begin(), sides.end(), [](const auto& a, const auto& b) {
      return std::pair(a.segment, a.shell) < std::pair(b.segment, b.shell);
    }));
  }
}

TEST(SegmentSides, BoundFacesByEdgesAndEdgesByVertices) {
  const ShellMesh mesh = test::ShellGrid(n, 1).mesh();
  const EntityBoundaries boundaries = entity_boundaries(OutputMesh(mesh));
  // Counter-clockwise: up at the right, back at the top.
  EXPECT_EQ(boundaries.faces, (std::vector<std::vector<int>>{{-1, 2, 4, -5}, {-2, 3, 6, -7}}));
  EXPECT_EQ(boundaries.edges,
            (std::vector<std::vector<int>>{{1, -4}, {2, -5}, {3, -6}, {1, -2}, {4, -5}, {2, -3}, {5, -6}}));
}

TEST(SegmentSides, AreNoneWithoutSegmentsAndNumbers) {
  ShellMesh mesh = test::ShellGrid(n, 1).mesh();
  for (auto& segment : mesh.segments) segment.edge = 0;
  for (const std::vector<int>& edges : entity_boundaries(OutputMesh(mesh)).faces) EXPECT_TRUE(edges.empty());
  mesh.segments.clear();
  EXPECT_TRUE(segment_sides(OutputMesh(mesh)).empty());
}

}  // namespace
}  // namespace quadrille
