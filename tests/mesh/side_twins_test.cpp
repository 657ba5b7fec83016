/// Sides that two triangles share, beside a map of all sides; meshes that have none are refused.

#include "mesher/mesh/side_twins.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "geometry/base/error.hpp"

namespace quadrille {
namespace {

/// n x n squares of two triangles each. \param halves gives the left and the right half tags of their own
TriangleMesh squares(int n, bool halves) {
  TriangleMesh mesh;
  for (int k = 0; k < (n + 1) * (n + 1); ++k) mesh.points.emplace_back(k % (n + 1), k / (n + 1), 0);
  for (int k = 0; k < n * n; ++k) {
    const int a = k / n * (n + 1) + k % n;
    mesh.triangles.push_back({a, a + 1, a + n + 2});
    mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    if (halves) mesh.tags.insert(mesh.tags.end(), 2, k % n < n / 2 ? 1 : 2);
  }
  return mesh;
}

std::set<std::pair<Side, Side>> twins_of(const TriangleMesh& mesh) {
  std::set<std::pair<Side, Side>> twins;
  join_twins(mesh, [&](Side a, Side b) { EXPECT_TRUE(twins.insert(std::minmax(a, b)).second); });
  return twins;
}

TEST(SideTwins, AreTheSidesThatRunBothWaysWithinATag) {
  for (const bool halves : {false, true}) {
    const TriangleMesh mesh = squares(7, halves);
    std::map<std::array<int, 3>, Side> sides;  // by tag, start and end
    const auto key = [&](int t, int from, int to) { return std::array{halves ? mesh.tags[t] : 0, from, to}; };
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k)
        sides[key(t, mesh.triangles[t][k], mesh.triangles[t][next_index(k)])] = make_side(t, k);
    std::set<std::pair<Side, Side>> expected;
    for (const auto& [at, side] : sides) {
      const auto twin = sides.find({at[0], at[2], at[1]});
      if (twin != sides.end()) expected.insert(std::minmax(side, twin->second));
    }
    EXPECT_EQ(expected.size(), halves ? 133u - 7u : 133u);  // 49 diagonals and 2 x 6 x 7 sides of squares
    EXPECT_EQ(twins_of(mesh), expected);
  }
}

TEST(SideTwins, PiecesEndWhereTagsDo) {
  const TriangleMesh mesh = squares(6, true);
  Twins twins(mesh.triangles.size(), {-1, -1, -1});
  join_twins(mesh, [&](Side a, Side b) {
    twins[triangle_of(a)][index_of(a)] = b;
    twins[triangle_of(b)][index_of(b)] = a;
  });
  std::vector<int> pieces;
  const auto twin_of = [&](Side side) { return twins[triangle_of(side)][index_of(side)]; };
  EXPECT_EQ(number_pieces(twins.size(), twin_of, pieces), 2);
  for (std::size_t t = 0; t < pieces.size(); ++t) EXPECT_EQ(pieces[t], mesh.tags[t] - 1);
}

TEST(SideTwins, RefusesWhatIsNoSurface) {
  const auto error_of = [](const TriangleMesh& mesh) -> std::string {
    try {
      check_indices(mesh);
      join_twins(mesh, [](Side, Side) {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TriangleMesh third = squares(2, false);
  third.triangles.push_back({0, 1, 8});
  EXPECT_NE(error_of(third), "");
  TriangleMesh turned = squares(2, false);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_NE(error_of(turned), "");
  TriangleMesh outside = squares(2, false);
  outside.triangles[0][2] = 9;
  EXPECT_NE(error_of(outside), "");
  TriangleMesh repeated = squares(2, false);
  repeated.triangles[0][2] = repeated.triangles[0][1];
  EXPECT_NE(error_of(repeated), "");
  EXPECT_EQ(error_of(squares(2, false)), "");
}

}  // namespace
}  // namespace quadrille
