/// Triangulations oriented alike, and cut into pieces.

#include "mesher/mesh/surface_cut.hpp"

#include <gtest/gtest.h>

#include "geometry/base/error.hpp"
#include "mesher/mesh/side_twins.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

std::string error_of(TriangleMesh mesh) {
  try {
    orient_alike(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// A strip of n pairs of triangles round a ring, its end turned over by `twists` halves before it is joined.
TriangleMesh ring(int n, int twists) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n, lean = twists * angle / 2;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(lean);
      mesh.points.emplace_back(r * std::cos(angle), r * std::sin(angle), side * std::sin(lean));
    }
  }
  for (int k = 0; k < n; ++k) {
    const bool last = k + 1 == n, over = last && twists % 2 == 1;
    const int a = 2 * k, b = a + 1, c = last ? (over ? 1 : 0) : a + 2, d = last ? (over ? 0 : 1) : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  return mesh;
}

TEST(SurfaceCut, TurnsTheFewTrianglesThatDisagree) {
  TriangleMesh mesh = random_square(400, 3);
  const TriangleMesh before = mesh;
  for (const std::size_t t : {0U, 7U, 8U, 100U}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  EXPECT_EQ(orient_alike(mesh), 4);
  EXPECT_NO_THROW(check_sides(mesh));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    EXPECT_GT((mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).z(), 0) << t;
  }
  EXPECT_EQ(orient_alike(mesh), 0);
}

TEST(SurfaceCut, NamesATriangleOfASurfaceWithOneSideAndOneThatIsThereTwice) {
  EXPECT_EQ(error_of(ring(20, 0)), "");
  EXPECT_EQ(error_of(ring(20, 2)), "");
  EXPECT_NE(error_of(ring(20, 1)).find("like a Moebius strip"), std::string::npos);
  TriangleMesh twice = random_square(50, 1);
  const auto [a, b, c] = twice.triangles[3];
  twice.triangles.push_back({c, a, b});
  EXPECT_NE(error_of(twice).find("has the same corners as triangle 3"), std::string::npos);
}

/// Six squares of two triangles: a cube with one corner at the origin.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  for (const std::array<int, 4> square :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({square[0], square[1], square[2]});
    mesh.triangles.push_back({square[0], square[2], square[3]});
  }
  return mesh;
}

TEST(SurfaceCut, FoldsBecomeBordersOfPieces) {
  const CutSurface whole = cut_surface(cube(), 0);
  EXPECT_EQ(whole.pieces, 1);
  EXPECT_EQ(whole.mesh.triangles, cube().triangles);
  EXPECT_EQ(cut_surface(cube(), 91).pieces, 1);
  const CutSurface cut = cut_surface(cube(), 40);
  EXPECT_EQ(cut.pieces, 6);
  EXPECT_EQ(cut.mesh.points.size(), 24U);  // each corner three times
  ASSERT_EQ(cut.original.size(), 24U);
  for (std::size_t v = 0; v < 24; ++v) EXPECT_EQ(cut.mesh.points[v], cut.mesh.points[cut.original[v]]);
  for (std::size_t t = 0; t < 12; ++t) EXPECT_EQ(cut.mesh.tags[t], static_cast<int>(t) / 2);
}

/// A cut that ends inside: what lies on both of its sides is one piece, its points but for the end are
/// doubled.
TEST(SurfaceCut, ASlitDoublesItsPointsButForItsEnds) {
  const TriangleMesh mesh = grid(6, 6);
  const auto at = [](int i, int j) { return 7 * j + i; };
  const CutSurface cut = cut_surface(mesh, 0, {{at(2, 3), at(3, 3)}, {at(4, 3), at(3, 3)}});
  EXPECT_EQ(cut.pieces, 1);
  ASSERT_EQ(cut.mesh.points.size(), mesh.points.size() + 1);
  EXPECT_EQ(cut.original.back(), at(3, 3));
  EXPECT_NO_THROW(check_sides(cut.mesh));
  const CutSurface open = cut_surface(mesh, 0, {{at(0, 3), at(1, 3)}, {at(2, 3), at(1, 3)}});
  EXPECT_EQ(open.mesh.points.size(), mesh.points.size() + 2);
}

TEST(SurfaceCut, ASideAloneIsCutWithTheNext) {
  const CutSurface cut = cut_surface(grid(6, 6), 0, {{24, 25}});
  EXPECT_EQ(cut.mesh.points.size(), 50U);
  EXPECT_EQ(cut.pieces, 1);
  int with_side = 0;
  for (const auto& triangle : cut.mesh.triangles)
    with_side += std::count(triangle.begin(), triangle.end(), 24) > 0 &&
                 std::count(triangle.begin(), triangle.end(), 25) > 0;
  EXPECT_EQ(with_side, 1);  // the other has a copy of one of them
}

TEST(SurfaceCut, TagsAndThirdTrianglesOnASideCutToo) {
  TriangleMesh mesh = grid(2, 1);
  mesh.tags = {1, 1, 5, 5};
  EXPECT_EQ(cut_surface(mesh, 0).pieces, 2);
  TriangleMesh fin = strip(2);
  fin.points.emplace_back(0.5, 0.5, 1);
  fin.triangles.push_back({1, 2, 4});  // 1-2 is the side between the first two
  EXPECT_EQ(cut_surface(fin, 0).pieces, 3);
}

TEST(SurfaceCut, CoincidentPointsStandForTheFirst) {
  const std::vector<Vector3> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 1e-7}, {1, 0, 0}, {0.99999, 0, 0}};
  EXPECT_EQ(coincident_points(points, 0), (std::vector<int>{0, 1, 2, 1, 4}));
  EXPECT_EQ(coincident_points(points, 1e-6), (std::vector<int>{0, 1, 0, 1, 4}));
  EXPECT_EQ(coincident_points(points, 1e-4), (std::vector<int>{0, 1, 0, 1, 1}));
  // On both sides of a border between cells, and far away.
  const std::vector<Vector3> far{{-1e-9, 5e6, 0}, {1e-9, 5e6, 0}};
  EXPECT_EQ(coincident_points(far, 1e-3), (std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace quadrille
