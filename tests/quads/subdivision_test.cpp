/// Midpoint subdivision on all faces of the sample models.

#include "mesher/quads/face_quads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/sampled_faces.hpp"

namespace quadrille {
namespace {

TEST(Subdivision, CutsQuadsInFourAtTheMiddlesOfTheirSides) {
  for_each_face(
      [](SampledModel& sampled, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        if (boundary.stride != 2) return;
        const FaceTriangulation triangulation =
            triangulate_face(face, boundary, place(sampled, surface, boundary), surface);
        FaceQuads coarse;
        coarse.surface_mesh.mesh.points = triangulation.mesh.points;
        coarse.surface_mesh.mesh.triangles = triangulation.mesh.triangles;
        coarse.surface_mesh.parameters = triangulation.uv;
        coarse.surface_mesh.normals = triangulation.normals;
        coarse.surface_mesh.fixed.assign(triangulation.uv.size(), 0);
        std::fill_n(coarse.surface_mesh.fixed.begin(), triangulation.boundary_count, 1);
        coarse.nodes = triangulation.nodes;
        coarse.pole = triangulation.pole;
        const FaceQuads once = subdivide(coarse, triangulation.segments, surface);
        EXPECT_EQ(once.surface_mesh.mesh.quads.size(), 3 * triangulation.mesh.triangles.size());
        EXPECT_TRUE(once.surface_mesh.mesh.triangles.empty());
        EXPECT_EQ(joined(validate(once.surface_mesh.mesh)), "");
        // New fixed points are the middle nodes of the edges' segments.
        std::set<int> middles, found(once.nodes.begin(), once.nodes.end());
        for (const auto& segment : triangulation.segments) middles.insert(segment.middle_node);
        for (const int node : middles) EXPECT_TRUE(found.contains(node));
        for (std::size_t i = 0; i < once.nodes.size(); ++i)
          EXPECT_EQ(once.surface_mesh.mesh.points[i], sampled.nodes.points[once.nodes[i]]);
      });
}

}  // namespace
}  // namespace quadrille
