/// Triangulations of all faces of the sample models.

#include "mesher/faces/face_triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tests/support/sampled_faces.hpp"

namespace quadrille {
namespace {

TEST(FaceTriangulation, IsValidAndKeepsTheBoundary) {
  for_each_face(
      [](SampledModel& sampled, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        const FaceTriangulation result =
            triangulate_face(face, boundary, place(sampled, surface, boundary), surface);
        EXPECT_EQ(joined(validate(result.mesh)), "");
        EXPECT_EQ(result.mesh.triangles.size() % 2, 0U);
        std::set<std::pair<int, int>> open;
        for (const auto& t : result.mesh.triangles) {
          for (int k = 0; k < 3; ++k) {
            const auto side = std::minmax(t[k], t[(k + 1) % 3]);
            if (!open.insert(side).second) open.erase(side);
          }
        }
        std::set<std::pair<int, int>> wanted;
        for (const auto& segment : result.segments) wanted.insert(std::minmax(segment.a, segment.b));
        EXPECT_EQ(open, wanted);
      });
}

TEST(Recombination, LeavesNoTriangleAndKeepsTheArea) {
  for_each_face(
      [](SampledModel& sampled, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        const FaceTriangulation triangulation =
            triangulate_face(face, boundary, place(sampled, surface, boundary), surface);
        const QuadMesh quads = recombine(triangulation.mesh, sampled.options.recombine, sampled.context);
        EXPECT_EQ(joined(validate(quads)), "");
        EXPECT_TRUE(quads.triangles.empty());
        EXPECT_EQ(2 * quads.quads.size(), triangulation.mesh.triangles.size());
      });
}

}  // namespace
}  // namespace quadrille
