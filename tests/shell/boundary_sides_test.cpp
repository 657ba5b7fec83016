/// Two quads with right and wrong boundaries: missing and doubled sides, seams, cracks, spurs.

#include "mesher/shell/boundary_sides.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

using Quads = std::vector<std::array<int, 4>>;
using Side = std::optional<std::pair<int, int>>;

/// A boundary of segments between nodes that are their own points, without midsides.
FaceBoundary boundary_of(int points, const std::vector<std::pair<int, int>>& segments) {
  FaceBoundary boundary;
  for (int i = 0; i < points; ++i) boundary.nodes.push_back(i);
  for (const auto& [a, b] : segments) {
    FaceBoundary::Segment segment;
    segment.a = a;
    segment.b = b;
    boundary.segments.push_back(segment);
  }
  return boundary;
}

/// Six nodes round two quads, 0 1 2 below and 3 4 5 above.
const std::vector<std::pair<int, int>> outline{{0, 1}, {1, 2}, {2, 5}, {5, 4}, {4, 3}, {3, 0}};
const Quads two_quads{{0, 1, 4, 3}, {1, 2, 5, 4}};

Side check(const std::vector<std::pair<int, int>>& segments, const Quads& quads) {
  const FaceBoundary boundary = boundary_of(8, segments);
  return wrong_boundary_side(boundary, boundary.nodes, quads);
}

TEST(BoundarySides, AreRightWhereTheQuadsEndOnTheBoundary) {
  EXPECT_EQ(check(outline, two_quads), Side());
}

TEST(BoundarySides, AreHalvesWhereSegmentsHaveMiddles) {
  FaceBoundary boundary = boundary_of(6, {{0, 2}, {2, 5}, {5, 3}, {3, 0}});
  boundary.segments[0].middle_node = 1;
  boundary.segments[2].middle_node = 4;
  EXPECT_EQ(wrong_boundary_side(boundary, boundary.nodes, two_quads), Side());
  boundary.segments[2].middle_node = -1;
  EXPECT_NE(wrong_boundary_side(boundary, boundary.nodes, two_quads), Side());
}

TEST(BoundarySides, TellAQuadThatIsMissing) {
  EXPECT_EQ(check(outline, {two_quads[0]}), Side({1, 2}));
}

TEST(BoundarySides, TellTwoSheetsOverOneEdge) {
  EXPECT_EQ(check(outline, {two_quads[0], two_quads[1], {0, 1, 7, 6}}), Side({0, 1}));
}

TEST(BoundarySides, TellASideRunTwiceInOneDirection) {
  std::vector<std::pair<int, int>> turned = outline;
  turned.push_back({0, 1});
  EXPECT_EQ(check(turned, {two_quads[0], two_quads[1], {0, 1, 7, 6}}), Side({0, 1}));
}

TEST(BoundarySides, MayHaveTwoQuadsOnASeamAndOnACrack) {
  std::vector<std::pair<int, int>> seam = outline;
  seam.push_back({1, 4});
  seam.push_back({4, 1});
  EXPECT_EQ(check(seam, two_quads), Side());
  FaceBoundary crack = boundary_of(6, outline);
  crack.segments.push_back({});
  crack.segments.back().a = 1;
  crack.segments.back().b = 4;
  EXPECT_EQ(wrong_boundary_side(crack, crack.nodes, two_quads), Side({1, 4}));
  crack.segments.back().internal = true;
  EXPECT_EQ(wrong_boundary_side(crack, crack.nodes, two_quads), Side());
}

TEST(BoundarySides, MayLeaveASpurOutsideTheFace) {
  std::vector<std::pair<int, int>> spur = outline;
  spur.push_back({2, 7});
  EXPECT_EQ(check(spur, two_quads), Side({2, 7}));
  spur.push_back({7, 2});
  EXPECT_EQ(check(spur, two_quads), Side());
}

/// A tube with three segments around, cut at the seam 0 1: the points 0 and 2 are one node, and so are 1
/// and 3.
TEST(BoundarySides, AreNotTheSameTwiceRoundATube) {
  const std::vector<int> nodes{7, 8, 7, 8};
  // From both copies of the seam's first node, a side leads to point 4.
  const Quads crowded{{0, 5, 6, 4}, {0, 4, 9, 1}, {2, 4, 6, 10}, {2, 3, 9, 4}};
  ASSERT_TRUE(crowded_side(nodes, crowded));
  EXPECT_EQ(std::max(crowded_side(nodes, crowded)->first, crowded_side(nodes, crowded)->second), 4);
  EXPECT_FALSE(crowded_side({7, 8, 17, 18}, crowded));
  EXPECT_FALSE(crowded_side({0, 1, 2, 3, 4, 5}, two_quads));
}

}  // namespace
}  // namespace quadrille
