/// Sides know both their triangles, and flips leave Delaunay triangles.

#include "mesher/faces/face_triangulation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

namespace quadrille {
namespace {

/// A flat rhombus, cut along its long diagonal.
FaceTriangulation rhombus() {
  FaceTriangulation face;
  face.mesh.points = {{0, 0, 0}, {5, -1, 0}, {10, 0, 0}, {5, 1, 0}};
  face.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  face.normals.assign(4, Vector3(0, 0, 1));
  return face;
}

std::vector<int> neighbors(const FaceTriangulation& face) {
  return triangle_neighbors(face.mesh.triangles, 4, {});
}

TEST(TriangleFlips, SidesKnowBothTriangles) {
  EXPECT_EQ(neighbors(rhombus()), (std::vector<int>{-1, -1, 3, 2, -1, -1}));
}

TEST(TriangleFlips, TurnsASideThatIsNotDelaunay) {
  FaceTriangulation face = rhombus();
  flip_in_space(face, neighbors(face), {});
  ASSERT_EQ(face.mesh.triangles.size(), 2U);
  for (const std::array<int, 3>& triangle : face.mesh.triangles) {
    const auto& [a, b, c] = triangle;
    const auto& p = face.mesh.points;
    EXPECT_NEAR(0.5 * (p[b] - p[a]).cross(p[c] - p[a]).z(), 5, 1e-9);  // still counter-clockwise
    const std::set<int> corners(triangle.begin(), triangle.end());
    EXPECT_TRUE(corners.contains(1) && corners.contains(3));
  }
  const auto once = face.mesh.triangles;
  flip_in_space(face, neighbors(face), {});
  EXPECT_EQ(face.mesh.triangles, once);
}

TEST(TriangleFlips, LeavesEdgesInsideTheFaceAlone) {
  FaceTriangulation face = rhombus();
  face.segments.emplace_back();
  face.segments[0].a = 0;
  face.segments[0].b = 2;
  face.segments[0].internal = true;
  const auto before = face.mesh.triangles;
  flip_in_space(face, neighbors(face), {});
  EXPECT_EQ(face.mesh.triangles, before);
}

}  // namespace
}  // namespace quadrille
