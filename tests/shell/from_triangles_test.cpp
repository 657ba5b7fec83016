/// Meshes of triangles from anywhere made all-quad.

#include "mesher/shell/from_triangles.hpp"

#include <gtest/gtest.h>

#include "geometry/base/error.hpp"
#include "mesher/mesh/surface_cut.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/triangulations.hpp"

namespace quadrille {
namespace {

using namespace testing;

ShellMesh shell_of(const TriangleMesh& mesh) {
  ShellMesh shell;
  shell.points = mesh.points;
  shell.triangles = mesh.triangles;
  shell.triangle_faces = mesh.tags;
  if (mesh.tags.empty()) shell.triangle_faces.assign(mesh.triangles.size(), 0);
  return shell;
}

ShellMesh quads_of(const ShellMesh& input, const FromTrianglesOptions& options = {},
                   std::vector<std::string>* notes = nullptr) {
  ExecutionContext context;
  std::vector<std::string> own;
  return quads_from_triangles(input, options, notes != nullptr ? *notes : own, context);
}

/// The surface of a cube of side n, its squares cut at random; every triangle has points of its own, as in an
/// .stl file.
ShellMesh triangle_soup(int n) {
  ShellMesh shell;
  for (int side = 0; side < 6; ++side) {
    const TriangleMesh square = grid(n, n, side + 5);
    const auto place = [&](const Vector3& p) -> Vector3 {
      const double u = p.x(), v = p.y(), far = n;
      switch (side) {
        case 0:
          return {v, u, 0};
        case 1:
          return {u, v, far};
        case 2:
          return {u, 0, v};
        case 3:
          return {v, far, u};
        case 4:
          return {0, v, u};
        default:
          return {far, u, v};
      }
    };
    for (const auto& triangle : square.triangles) {
      const int first = static_cast<int>(shell.points.size());
      for (const int v : triangle) shell.points.push_back(place(square.points[v]));
      shell.triangles.push_back({first, first + 1, first + 2});
      shell.triangle_faces.push_back(0);
    }
  }
  return shell;
}

double volume(const ShellMesh& mesh) {
  double sum = 0;
  const auto& p = mesh.points;
  for (const auto& [a, b, c, d] : mesh.quads) sum += p[a].dot(p[b].cross(p[c])) + p[a].dot(p[c].cross(p[d]));
  for (const auto& [a, b, c] : mesh.triangles) sum += p[a].dot(p[b].cross(p[c]));
  return sum / 6;
}

TEST(FromTriangles, ABoxKeepsItsEdgesAndVolume) {
  FromTrianglesOptions options;
  options.merge = 0;
  std::vector<std::string> notes;
  const ShellMesh mesh = quads_of(triangle_soup(8), options, &notes);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_NEAR(volume(mesh), 512, 1e-9);
  EXPECT_EQ(std::set<int>(mesh.quad_faces.begin(), mesh.quad_faces.end()), (std::set<int>{1, 2, 3, 4, 5, 6}));
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto& p = mesh.points;
    EXPECT_GT(
        (p[b] - p[a]).cross(p[c] - p[a]).normalized().dot((p[c] - p[a]).cross(p[d] - p[a]).normalized()),
        1 - 1e-9);
  }
  EXPECT_EQ(notes.front(),
            "1918 nodes were merged with others");  // 2304 corners of 768 triangles, 386 places
  // As one smooth surface its edges go.
  options.feature_angle = 0;
  EXPECT_LT(volume(quads_of(triangle_soup(8), options)), 511);
}

TEST(FromTriangles, RefusesNodesOnOnePlaceUnlessTheyAreToBeMerged) {
  try {
    quads_of(triangle_soup(2));
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("are at the same position"), std::string::npos) << error.what();
  }
  ShellMesh shaken = triangle_soup(3);
  for (std::size_t i = 0; i < shaken.points.size(); ++i)
    shaken.points[i].x() += 1e-7 * static_cast<double>(i % 3);
  FromTrianglesOptions options;
  options.merge = 1e-5;
  EXPECT_NEAR(volume(quads_of(shaken, options)), 27, 1e-4);
}

TEST(FromTriangles, QuadsAmongTheTrianglesAreTaken) {
  ShellMesh input = shell_of(grid(9, 8, 3));
  // Some pairs back to quads: cells whose two triangles follow each other.
  for (int cell = 0; cell < 20; ++cell) {
    const auto [a, b, c] = input.triangles[4 * cell];
    const auto other = input.triangles[4 * cell + 1];
    const int d = b + 9 == c - 1 || other[0] == a ? other[2] : -1;
    if (d < 0) continue;
    input.quads.push_back({a, b, c, d});
    input.quad_faces.push_back(0);
    input.triangles[4 * cell] = input.triangles[4 * cell + 1] = {-1, -1, -1};
  }
  ASSERT_FALSE(input.quads.empty());
  std::erase_if(input.triangles, [](const auto& t) { return t[0] < 0; });
  input.triangle_faces.resize(input.triangles.size());
  const ShellMesh mesh = quads_of(input);
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_NEAR(area_vector(mesh.points, mesh.quads).z(), 72, 1e-9);
}

TEST(FromTriangles, TrianglesAreTurnedAndItIsSaid) {
  ShellMesh input = shell_of(random_square(500, 2));
  for (const std::size_t t : {3U, 30U}) std::swap(input.triangles[t][0], input.triangles[t][1]);
  std::vector<std::string> notes;
  const ShellMesh mesh = quads_of(input, {}, &notes);
  EXPECT_EQ(notes, std::vector<std::string>{"2 triangles were reversed to match their neighbors"});
  EXPECT_NEAR(area_vector(mesh.points, mesh.quads).z() + area_vector(mesh.points, mesh.triangles).z(), 1,
              1e-9);
}

/// Points; large meshes are put into another order.
class Sizes : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(FromTriangles, Sizes, ::testing::Values(900, 12000));

TEST_P(Sizes, SegmentsAndCornersInsideAFaceStay) {
  ShellMesh input = shell_of(random_square(GetParam(), 4));
  // A path of sides through the middle: from a point on to the one nearest to a line.
  std::vector<int> path;
  for (std::size_t t = 0; t < input.triangles.size() && path.empty(); ++t)
    if ((input.points[input.triangles[t][0]] - Vector3(0.5, 0.5, 0)).norm() < 0.05)
      path = {input.triangles[t][0], input.triangles[t][1]};
  ASSERT_EQ(path.size(), 2U);
  input.segments.push_back({{path[0], path[1]}, -1, 7});
  int alone = 0;
  for (int v = 0; v < GetParam(); ++v)
    if ((input.points[v] - Vector3(0.2, 0.7, 0)).norm() < (input.points[alone] - Vector3(0.2, 0.7, 0)).norm())
      alone = v;
  input.corners.push_back({alone, 3});
  const ShellMesh mesh = quads_of(input);
  ASSERT_EQ(mesh.segments.size(), 1U);
  EXPECT_EQ(mesh.segments[0].edge, 7);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(mesh.points[mesh.segments[0].nodes[i]], input.points[path[i]]);
  const auto has_side = [&](const auto& element) {
    for (std::size_t i = 0; i < element.size(); ++i) {
      const std::set<int> side{element[i], element[(i + 1) % element.size()]};
      if (side == std::set<int>{mesh.segments[0].nodes[0], mesh.segments[0].nodes[1]}) return true;
    }
    return false;
  };
  EXPECT_EQ(std::count_if(mesh.quads.begin(), mesh.quads.end(), has_side) +
                std::count_if(mesh.triangles.begin(), mesh.triangles.end(), has_side),
            2);
  ASSERT_EQ(mesh.corners.size(), 1U);
  EXPECT_EQ(mesh.points[mesh.corners[0].node], input.points[alone]);
  EXPECT_TRUE(validate(QuadMesh{mesh.points, mesh.quads, mesh.triangles, {}, {}}).empty());
}

TEST(FromTriangles, AGroupOfAllNodesOfAFaceFollowsItsQuads) {
  TriangleMesh two = random_square(700, 9);
  for (const auto& [a, b, c] : two.triangles)
    two.tags.push_back((two.points[a] + two.points[b] + two.points[c]).x() < 1.5 ? 1 : 2);
  ShellMesh input = shell_of(two);
  std::set<int> of_first;
  for (std::size_t t = 0; t < two.triangles.size(); ++t)
    if (two.tags[t] == 1) of_first.insert(two.triangles[t].begin(), two.triangles[t].end());
  for (const int v : of_first) input.corners.push_back({v, 1});
  input.groups = {{"left", 2, 4, {1}}, {"left nodes", 0, 0, {1}}};
  const ShellMesh mesh = quads_of(input);
  std::set<int> wanted, found;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    if (mesh.quad_faces[q] == 1) wanted.insert(mesh.quads[q].begin(), mesh.quads[q].end());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangle_faces[t] == 1) wanted.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].name, "left");
  for (const ShellMesh::Corner& corner : mesh.corners)
    if (std::count(mesh.groups[1].entities.begin(), mesh.groups[1].entities.end(), corner.vertex) > 0)
      found.insert(corner.node);
  EXPECT_EQ(found, wanted);
  // They moved: a group of nodes does not pin a face.
  std::set<std::array<double, 3>> places;
  for (const Vector3& p : two.points) places.insert({p.x(), p.y(), p.z()});
  const auto stayed = std::count_if(wanted.begin(), wanted.end(), [&](int v) {
    const Vector3& p = mesh.points[v];
    return places.count({p.x(), p.y(), p.z()}) > 0;
  });
  EXPECT_LT(stayed, static_cast<std::ptrdiff_t>(wanted.size()) / 3);
}

TEST(FromTriangles, SaysThatSecondOrderIsLost) {
  ShellMesh input;
  input.order = 2;
  input.points = {{0, 0, 0},   {1, 0, 0},   {1, 1, 0},   {0, 1, 0},
                  {0.5, 0, 0}, {1, 0.5, 0}, {0.5, 1, 0}, {0, 0.5, 0}};
  input.quads = {{0, 1, 2, 3}};
  input.midsides = {{4, 5, 6, 7}};
  input.quad_faces = {1};
  std::vector<std::string> notes;
  const ShellMesh mesh = quads_of(input, {}, &notes);
  EXPECT_EQ(mesh.order, 1);
  EXPECT_EQ(mesh.quads.size(), 1U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("second order"), std::string::npos);
}

}  // namespace
}  // namespace quadrille
