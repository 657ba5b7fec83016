/// Triangulated surfaces meshed anew with quads: what must hold of the result.

#include "mesher/remesh/remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "geometry/base/error.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/mesh/second_order.hpp"
#include "mesher/shell/validate.hpp"

namespace quadrille {
namespace {

ShellMesh surface_of(std::vector<Vector3> points, std::vector<std::array<int, 3>> triangles) {
  ShellMesh shell;
  shell.points = std::move(points);
  shell.triangles = std::move(triangles);
  shell.triangle_faces.assign(shell.triangles.size(), 0);
  return shell;
}

/// Inside a closed mesh.
double volume(const ShellMesh& mesh) {
  double sum = 0;
  for (const auto& quad : mesh.quads) {
    const Vector3 &a = mesh.points[quad[0]], &b = mesh.points[quad[1]], &c = mesh.points[quad[2]],
                  &d = mesh.points[quad[3]];
    sum += (a.dot(b.cross(c)) + a.dot(c.cross(d))) / 6;
  }
  return sum;
}

/// A box as .stl files have it: twelve triangles, each with points of its own.
ShellMesh box(const Vector3& size, const Vector3& at = Vector3::Zero()) {
  const std::array<std::array<int, 4>, 6> sides{
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  ShellMesh shell;
  const auto add = [&](int a, int b, int c) {
    const int first = static_cast<int>(shell.points.size());
    for (const int corner : {a, b, c})
      shell.points.push_back(
          at + Vector3((corner >> 2) * size.x(), (corner >> 1 & 1) * size.y(), (corner & 1) * size.z()));
    shell.triangles.push_back({first, first + 1, first + 2});
    shell.triangle_faces.push_back(0);
  };
  for (const auto& [a, b, c, d] : sides) {
    add(a, b, c);
    add(a, c, d);
  }
  return shell;
}

/// \param radius of the tube, by place; may be noisy.
ShellMesh torus(double far, int around, int across, const std::function<double()>& radius) {
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across, r = radius();
      points.emplace_back((far + r * std::cos(v)) * std::cos(u), (far + r * std::cos(v)) * std::sin(u),
                          r * std::sin(v));
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return surface_of(std::move(points), std::move(triangles));
}

/// A sphere without poles: the sides of a cube, blown up.
ShellMesh sphere(double radius, int n) {
  std::map<std::array<int, 3>, int> known;
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  const auto point = [&](std::array<int, 3> at) {
    const auto [found, is_new] = known.try_emplace(at, static_cast<int>(points.size()));
    if (is_new)
      points.push_back(radius * (Vector3(at[0], at[1], at[2]) * 2.0 / n - Vector3::Ones()).normalized());
    return found->second;
  };
  for (int side = 0; side < 6; ++side) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto corner = [&](int u, int v) {
          std::array<int, 3> at{};
          at[side / 2] = side % 2 * n;
          at[(side / 2 + 1) % 3] = side % 2 == 1 ? u : v;
          at[(side / 2 + 2) % 3] = side % 2 == 1 ? v : u;
          return point(at);
        };
        const int a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      }
    }
  }
  return surface_of(std::move(points), std::move(triangles));
}

/// A flat plate of 12 x 8 with a hexagonal hole of side 2, as few triangles as it takes.
ShellMesh plate_with_hole() {
  std::vector<Vector3> points{{-6, -4, 0}, {6, -4, 0}, {6, 4, 0}, {-6, 4, 0}};
  for (int k = 0; k < 6; ++k)
    points.emplace_back(2 * std::cos(k * std::numbers::pi / 3), 2 * std::sin(k * std::numbers::pi / 3), 0);
  return surface_of(std::move(points), {{1, 2, 4},
                                        {2, 5, 4},
                                        {2, 6, 5},
                                        {2, 3, 6},
                                        {3, 7, 6},
                                        {3, 0, 7},
                                        {0, 8, 7},
                                        {0, 9, 8},
                                        {0, 1, 9},
                                        {1, 4, 9}});
}

RemeshOptions with_size(double size) {
  RemeshOptions options;
  options.size = size;
  return options;
}

ShellMesh remeshed(const ShellMesh& input, const RemeshOptions& options, RemeshFidelity* fidelity = nullptr,
                   std::vector<std::string>* notes = nullptr, int threads = 0) {
  ExecutionContext context(threads);
  std::vector<std::string> own;
  return remesh(input, options, fidelity, notes != nullptr ? *notes : own, context);
}

/// Sides by how many quads have them.
std::map<std::pair<int, int>, int> sides_of(const ShellMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& quad : mesh.quads)
    for (int k = 0; k < 4; ++k) ++sides[std::minmax(quad[k], quad[(k + 1) % 4])];
  return sides;
}

/// All quads, none turned over, all run the same way round, each node used; the sides with one quad are
/// counted.
int check_and_count_rim(const ShellMesh& mesh) {
  EXPECT_TRUE(mesh.triangles.empty());
  EXPECT_FALSE(mesh.quads.empty());
  std::set<std::pair<int, int>> ways;
  for (const auto& [a, b, c, d] : mesh.quads) {
    const auto& p = mesh.points;
    EXPECT_GT(quad_scaled_jacobian(p[a], p[b], p[c], p[d]), 0);
    for (const auto& way : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
      EXPECT_TRUE(ways.insert(way).second);
  }
  EXPECT_EQ(validate(mesh), std::vector<std::string>());
  int rim = 0;
  for (const auto& [side, count] : sides_of(mesh)) rim += count == 1;
  return rim;
}

int euler_characteristic(const ShellMesh& mesh) {
  std::set<int> nodes;
  for (const auto& quad : mesh.quads) nodes.insert(quad.begin(), quad.end());
  return static_cast<int>(nodes.size()) - static_cast<int>(sides_of(mesh).size()) +
         static_cast<int>(mesh.quads.size());
}

TEST(Remesh, ABoxKeepsItsVolumeEdgesAndCorners) {
  RemeshOptions options = with_size(1);
  options.merge = 0;
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(box({10, 6, 4}), options, &fidelity);
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_NEAR(volume(mesh), 240, 1e-9);
  EXPECT_NEAR(fidelity.mesh_area, 248, 1e-9);
  EXPECT_LT(fidelity.of_mesh.length, 1e-12);
  EXPECT_LT(fidelity.of_surface.length, 1e-12);
  EXPECT_EQ(mesh.corners.size(), 8u);
  EXPECT_EQ(mesh.faces.size(), 6u);
  EXPECT_NEAR(static_cast<double>(mesh.quads.size()), 248, 0.2 * 248);
  std::map<int, std::set<int>> nodes_of_edge;
  std::map<int, double> length_of_edge;
  for (const ShellMesh::Segment& segment : mesh.segments) {
    nodes_of_edge[segment.edge].insert({segment.nodes[0], segment.nodes[1]});
    length_of_edge[segment.edge] += (mesh.points[segment.nodes[0]] - mesh.points[segment.nodes[1]]).norm();
  }
  ASSERT_EQ(nodes_of_edge.size(), 12u);
  double total = 0;
  for (const auto& [edge, nodes] : nodes_of_edge) {
    int constant = 0;  // coordinates
    const Vector3& first = mesh.points[*nodes.begin()];
    for (int k = 0; k < 3; ++k)
      constant +=
          std::all_of(nodes.begin(), nodes.end(), [&](int v) { return mesh.points[v][k] == first[k]; });
    EXPECT_EQ(constant, 2) << "Edge" << edge;
    total += length_of_edge[edge];
  }
  EXPECT_NEAR(total, 80, 1e-9);
  // Each face is flat, and of one side of the box.
  for (const ShellMesh::Face& face : mesh.faces) {
    EXPECT_EQ(face.status, FaceStatus::meshed);
    std::set<int> nodes;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q)
      if (mesh.quad_faces[q] == face.face) nodes.insert(mesh.quads[q].begin(), mesh.quads[q].end());
    int constant = 0;
    for (int k = 0; k < 3; ++k)
      constant += std::all_of(nodes.begin(), nodes.end(), [&](int v) {
        return std::abs(mesh.points[v][k] - mesh.points[*nodes.begin()][k]) < 1e-12;
      });
    EXPECT_EQ(constant, 1) << "Face" << face.face;
  }
}

TEST(Remesh, ASpheresErrorFallsWithTheSquareOfTheSize) {
  const ShellMesh input = sphere(10, 60);
  double before = 0;
  for (const double size : {2.0, 1.0}) {
    RemeshFidelity fidelity;
    const ShellMesh mesh = remeshed(input, with_size(size), &fidelity);
    EXPECT_EQ(check_and_count_rim(mesh), 0);
    EXPECT_EQ(euler_characteristic(mesh), 2);
    for (const Vector3& p : mesh.points) EXPECT_NEAR(p.norm(), 10, 0.02);  // the facets are as far inside
    const double lost = 1 - fidelity.mesh_area / fidelity.surface_area;
    EXPECT_GT(lost, 0);
    EXPECT_LT(lost, 0.6 * size * size / 100);
    EXPECT_LT(fidelity.of_mesh.length, size * size / 12);  // long quads have twice the sagitta
    EXPECT_GT(quality(mesh).q_mean, 0.85);
    EXPECT_NEAR(static_cast<double>(mesh.quads.size()), fidelity.surface_area / (size * size),
                0.15 * fidelity.surface_area / (size * size));
    if (before > 0) {
      EXPECT_LT(lost, 0.4 * before);
    }
    before = lost;
  }
}

TEST(Remesh, ANoisyScanOfATorusStaysATorus) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(3, 0.02);
  const ShellMesh mesh = remeshed(torus(10, 160, 60, [&] { return noise(random); }), with_size(0.8));
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_EQ(mesh.faces.size(), 1u);
  EXPECT_TRUE(mesh.segments.empty());
  EXPECT_GT(quality(mesh).q_min, 0.3);
}

TEST(Remesh, SizesBeyondASmoothSurfaceGiveSmallerElements) {
  const ShellMesh mesh = remeshed(torus(10, 80, 30, [] { return 1.0; }), with_size(6));
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  EXPECT_EQ(euler_characteristic(mesh), 0);
}

/// A can of radius 5, 12 high, with n triangles along each rim and n strips of two from rim to rim.
ShellMesh can(int n) {
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    for (const double z : {0.0, 12.0}) points.emplace_back(5 * std::cos(angle), 5 * std::sin(angle), z);
    const int a = 2 * k, b = 2 * ((k + 1) % n);
    triangles.insert(triangles.end(),
                     {{a, b, b + 1}, {a, b + 1, a + 1}, {b, a, 2 * n}, {a + 1, b + 1, 2 * n + 1}});
  }
  points.emplace_back(0, 0, 0);
  points.emplace_back(0, 0, 12);
  return surface_of(std::move(points), std::move(triangles));
}

TEST(Remesh, MidsideNodesLieOnNarrowTrianglesToo) {
  constexpr int n = 300;
  RemeshOptions options = with_size(1.9);
  options.order = 2;
  std::vector<std::string> notes;
  const ShellMesh mesh = remeshed(can(n), options, nullptr, &notes);
  EXPECT_TRUE(mesh.off_geometry.empty());
  EXPECT_EQ(notes, std::vector<std::string>());
  const double sagitta = 5 * (1 - std::cos(std::numbers::pi / n)) + 1e-9;
  for (const auto& midsides : mesh.midsides) {
    for (const int node : midsides) {
      const Vector3& p = mesh.points[node];
      if (p.z() < 1e-9 || p.z() > 12 - 1e-9) continue;
      EXPECT_NEAR(p.head<2>().norm(), 5, sagitta);
    }
  }
  // In the middles of their sides, not anywhere else on the surface.
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    for (int k = 0; k < 4; ++k) {
      const Vector3 &a = mesh.points[mesh.quads[q][k]], &b = mesh.points[mesh.quads[q][(k + 1) % 4]];
      const Vector3& m = mesh.points[mesh.midsides[q][k]];
      EXPECT_LT(std::abs((m - a).norm() - (m - b).norm()), 0.1 * (a - b).norm());
    }
  }
}

TEST(Remesh, ACanKeepsItsRoundRims) {
  // The triangles along the rims are far shorter than the elements.
  constexpr int n = 120;
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(can(n), with_size(1.2), &fidelity);
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_EQ(mesh.faces.size(), 3u);
  EXPECT_TRUE(mesh.corners.empty());
  std::map<int, int> segments;
  for (const ShellMesh::Segment& segment : mesh.segments) {
    ++segments[segment.edge];
    const Vector3 &a = mesh.points[segment.nodes[0]], &b = mesh.points[segment.nodes[1]];
    EXPECT_EQ(a.z(), b.z());
    EXPECT_NEAR(a.head<2>().norm(), 5, 5 * (1 - std::cos(std::numbers::pi / n)) + 1e-9);
    EXPECT_NEAR((a - b).norm(), 10 * std::numbers::pi / 28, 0.1);
  }
  ASSERT_EQ(segments.size(), 2u);
  for (const auto& [edge, count] : segments) EXPECT_EQ(count, 28) << "Edge" << edge;
  const double whole = 12 * 0.5 * n * 25 * std::sin(2 * std::numbers::pi / n);
  EXPECT_NEAR(volume(mesh), whole, 0.02 * whole);
}

TEST(Remesh, AnOpenPlateKeepsItsRims) {
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(plate_with_hole(), with_size(0.7), &fidelity);
  const double area = 96 - 6 * std::sqrt(3.0);
  EXPECT_NEAR(fidelity.surface_area, area, 1e-12);
  EXPECT_NEAR(fidelity.mesh_area, area, 1e-9);
  EXPECT_EQ(euler_characteristic(mesh), 0);
  const int rim = check_and_count_rim(mesh);
  EXPECT_EQ(rim, static_cast<int>(mesh.segments.size()));
  EXPECT_EQ(mesh.corners.size(), 10u);
  const auto sides = sides_of(mesh);
  for (const ShellMesh::Segment& segment : mesh.segments)
    EXPECT_EQ(sides.at(std::minmax(segment.nodes[0], segment.nodes[1])), 1);
}

TEST(Remesh, BodiesStayApartAndTouchingCornersTogether) {
  ShellMesh both = box({4, 4, 4});
  const auto append = [&](const ShellMesh& other) {
    const int first = static_cast<int>(both.points.size());
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (auto triangle : other.triangles) {
      for (int& v : triangle) v += first;
      both.triangles.push_back(triangle);
      both.triangle_faces.push_back(0);
    }
  };
  append(box({2, 2, 2}, {4, 4, 4}));  // at a corner
  append(box({3, 3, 3}, {10, 0, 0}));
  RemeshOptions options = with_size(1);
  options.merge = 0;
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(both, options, &fidelity);
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  EXPECT_NEAR(volume(mesh), 64 + 8 + 27, 1e-9);
  EXPECT_EQ(mesh.faces.size(), 18u);
  EXPECT_EQ(euler_characteristic(mesh), 2 + 2 + 2 - 1);
  const auto at_touch = std::count_if(mesh.points.begin(), mesh.points.end(),
                                      [](const Vector3& p) { return (p - Vector3(4, 4, 4)).norm() < 1e-9; });
  EXPECT_EQ(at_touch, 1);
}

TEST(Remesh, FoldsMakeFacesFromTheAngleOn) {
  // A roof: two rectangles that meet at 20 degrees.
  const double slope = std::tan(10 * std::numbers::pi / 180);
  const ShellMesh roof = surface_of({{-5, 0, -5 * slope},
                                     {0, 0, 0},
                                     {5, 0, -5 * slope},
                                     {-5, 8, -5 * slope},
                                     {0, 8, 0},
                                     {5, 8, -5 * slope}},
                                    {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  RemeshOptions options = with_size(1);
  EXPECT_EQ(remeshed(roof, options).faces.size(), 1u);
  options.feature_angle = 15;
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(roof, options, &fidelity);
  EXPECT_EQ(mesh.faces.size(), 2u);
  EXPECT_NEAR(fidelity.mesh_area, fidelity.surface_area, 1e-9);
  int ridge = 0;
  for (const ShellMesh::Segment& segment : mesh.segments)
    ridge +=
        std::abs(mesh.points[segment.nodes[0]].x()) + std::abs(mesh.points[segment.nodes[1]].x()) < 1e-12;
  EXPECT_GE(ridge, 6);
}

TEST(Remesh, FacesEdgesAndGroupsOfTheInputStay) {
  // A flat square of two faces that no fold tells apart, with a named edge between.
  ShellMesh input = surface_of({{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {0, 6, 0}, {4, 6, 0}, {8, 6, 0}},
                               {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
  input.triangle_faces = {7, 7, 3, 3};
  input.segments = {{{1, 4}, -1, 9}};
  input.groups = {{"left", 2, 5, {7}}, {"seam", 1, 0, {9}}, {"nodes", 0, 0, {1}}};
  std::vector<std::string> notes;
  const ShellMesh mesh = remeshed(input, with_size(1), nullptr, &notes);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    double middle = 0;
    for (const int v : mesh.quads[q]) middle += 0.25 * mesh.points[v].x();
    EXPECT_EQ(mesh.quad_faces[q], middle < 4 ? 7 : 3);
  }
  for (const ShellMesh::Segment& segment : mesh.segments) {
    const bool on_seam =
        std::abs(mesh.points[segment.nodes[0]].x() - 4) + std::abs(mesh.points[segment.nodes[1]].x() - 4) <
        1e-12;
    EXPECT_EQ(segment.edge == 9, on_seam);
  }
  ASSERT_GE(mesh.groups.size(), 2u);
  EXPECT_EQ(mesh.groups[0].name, "left");
  EXPECT_EQ(mesh.groups[0].number, 5);
  EXPECT_EQ(mesh.groups[0].entities, std::vector<int>{7});
  EXPECT_EQ(mesh.groups[1].name, "seam");
  EXPECT_EQ(mesh.groups[1].entities, std::vector<int>{9});
  EXPECT_TRUE(
      std::any_of(mesh.groups.begin(), mesh.groups.end(), [](const auto& g) { return g.name == "Face3"; }));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("nodes"), std::string::npos);
}

TEST(Remesh, QuadsOfTheInputAreTaken) {
  ShellMesh input;
  input.points = {{0, 0, 0}, {5, 0, 0}, {5, 5, 0}, {0, 5, 0}, {10, 0, 0}, {10, 5, 0}};
  input.quads = {{0, 1, 2, 3}};
  input.quad_faces = {0};
  input.triangles = {{1, 4, 5}, {1, 5, 2}};
  input.triangle_faces = {0, 0};
  RemeshFidelity fidelity;
  const ShellMesh mesh = remeshed(input, with_size(1), &fidelity);
  check_and_count_rim(mesh);
  EXPECT_NEAR(fidelity.mesh_area, 50, 1e-9);
}

TEST(Remesh, MidsideNodesLieOnTheSurfaceAndNothingFolds) {
  RemeshOptions options = with_size(2);
  options.order = 2;
  RemeshFidelity first, second;
  const ShellMesh input = sphere(10, 60);
  remeshed(input, with_size(2), &first);
  const ShellMesh mesh = remeshed(input, options, &second);
  ASSERT_EQ(mesh.order, 2);
  ASSERT_EQ(mesh.midsides.size(), mesh.quads.size());
  EXPECT_TRUE(mesh.off_geometry.empty());
  EXPECT_EQ(check_and_count_rim(mesh), 0);
  std::map<int, std::pair<int, int>> side_of;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    EXPECT_FALSE(folds(curved_quad(mesh, q)));
    for (int k = 0; k < 4; ++k) {
      const int node = mesh.midsides[q][k];
      EXPECT_NEAR(mesh.points[node].norm(), 10, 0.02);
      const std::pair<int, int> side = std::minmax(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4]);
      EXPECT_EQ(side_of.try_emplace(node, side).first->second, side);
    }
  }
  EXPECT_LT(second.of_mesh.length, 0.5 * first.of_mesh.length);
}

TEST(Remesh, DoesNotDependOnTheThreadCount) {
  RemeshOptions options = with_size(0.5);
  options.merge = 0;
  const ShellMesh one = remeshed(box({6, 5, 4}), options, nullptr, nullptr, 1);
  const ShellMesh four = remeshed(box({6, 5, 4}), options, nullptr, nullptr, 4);
  EXPECT_EQ(one.points, four.points);
  EXPECT_EQ(one.quads, four.quads);
  EXPECT_EQ(one.quad_faces, four.quad_faces);
}

void expect_error(const ShellMesh& input, const RemeshOptions& options, Error::Kind kind,
                  const std::string& says) {
  try {
    remeshed(input, options);
    ADD_FAILURE() << "nothing was refused: " << says;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(Remesh, RefusesWhatIsNoSurface) {
  const RemeshOptions options = with_size(1);
  const std::vector<Vector3> points{{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}, {0, -5, -5}, {5, 5, 5}};
  using Kind = Error::Kind;
  expect_error(surface_of({}, {}), options, Kind::failure, "no triangle is left");
  expect_error(surface_of(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), options, Kind::failure,
               "3 triangles meet at the side from (0, 0, 0) to (5, 0, 0)");
  expect_error(surface_of(points, {{0, 1, 2}, {0, 2, 1}}), options, Kind::failure, "same corners");
  ShellMesh soup = box({4, 4, 4});
  for (std::size_t v = 0; v < soup.points.size(); ++v) soup.points[v].x() += 1e-6 * static_cast<double>(v);
  expect_error(soup, options, Kind::failure, "none of the 12 triangles shares a side with another: `merge`");
  expect_error(surface_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}), options, Kind::failure,
               "has no area");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error(surface_of({{0, 0, 0}, {1, 0, 0}, {nan, 1, 0}}, {{0, 1, 2}}), options, Kind::failure,
               "no finite position");
  expect_error(box({1, 1, 1}), with_size(0.2), Kind::failure, "are at the same position");
  const ShellMesh strip = surface_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 1}},
                                     {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 0}, {4, 0, 1}});
  expect_error(strip, with_size(0.5), Kind::failure, "one-sided");
}

TEST(Remesh, RefusesSizesThatMakeNoSenseBeforeItBegins) {
  const ShellMesh input = plate_with_hole();
  using Kind = Error::Kind;
  expect_error(input, with_size(0), Kind::usage, "`size` must be a positive number");
  expect_error(input, with_size(std::numeric_limits<double>::infinity()), Kind::usage,
               "`size` must be a positive number");
  expect_error(input, with_size(100), Kind::usage, "larger than the surface");
  expect_error(input, with_size(1e-5), Kind::usage, "million elements");
  RemeshOptions options = with_size(1);
  options.order = 3;
  expect_error(input, options, Kind::usage, "`order` must be 1 or 2");
  options = with_size(1);
  options.feature_angle = 200;
  expect_error(input, options, Kind::usage, "feature angle");
}

/// Bodies without curves get elements as small as they are thick, but not far below the size: a foil of which
/// no edge is kept is refused before it takes long.
TEST(Remesh, RefusesFoilsWhoseEdgesAreSuppressed) {
  RemeshOptions options = with_size(40);
  options.feature_angle = 0;
  options.merge = 0;
  expect_error(box({100, 100, 1e-3}), options, Error::Kind::failure, "stay inverted");
}

TEST(Remesh, NeedlesAskForNoSizesAsSmall) {
  // A box with a needle along each rim of its top: rims a billionth long at the ends.
  constexpr double width = 1e-9;
  ShellMesh needles = box({3, 3, 3});
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const int first = static_cast<int>(needles.points.size());
    needles.points.insert(needles.points.end(), {a, b, c});
    needles.triangles.push_back({first, first + 1, first + 2});
    needles.triangle_faces.push_back(0);
  };
  for (Vector3& p : needles.points)
    if (p.z() > 0) p.z() -= width;
  const std::array<Vector3, 4> low{Vector3(0, 0, 3 - width), Vector3(3, 0, 3 - width),
                                   Vector3(3, 3, 3 - width), Vector3(0, 3, 3 - width)};
  // The lid is lifted, and the slit closed by needles.
  std::erase_if(needles.triangles, [&](const std::array<int, 3>& t) {
    return needles.points[t[0]].z() > 2 && needles.points[t[1]].z() > 2 && needles.points[t[2]].z() > 2;
  });
  needles.triangle_faces.resize(needles.triangles.size());
  const auto high = [&](int k) { return Vector3(low[k].x(), low[k].y(), 3); };
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    add(low[k], low[next], high(next));
    add(low[k], high(next), high(k));
  }
  add(high(0), high(1), high(2));
  add(high(0), high(2), high(3));
  RemeshOptions options = with_size(1);
  options.merge = 0;
  ExecutionContext context(1);
  context.limit_time(20);
  std::vector<std::string> notes;
  const ShellMesh mesh = remesh(needles, options, nullptr, notes, context);
  EXPECT_LT(mesh.quads.size(), 300U);
  EXPECT_EQ(quality(mesh).inverted, 0);
}

TEST(Remesh, CanBeCancelledAndLimited) {
  const ShellMesh input = sphere(10, 40);
  for (const int stop_at : {2, 6, 12}) {
    int asked = 0;
    ExecutionContext context(0, [&](std::string_view, double) { return ++asked < stop_at; });
    context.ask_every(std::chrono::milliseconds(0));
    std::vector<std::string> notes;
    EXPECT_THROW(remesh(input, with_size(0.3), nullptr, notes, context), Error) << stop_at;
  }
  ExecutionContext context;
  context.limit_time(0.01);
  std::vector<std::string> notes;
  EXPECT_THROW(remesh(input, with_size(0.1), nullptr, notes, context), Error);
}

}  // namespace
}  // namespace quadrille
