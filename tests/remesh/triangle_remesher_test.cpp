/// A triangulated surface made anew of triangles: what must stay of its faces and curves.

#include "mesher/remesh/triangle_remesher.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace quadrille {
namespace {

/// A flat plate of 12 x 8 with a face of its own in it, a triangle ABC. A and B are corners, the straight
/// curve AB has its number, the curve ACB has C between its ends.
struct PlateWithTriangle {
  TriangleMesh surface;
  FeatureNetwork network;

  explicit PlateWithTriangle(double size) {
    surface.points = {{-6, -4, 0}, {6, -4, 0}, {6, 4, 0}, {-6, 4, 0}, {-1, 0, 0}, {1, 0, 0}, {0.2, 0.25, 0}};
    surface.triangles = {{4, 5, 6}, {0, 1, 5}, {0, 5, 4}, {1, 2, 5},
                         {2, 6, 5}, {2, 3, 6}, {3, 4, 6}, {3, 0, 4}};
    surface.tags = {2, 1, 1, 1, 1, 1, 1, 1};
    FeatureRules rules;
    rules.size = size;
    rules.sides[{4, 5}] = 9;
    network = find_features(surface, rules);
    surface.tags.clear();
  }
};

double area_of(const TriangleMesh& mesh, int tag) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (mesh.tags[t] == tag)
      sum += 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  }
  return sum;
}

TEST(TriangleRemesher, SidesOfACurveDoNotCollapseOntoAnotherCurve) {
  // The size asks for nodes at the ends of the curves only. C may not go to A or B: one curve would lie on
  // the other then, and the face between them would be gone.
  constexpr double size = 6;
  const PlateWithTriangle plate(size);
  ASSERT_EQ(plate.network.patch_count, 2);
  std::vector<std::vector<double>> nodes;
  int short_curves = 0;
  for (const FeatureCurve& curve : plate.network.curves) {
    nodes.push_back({0, curve.length()});
    short_curves += curve.length() < 3;
  }
  ASSERT_EQ(short_curves, 2);
  const SurfaceLocator locator(plate.surface, plate.network.patches, plate.network.patch_count);
  ExecutionContext context(1);
  const RemeshedTriangles made =
      remesh_triangles(plate.surface, plate.network, nodes, locator, std::vector<double>(7, size), context);
  EXPECT_NEAR(area_of(made.mesh, plate.network.patches[0]), 0.25, 1e-12);
  EXPECT_NEAR(area_of(made.mesh, plate.network.patches[1]), 96 - 0.25, 1e-12);
  // Each curve is there from end to end, each stretch of it once.
  std::vector<double> end(plate.network.curves.size(), 0);
  for (const RemeshedTriangles::CurveSide& side : made.sides) {
    EXPECT_EQ(side.from, end[side.curve]);
    EXPECT_GT(side.to, side.from);
    end[side.curve] = side.to;
  }
  for (std::size_t c = 0; c < end.size(); ++c) EXPECT_EQ(end[c], plate.network.curves[c].length());
}

}  // namespace
}  // namespace quadrille
