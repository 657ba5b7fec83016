/// Triangles that no path pairs migrate until they meet.

#include "mesher/pairing/costed_coloring.hpp"

#include <gtest/gtest.h>

#include "mesher/pairing/augmenting_paths.hpp"
#include "tests/support/coloring_checks.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

TEST(FreeTriangles, FreeTrianglesFarApartMeet) {
  // One triangle less in each of two far corners: what the cheapest way is searched for does not reach.
  const TriangleMesh mesh = grid(300, 150);
  const TriangleMesh cut = keep_triangles(mesh, [&](int t, const Vector3&) {
    return t != 0 && t + 1 != static_cast<int>(mesh.triangles.size());
  });
  CostedColoring coloring(cut);
  for (Side s = 0; s < 4 * coloring.size(); ++s) {
    if (index_of(s) == 3) continue;
    // The squares of the grid: paired across their diagonals.
    const Vector3 along = cut.points[coloring.end_of(s)] - cut.points[coloring.corner_at(s)];
    if (along.x() * along.y() != 0 && coloring.twin(s) > s) coloring.pair(s);
  }
  EXPECT_EQ(free_triangles(coloring).size(), 2U);
  coloring.compute_costs(cut.points);
  EXPECT_EQ(migrate_free_triangles(coloring, cut.points), 0);
  EXPECT_EQ(validate(coloring), "");
}

}  // namespace
}  // namespace quadrille
