/// Each piece of the paper's coloring on its own.

#include "mesher/pairing/edge_coloring.hpp"

#include <gtest/gtest.h>

#include "tests/support/coloring_checks.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

std::vector<TriangleMesh> samples() {
  std::vector<TriangleMesh> meshes{
      strip(1),   strip(9),     band(7),        fan(8, true),          fan(5, false),
      grid(9, 9), icosphere(3), torus(9, 7, 1), double_torus(8, 6, 2), with_ears(strip(6))};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    meshes.push_back(random_square(300, seed));
    meshes.push_back(random_with_holes(500, 5, seed));
    meshes.push_back(perforated(random_square(300, seed), 0.2, seed));
  }
  return meshes;
}

TEST(EdgeColoring, KnowsBothSidesOfAnEdge) {
  EdgeColoring coloring(strip(2));
  EXPECT_EQ(count_blanks(coloring), 5);
  const Side shared = make_side(0, 1);
  ASSERT_EQ(triangle_of(coloring.twin(shared)), 1);
  coloring.set_color(shared, 2);
  EXPECT_EQ(coloring.color(coloring.twin(shared)), 2);
  EXPECT_EQ(coloring.side_of(1, 2), coloring.twin(shared));
  EXPECT_EQ(coloring.side_of(0, 1), -1);
  EXPECT_EQ(coloring.colors_used(0), 4);
  EXPECT_EQ(count_blanks(coloring), 4);
}

TEST(EdgeColoring, AColorComesOnceInATriangle) {
  EdgeColoring coloring(strip(3));
  const Side shared = make_side(0, 1), next = make_side(1, 1);
  coloring.set_color(shared, 1);
  coloring.set_color(next, 1);
  EXPECT_EQ(validate(coloring), "");
  EXPECT_EQ(coloring.color(shared), EdgeColoring::blank);
  EXPECT_EQ(coloring.color(coloring.twin(shared)), EdgeColoring::blank);
  coloring.set_color(next, 2);
  EXPECT_EQ(coloring.color(coloring.twin(next)), 2);
  EXPECT_EQ(count_blanks(coloring), 6);
}

TEST(EdgeColoring, ValidateNoticesTrianglesThatDisagree) {
  EdgeColoring coloring(strip(2));
  coloring.set_color(make_side(0, 1), 1);
  EXPECT_EQ(validate(coloring), "");
  coloring.swap_colors(0, 1, 2);
  EXPECT_EQ(validate(coloring), "triangles 0 and 1 give the edge between them the colors 2 and 1");
}

TEST(EdgeColoring, PairsAreTheTrianglesAtTheRemovedColor) {
  EdgeColoring coloring(strip(4));
  const auto side_to = [&](int t, int other) {
    for (int i = 0; i < 3; ++i) {
      if (const Side twin = coloring.twin(make_side(t, i)); twin >= 0 && triangle_of(twin) == other)
        return make_side(t, i);
    }
    return -1;
  };
  coloring.pair(side_to(0, 1));
  coloring.pair(side_to(2, 3));
  EXPECT_EQ(coloring.mate_of(1), 0);
  EXPECT_EQ(coloring.mate_of(2), 3);
  coloring.pair(side_to(1, 2));
  EXPECT_EQ(validate(coloring), "");
  EXPECT_EQ(coloring.mate_of(1), 2);
  EXPECT_TRUE(coloring.free(0));
  EXPECT_EQ(coloring.mate_of(3), -1);
}

TEST(EdgeColoring, GreedyPassIsProperAndCountsItsBlanks) {
  int blanks = 0;
  for (const TriangleMesh& mesh : samples()) {
    EdgeColoring coloring(mesh);
    Random random(3);
    const int left = color_greedily(coloring, random);
    EXPECT_EQ(validate(coloring), "");
    EXPECT_EQ(count_blanks(coloring), left);
    blanks += left;
  }
  EXPECT_GT(blanks, 0) << "no sample gives the next step work to do";
}

TEST(EdgeColoring, BlanksAreRemoved) {
  for (const TriangleMesh& mesh : samples()) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      EdgeColoring coloring(mesh);
      Random random(seed);
      color_greedily(coloring, random);
      EXPECT_EQ(remove_blanks(coloring, random), 0);
      EXPECT_EQ(validate(coloring), "");
      EXPECT_EQ(count_blanks(coloring), 0);
    }
  }
}

TEST(EdgeColoring, ChainsExchangeTwoColorsAndStayProper) {
  EdgeColoring coloring(random_square(400, 8));
  Random random(1);
  color_greedily(coloring, random);
  remove_blanks(coloring, random);
  const auto of_boundary = count_boundary_colors(coloring, coloring.boundary());
  int tried = 0;
  for (int t = 0; t < coloring.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i);
      if (coloring.twin(side) >= 0) continue;
      const int before = coloring.color(side), with = (before + 1) % 3;
      const Side end = coloring.swap_boundary_chain(side, with);
      EXPECT_EQ(coloring.color(side), with);
      EXPECT_EQ(validate(coloring), "");
      ASSERT_GE(end, 0);
      EXPECT_LT(coloring.twin(end), 0) << "without blanks, chains end at the boundary";
      coloring.swap_boundary_chain(side, before);
      ++tried;
    }
  }
  EXPECT_GT(tried, 0);
  EXPECT_EQ(count_boundary_colors(coloring, coloring.boundary()), of_boundary);
}

TEST(EdgeColoring, BoundaryCountsHaveTheParityOfTheTriangles) {
  for (const TriangleMesh& mesh : samples()) {
    EdgeColoring coloring(mesh);
    Random random(11);
    color_greedily(coloring, random);
    ASSERT_EQ(remove_blanks(coloring, random), 0);
    for (int count : count_boundary_colors(coloring, coloring.boundary()))
      EXPECT_EQ((count - coloring.size()) % 2, 0);
    const auto counts = count_boundary_colors(coloring, coloring.boundary());
    EXPECT_EQ(counts[least_boundary_color(coloring, coloring.boundary())],
              *std::min_element(counts.begin(), counts.end()));
  }
}

TEST(EdgeColoring, TheBoundaryIsClearedOfMostOfAColor) {
  int before = 0, after = 0;
  for (const TriangleMesh& mesh : samples()) {
    EdgeColoring coloring(mesh);
    Random random(5);
    color_greedily(coloring, random);
    remove_blanks(coloring, random);
    const int color = least_boundary_color(coloring, coloring.boundary());
    const int count = count_boundary_colors(coloring, coloring.boundary())[color];
    const int left = clear_boundary(coloring, coloring.boundary(), color, random);
    EXPECT_EQ(validate(coloring), "");
    EXPECT_EQ(count_blanks(coloring), 0);
    EXPECT_EQ(count_boundary_colors(coloring, coloring.boundary())[color], left);
    EXPECT_LE(left, count);
    before += count;
    after += left;
  }
  EXPECT_LT(2 * after, before);
}

}  // namespace
}  // namespace quadrille
