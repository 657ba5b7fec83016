/// Distances between meshes and surfaces whose distance is known.

#include "mesher/remesh/fidelity.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

/// Two unit squares side by side of two triangles each, the faces of a ShellGrid, at a height.
TriangleMesh plates(double height) {
  TriangleMesh mesh;
  for (int k = 0; k < 6; ++k) mesh.points.emplace_back(k % 3, k / 3, height);
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  return mesh;
}

class Fidelity : public testing::TestWithParam<int> {
 protected:
  static RemeshFidelity of(const TriangleMesh& surface, const ShellMesh& mesh) {
    const std::vector<int> patches{0, 0, 1, 1};
    const SurfaceLocator locator(surface, patches, 2);
    return measure_fidelity(surface, patches, locator, mesh, {1, 2});
  }
};
INSTANTIATE_TEST_SUITE_P(Orders, Fidelity, testing::Values(1, 2));

TEST_P(Fidelity, IsTheHeightOfAParallelPlane) {
  const ShellMesh mesh = test::ShellGrid(4, GetParam(), 0).mesh();
  const RemeshFidelity found = of(plates(0.25), mesh);
  EXPECT_NEAR(found.of_mesh.length, 0.25, 1e-12);
  EXPECT_NEAR(found.of_surface.length, 0.25, 1e-12);
  EXPECT_NEAR(found.mesh_area, 2, 1e-12);
}

TEST_P(Fidelity, FindsTheFarthestPlaceAndItsFace) {
  ShellMesh mesh = test::ShellGrid(4, GetParam(), 0).mesh();
  const int dent = 9 * 2 + 6;  // the node at (1.5, 0.5)
  ASSERT_LT((mesh.points[dent] - Vector3(1.5, 0.5, 0)).norm(), 1e-12);
  mesh.points[dent].z() = -0.1;
  const RemeshFidelity found = of(plates(0), mesh);
  EXPECT_NEAR(found.of_mesh.length, 0.1, 1e-12);
  EXPECT_LT((found.of_mesh.at - mesh.points[dent]).norm(), 1e-12);
  EXPECT_EQ(found.of_mesh.face, 2);
  EXPECT_NEAR(found.of_surface.length, 0, 1e-12) << "the surface has points at its corners only";
}

}  // namespace
}  // namespace quadrille
