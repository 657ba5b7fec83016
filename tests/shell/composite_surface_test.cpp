/// A dome on a tube, as one surface: each point lies exactly on the surface of the face that it belongs to.

#include "mesher/shell/composite_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/sample_quads.hpp"

namespace quadrille {
namespace {

constexpr int around = 12, rows = 6, below = 3;  // rows of points; `below` of their gaps belong to the tube

/// Height of a row: up to 0 on the tube, then latitude on the dome.
Vector3 place(int row, int column) {
  const double angle = 2 * std::numbers::pi * column / around, up = 0.5 * (row - below);
  const double latitude = std::max(0.0, up), z = up < 0 ? up : std::sin(latitude);
  return {std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle), z};
}

/// Half of the tube (member 0) and of the dome (member 1) over it, each with its rows and columns as
/// parameters.
CompositeSurface dome_on_tube() {
  TriangleMesh mesh;
  std::vector<int> members;
  std::vector<std::array<Vector2, 3>> uvs;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column <= around / 2; ++column) mesh.points.push_back(place(row, column));
  const auto add = [&](std::array<std::array<int, 2>, 3> corners, int member) {
    std::array<int, 3> nodes{};
    std::array<Vector2, 3> uv;
    for (int k = 0; k < 3; ++k) {
      nodes[k] = corners[k][1] * (around / 2 + 1) + corners[k][0];
      uv[k] = {corners[k][0], corners[k][1]};
    }
    mesh.triangles.push_back(nodes);
    members.push_back(member);
    uvs.push_back(uv);
  };
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column < around / 2; ++column) {
      const int member = row < below ? 0 : 1;
      add({{{column, row}, {column + 1, row}, {column + 1, row + 1}}}, member);
      add({{{column, row}, {column + 1, row + 1}, {column, row + 1}}}, member);
    }
  return {mesh,
          members,
          uvs,
          {std::make_shared<sample::CylinderSurface>(1), std::make_shared<sample::SphereSurface>(1)}};
}

TEST(CompositeSurface, FindsTheFaceAndItsExactSurface) {
  const CompositeSurface surface = dome_on_tube();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.3, 2.8), height(-1.2, 0.6), off(0.9, 1.2);
  Vector2 uv(0, 0);  // each search begins where the last one ended
  int on_dome = 0;
  for (int i = 0; i < 300; ++i) {
    const double turn = angle(random), up = height(random), radius = off(random);
    if (std::abs(up) < 0.1) continue;  // chords of the dome lie beside the rim
    const double latitude = std::max(0.0, up);
    const Vector3 exact(std::cos(latitude) * std::cos(turn), std::cos(latitude) * std::sin(turn),
                        up < 0 ? up : std::sin(latitude));
    const Vector3 target =
        up < 0 ? Vector3(radius * exact.x(), radius * exact.y(), exact.z()) : Vector3(radius * exact);
    Vector3 normal;
    EXPECT_LT((surface.move(uv, target, normal) - exact).norm(), 1e-12) << exact.transpose();
    EXPECT_EQ(surface.member(uv), up < 0 ? 0 : 1);
    EXPECT_GT(normal.dot(exact - Vector3(0, 0, std::min(up, 0.0))), 0.9);
    on_dome += up > 0;
  }
  EXPECT_GT(on_dome, 50);
}

TEST(CompositeSurface, GivesParametersOnTheSurfaceOfTheFace) {
  const CompositeSurface surface = dome_on_tube();
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column < around / 2; ++column) {
      const Vector2 triangle(2 * (row * (around / 2) + column), 0);
      const Vector3 a = place(row, column), b = place(row, column + 1), c = place(row + 1, column + 1);
      EXPECT_LT((surface.member_uv(triangle, a) - Vector2(column, row)).norm(), 1e-9);
      EXPECT_LT((surface.member_uv(triangle, c) - Vector2(column + 1, row + 1)).norm(), 1e-9);
      const Vector2 center = surface.member_uv(triangle, (a + b + c) / 3);
      EXPECT_LT((center - Vector2(column + 2.0 / 3, row + 1.0 / 3)).norm(), 1e-9);
      // Beyond the triangle they stay in it.
      const Vector2 beyond = surface.member_uv(triangle, a + 5 * (a - c));
      EXPECT_LT((beyond - Vector2(column, row)).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace quadrille
