/// Shells that are thicker than bent.

#include "mesher/mesh/skins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace quadrille {
namespace {

/// A quarter of a tube of radius 2 in eight rows of quads, four on Face1 and four on Face2.
ShellMesh tube(int order) {
  constexpr int rows = 8;
  constexpr double radius = 2;
  ShellMesh mesh;
  mesh.order = order;
  const auto place = [&](double row, double z) {
    const double angle = 0.5 * M_PI * row / rows;
    mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    return static_cast<int>(mesh.points.size()) - 1;
  };
  for (int i = 0; i <= rows; ++i)
    for (const double z : {0.0, 1.0}) place(i, z);
  for (int i = 0; i < rows; ++i) {
    mesh.quads.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    mesh.quad_faces.push_back(i < rows / 2 ? 1 : 2);
  }
  if (order == 1) return mesh;
  std::vector<int> across;  // middles of the straight sides, shared by two rows
  across.reserve(rows + 1);
  for (int i = 0; i <= rows; ++i) across.push_back(place(i, 0.5));
  for (int i = 0; i < rows; ++i)
    mesh.midsides.push_back({place(i + 0.5, 0), across[i + 1], place(i + 0.5, 1), across[i]});
  return mesh;
}

class Skins : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, Skins, testing::Values(1, 2));

TEST_P(Skins, TurnOverWhereHalfTheThicknessPassesTheRadius) {
  ShellMesh mesh = tube(GetParam());
  EXPECT_TRUE(faces_with_bad_skins(mesh).empty()) << "nothing is known of its thickness";
  mesh.thicknesses = {3, 3};
  EXPECT_TRUE(faces_with_bad_skins(mesh).empty());
  mesh.thicknesses = {3, 6};
  EXPECT_EQ(faces_with_bad_skins(mesh), std::vector<int>{2});
  mesh.thicknesses = {3.9, 4.1};  // the radius is 2
  EXPECT_EQ(faces_with_bad_skins(mesh), std::vector<int>{2});
}

TEST_P(Skins, HaveTheThicknessOfTheirNodes) {
  ShellMesh mesh = tube(GetParam());
  mesh.thicknesses = {3, 3};
  ShellMesh::VaryingThickness varying;
  varying.face = 1;
  for (int node = 0; node < static_cast<int>(mesh.points.size()); ++node) {
    varying.nodes.push_back(node);
    varying.thicknesses.push_back(mesh.points[node].y() < 0.8 ? 9 : 3);  // the first two rows
  }
  mesh.varying_thicknesses.push_back(varying);
  EXPECT_EQ(faces_with_bad_skins(mesh), std::vector<int>{1});
}

TEST(BadSkins, AreNamed) {
  EXPECT_EQ(bad_skins_sentence({}), "");
  EXPECT_NE(bad_skins_sentence({2}).find("Face2"), std::string::npos);
}

}  // namespace
}  // namespace quadrille
