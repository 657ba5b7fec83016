/// Midside nodes of remeshed surfaces: no element folds.

#include "mesher/remesh/surface_midsides.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/second_order.hpp"
#include "mesher/quads/triangulated_surface.hpp"

namespace quadrille {
namespace {

/// Rows of quads between curves that bulge by more than a row is high, the last one straight: only the last
/// row folds, and once its sides are straight the row before it.
TEST(SurfaceMidsides, StraighteningGoesOnUntilNothingFolds) {
  constexpr int rows = 40;
  constexpr double height = 0.01;
  TriangleMesh square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const TriangulatedSurface surface(square);
  const SurfaceLocator locator(square, {0, 0}, 1);
  ShellMesh mesh;
  PatchQuads patch;
  std::vector<CurveStretch> stretches;
  for (int row = 0; row <= rows; ++row) {
    const int a = 2 * row, b = a + 1;
    patch.points.emplace_back(0, row * height, 0);
    patch.points.emplace_back(1, row * height, 0);
    patch.nodes.insert(patch.nodes.end(), {a, b});
    patch.places.insert(patch.places.end(), 2, Vector2(0, 0));
    mesh.segments.push_back({{a, b}, -1, row + 1});
    stretches.push_back({{0.5, (row < rows ? row + 3 : row) * height, 0}});
    if (row > 0) patch.quads.push_back({a - 2, b - 2, b, a});
  }
  mesh.points = patch.points;
  mesh.quads = patch.quads;
  mesh.quad_faces.assign(rows, 1);
  std::vector<std::string> notes;
  add_surface_midsides(mesh, {patch}, stretches, {surface, locator}, notes);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) EXPECT_FALSE(folds(curved_quad(mesh, q))) << q;
  EXPECT_EQ(mesh.off_geometry.size(), static_cast<std::size_t>(rows));
  EXPECT_EQ(notes.size(), 1u);
}

}  // namespace
}  // namespace quadrille
