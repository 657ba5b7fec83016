/// Meshes of any origin as one clean triangulation.

#include "mesher/shell/triangle_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "geometry/base/error.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

TriangleInput cleaned(const ShellMesh& mesh, double merge, std::vector<std::string>& notes) {
  ExecutionContext context;
  return triangle_input(mesh, merge, 0, notes, context);
}

Vector3 area_of(const TriangleMesh& mesh) {
  Vector3 sum = Vector3::Zero();
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
  return sum;
}

TEST(TriangleInput, CutsEachQuadInTwoOfItsFace) {
  ShellMesh mesh = test::ShellGrid(4, 1).mesh();
  std::vector<std::string> notes;
  const TriangleInput input = cleaned(mesh, 0, notes);
  EXPECT_TRUE(notes.empty()) << notes.front();
  EXPECT_EQ(input.mesh.triangles.size(), 2 * mesh.quads.size());
  EXPECT_EQ(input.sides.size(), mesh.segments.size());
  EXPECT_NEAR(area_of(input.mesh).z(), 2, 1e-12);
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    EXPECT_EQ(input.mesh.points[input.node[node]], mesh.points[node]);
  for (std::size_t t = 0; t < input.mesh.triangles.size(); ++t) {
    for (const int point : input.mesh.triangles[t])
      EXPECT_EQ(input.mesh.points[point].x() > 1 + 1e-9 ? 2 : input.mesh.tags[t], input.mesh.tags[t]);
  }
}

TEST(TriangleInput, JoinsQuadsThatShareNoNodes) {
  const ShellMesh whole = test::ShellGrid(4, 1).mesh();
  ShellMesh apart;
  apart.order = 1;
  for (std::size_t q = 0; q < whole.quads.size(); ++q) {
    const int first = static_cast<int>(apart.points.size());
    for (const int node : whole.quads[q]) apart.points.push_back(whole.points[node]);
    apart.quads.push_back({first, first + 1, first + 2, first + 3});
    apart.quad_faces.push_back(whole.quad_faces[q]);
  }
  std::vector<std::string> notes;
  std::set<int> used;
  for (const auto& triangle : cleaned(apart, 1e-6, notes).mesh.triangles)
    used.insert(triangle.begin(), triangle.end());
  EXPECT_EQ(used.size(), whole.points.size());
  EXPECT_EQ(notes.size(), 1u);
}

TEST(TriangleInput, TurnsWhatFacesTheOtherWay) {
  ShellMesh mesh = test::ShellGrid(4, 1, 0).mesh();
  for (const std::size_t q : {3u, 9u}) std::swap(mesh.quads[q][1], mesh.quads[q][3]);
  std::vector<std::string> notes;
  EXPECT_NEAR(area_of(cleaned(mesh, 0, notes).mesh).z(), 2, 1e-12);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(TriangleInput, NamesWhatItCannotTake) {
  const auto error_of = [](const ShellMesh& mesh) -> std::string {
    std::vector<std::string> notes;
    try {
      cleaned(mesh, 0, notes);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  ShellMesh mesh = test::ShellGrid(2, 1).mesh();
  EXPECT_EQ(error_of(mesh), "");
  ShellMesh endless = mesh;
  endless.points[4].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(endless).find("point 4"), std::string::npos) << error_of(endless);
  ShellMesh twice = mesh;
  twice.quads.push_back(twice.quads[0]);
  twice.quad_faces.push_back(1);
  EXPECT_NE(error_of(twice), "");
}

}  // namespace
}  // namespace quadrille
