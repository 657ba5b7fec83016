/// The stages from triangles to quads on all faces of the sample models.

#include "mesher/quads/face_quads.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/sampled_faces.hpp"

namespace quadrille {
namespace {

/// Made of pairs only, or of pairs cut in four.
TEST(FaceQuads, FillTheFaceWithItsNodes) {
  for_each_face(
      [](SampledModel& sampled, FaceId face, const FaceSurface& surface, const FaceBoundary& boundary) {
        FaceTriangulation triangulation =
            triangulate_face(face, boundary, place(sampled, surface, boundary), surface);
        FaceQuadsOptions options;
        options.segments_per_side = boundary.stride;
        options.recombine = sampled.options.recombine;
        const FaceQuads quads = make_quads(triangulation, surface, options, sampled.context);
        const QuadMesh& mesh = quads.surface_mesh.mesh;
        EXPECT_EQ(joined(validate(mesh)), "");
        EXPECT_TRUE(mesh.triangles.empty());
        for (std::size_t i = 0; i < quads.nodes.size(); ++i)
          EXPECT_EQ(mesh.points[i], sampled.nodes.points[quads.nodes[i]]);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
          const double off = (surface.point(quads.surface_mesh.parameters[i]) - mesh.points[i]).norm();
          EXPECT_LT(off, 1e-5 * sampled.model.diagonal());
        }
      });
}

}  // namespace
}  // namespace quadrille
