/// Good meshes pass; one fault put in at a time is named.

#include "mesher/shell/validate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace quadrille {
namespace {

/// Whether one of the sentences holds the words.
::testing::AssertionResult says(const std::vector<std::string>& sentences, const std::string& words) {
  for (const auto& sentence : sentences)
    if (sentence.find(words) != std::string::npos) return ::testing::AssertionSuccess();
  auto result = ::testing::AssertionFailure() << "none says \"" << words << "\":";
  for (const auto& sentence : sentences) result << "\n  " << sentence;
  return result;
}

TriangleMesh two_triangles() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}};
}

QuadMesh two_quads() {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  return mesh;
}

/// A unit cube of six quads, each its own face, with its twelve edges and eight vertices.
ShellMesh cube() {
  ShellMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  mesh.quad_faces = {1, 2, 3, 4, 5, 6};
  int edge = 0;
  for (int i = 0; i < 8; ++i)
    for (int bit = 1; bit < 8; bit *= 2)
      if (!(i & bit)) mesh.segments.push_back({{i, i | bit}, -1, ++edge});
  for (int i = 0; i < 8; ++i) mesh.corners.push_back({i, i + 1});
  return mesh;
}

/// The cube with midside nodes.
ShellMesh cube_of_second_order() {
  ShellMesh mesh = cube();
  mesh.order = 2;
  mesh.midsides.resize(6);
  for (auto& segment : mesh.segments) {
    segment.middle = static_cast<int>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[segment.nodes[0]] + mesh.points[segment.nodes[1]]));
    for (std::size_t i = 0; i < 6; ++i)
      for (int k = 0; k < 4; ++k) {
        const int a = mesh.quads[i][k], b = mesh.quads[i][(k + 1) & 3];
        if (std::min(a, b) == segment.nodes[0] && std::max(a, b) == segment.nodes[1])
          mesh.midsides[i][k] = segment.middle;
      }
  }
  return mesh;
}

TEST(ValidateTriangles, AcceptsAGoodMesh) {
  EXPECT_EQ(validate(two_triangles()), std::vector<std::string>{});
}

TEST(ValidateTriangles, NamesEachFault) {
  TriangleMesh mesh = two_triangles();
  mesh.triangles[1][2] = 9;
  EXPECT_TRUE(says(validate(mesh), "triangle 1 refers to point 9, but there are 4 points"));
  mesh = two_triangles();
  mesh.triangles[1][2] = 0;
  EXPECT_TRUE(says(validate(mesh), "triangle 1 has point 0 twice"));
  mesh = two_triangles();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  EXPECT_TRUE(says(validate(mesh), "triangle 0 and triangle 1 run the side between points 0 and 2"));
  mesh = two_triangles();
  mesh.points.push_back({5, 5, 5});
  EXPECT_TRUE(says(validate(mesh), "point 4 belongs to no element"));
  mesh = two_triangles();
  mesh.points.push_back({1, 0, 1});
  mesh.triangles.push_back({2, 0, 4});
  EXPECT_TRUE(says(validate(mesh), "the side between points 0 and 2 has 3 elements"));
  mesh = two_triangles();
  mesh.points[1] = {0.5, 0.5, 0};
  EXPECT_TRUE(says(validate(mesh), "triangle 0 has no area"));
  mesh = two_triangles();
  mesh.tags = {1};
  EXPECT_TRUE(says(validate(mesh), "1 tags for 2 triangles"));
}

TEST(ValidateTriangles, StopsAtTwentySentences) {
  TriangleMesh mesh = two_triangles();
  mesh.points.resize(100, Vector3(1, 2, 3));
  EXPECT_EQ(validate(mesh).size(), 20u);
}

TEST(ValidateQuads, AcceptsAGoodMesh) {
  EXPECT_EQ(validate(two_quads(), true), std::vector<std::string>{});
}

TEST(ValidateQuads, AsksForConvexityOnlyOnDemand) {
  QuadMesh mesh = two_quads();
  mesh.points[5] = {1.2, 0.2, 0};
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_TRUE(says(validate(mesh, true), "quad 1 is not convex"));
}

TEST(ValidateQuads, NamesEachFault) {
  QuadMesh mesh = two_quads();
  mesh.quads[1] = {4, 5, 2, 1};
  EXPECT_TRUE(
      says(validate(mesh), "quad 0 and quad 1 run the side between points 1 and 4 in the same direction"));
  mesh = two_quads();
  mesh.points[3].x() = std::nan("");
  EXPECT_TRUE(says(validate(mesh), "point 3 has a coordinate that is not a number"));
  mesh = two_quads();
  mesh.triangles = {{0, 1, 3}};
  EXPECT_TRUE(says(validate(mesh), "the side between points 0 and 1"));
}

TEST(ValidateShell, AcceptsACube) {
  EXPECT_EQ(validate(cube(), true), std::vector<std::string>{});
  EXPECT_EQ(validate(cube_of_second_order(), true), std::vector<std::string>{});
}

TEST(ValidateShell, TellsOpenFromClosed) {
  ShellMesh mesh = cube();
  mesh.quads.pop_back();
  mesh.quad_faces.pop_back();
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_TRUE(says(validate(mesh, true), "is open"));
}

TEST(ValidateShell, NamesEachFault) {
  ShellMesh mesh = cube();
  mesh.segments.pop_back();
  EXPECT_TRUE(says(validate(mesh), "lies on no CAD edge, but parts faces"));
  mesh = cube();
  mesh.segments.push_back({{1, 0}, -1, 1});
  EXPECT_TRUE(says(validate(mesh), "have the same nodes"));
  mesh = cube();
  mesh.segments.push_back({{0, 7}, -1, 1});
  EXPECT_TRUE(says(validate(mesh), "segment 12 is not a side of any quad"));
  mesh = cube();
  mesh.points[1] = mesh.points[0] + Vector3(1e-10, 0, 0);
  EXPECT_TRUE(says(validate(mesh), "points 0 and 1 coincide"));
  mesh = cube();
  mesh.corners.push_back({3, 99});
  EXPECT_TRUE(says(validate(mesh), "node 3 is listed as a corner twice"));
  mesh = cube();
  mesh.corners.back().vertex = 1;
  EXPECT_TRUE(says(validate(mesh), "vertex 1 is listed twice"));
  mesh = cube();
  mesh.quad_faces.pop_back();
  EXPECT_TRUE(says(validate(mesh), "5 face numbers for 6 quads"));
  mesh = cube();
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(says(validate(mesh), "1 triangles remain"));
  mesh = cube();
  mesh.points[3] = {0.1, 0.1, 0};
  EXPECT_TRUE(says(validate(mesh), "is not convex"));
}

TEST(ValidateShell, FindsOneFaceTornOrTurnedOver) {
  ShellMesh mesh = cube();
  mesh.quad_faces.assign(6, 1);
  mesh.quads[0] = {0, 1, 3, 2};
  EXPECT_TRUE(says(validate(mesh), "in the same direction"));
  mesh = cube();
  mesh.quad_faces.assign(6, 1);
  mesh.segments.resize(1);
  EXPECT_TRUE(validate(mesh).empty());
  mesh.quads.pop_back();
  mesh.quad_faces.pop_back();
  EXPECT_TRUE(says(validate(mesh), "lies on no CAD edge and has 1 elements"));
}

TEST(ValidateShell, ChecksMidsideNodes) {
  ShellMesh mesh = cube_of_second_order();
  std::swap(mesh.midsides[2][0], mesh.midsides[2][1]);
  EXPECT_TRUE(says(validate(mesh), "from another quad"));
  mesh = cube_of_second_order();
  mesh.midsides[2][0] = 0;
  EXPECT_TRUE(says(validate(mesh), "quad 2 has 0 as a midside node"));
  mesh = cube_of_second_order();
  mesh.segments[0].middle = -1;
  EXPECT_TRUE(says(validate(mesh), "segment 0 has midside node -1"));
  mesh = cube_of_second_order();
  mesh.midsides.pop_back();
  EXPECT_TRUE(says(validate(mesh), "5 midside rows for 6 quads"));
}

TEST(ValidateShell, FindsCoincidentNodesAcrossCells) {
  // Far apart in index, anywhere in space, and on both sides of the origin.
  ShellMesh mesh;
  for (int j = 0; j <= 20; ++j)
    for (int i = 0; i <= 20; ++i) mesh.points.push_back({i - 10.0, j - 10.0, 0});
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i) {
      const int a = j * 21 + i;
      mesh.quads.push_back({a, a + 1, a + 22, a + 21});
      mesh.quad_faces.push_back(1);
    }
  EXPECT_TRUE(validate(mesh).empty());
  for (const int node : {0, 21, 220}) {
    ShellMesh twice = mesh;
    const int copy = static_cast<int>(twice.points.size());
    twice.points.push_back(twice.points[node] - Vector3(1e-9, 1e-9, 1e-9));
    for (int& corner : twice.quads.back())
      if (corner == 440) corner = copy;
    EXPECT_TRUE(says(validate(twice), "points " + std::to_string(node) + " and 441 coincide")) << node;
  }
}

}  // namespace
}  // namespace quadrille
