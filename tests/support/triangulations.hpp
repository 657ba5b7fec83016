#pragma once
/// Triangulations to recombine: random ones, the awkward ones, closed surfaces; and what must hold of the
/// quads.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::testing {

using Triangles = std::vector<std::array<int, 3>>;

/// Drops the points that no triangle uses.
inline TriangleMesh compact(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::vector<int> index(mesh.points.size(), -1);
  for (auto triangle : mesh.triangles) {
    for (int& v : triangle) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(result.points.size());
        result.points.push_back(mesh.points[v]);
      }
      v = index[v];
    }
    result.triangles.push_back(triangle);
  }
  result.tags = mesh.tags;
  return result;
}

/// The triangles for which keep(index, center) holds.
template <class Keep>
TriangleMesh keep_triangles(const TriangleMesh& mesh, Keep&& keep) {
  TriangleMesh result;
  result.points = mesh.points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3 center = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    if (!keep(static_cast<int>(t), center)) continue;
    result.triangles.push_back(mesh.triangles[t]);
    if (!mesh.tags.empty()) result.tags.push_back(mesh.tags[t]);
  }
  return compact(result);
}

/// Delaunay triangulation of points in the plane z = 0, in the order of the points.
inline TriangleMesh delaunay(const std::vector<Vector3>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  std::vector<std::pair<Kernel::Point_2, int>> sites;
  sites.reserve(points.size());
  for (const Vector3& p : points)
    sites.emplace_back(Kernel::Point_2(p.x(), p.y()), static_cast<int>(sites.size()));
  const Delaunay triangulation(sites.begin(), sites.end());
  TriangleMesh mesh;
  mesh.points = points;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    mesh.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return mesh;
}

/// Random points in the unit square with its corners: white noise, so slivers and all.
inline TriangleMesh random_square(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vector3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  while (static_cast<int>(points.size()) < count)
    points.emplace_back(uniform(generator), uniform(generator), 0);
  return delaunay(points);
}

/// The same with round holes cut along the edges: rough boundaries, points where two holes touch, islands.
inline TriangleMesh random_with_holes(int count, int holes, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vector3> centers;
  centers.reserve(holes);
  for (int k = 0; k < holes; ++k)
    centers.emplace_back(uniform(generator), uniform(generator), 0.25 * uniform(generator));
  return keep_triangles(random_square(count, seed + 1), [&](int, const Vector3& p) {
    return std::all_of(centers.begin(), centers.end(),
                       [&](const Vector3& c) { return std::hypot(p.x() - c.x(), p.y() - c.y()) > c.z(); });
  });
}

/// A triangulation of which a share of the triangles, taken at random, is missing.
inline TriangleMesh perforated(const TriangleMesh& mesh, double missing, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  return keep_triangles(mesh, [&](int, const Vector3&) { return uniform(generator) >= missing; });
}

/// n triangles in a row between two lines.
inline TriangleMesh strip(int n) {
  TriangleMesh mesh;
  for (int k = 0; k < n + 2; ++k) mesh.points.emplace_back(0.5 * k, k % 2, 0);
  for (int k = 0; k < n; ++k) {
    if (k % 2 == 0) {
      mesh.triangles.push_back({k, k + 2, k + 1});
    } else {
      mesh.triangles.push_back({k, k + 1, k + 2});
    }
  }
  return mesh;
}

/// A ring one triangle wide, of 2 n triangles.
inline TriangleMesh band(int n) {
  TriangleMesh mesh;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.points.emplace_back(1.3 * std::cos(angle), 1.3 * std::sin(angle), 0);
  }
  for (int k = 0; k < n; ++k) {
    const int a = 2 * k, b = 2 * k + 1, c = 2 * ((k + 1) % n), d = c + 1;
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({a, d, c});
  }
  return mesh;
}

/// n triangles around a point, all round or not.
inline TriangleMesh fan(int n, bool closed) {
  TriangleMesh mesh;
  mesh.points.emplace_back(0, 0, 0);
  const int rim = closed ? n : n + 1;
  for (int k = 0; k < rim; ++k) {
    const double angle = (closed ? 2 : 1) * std::numbers::pi * k / n;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (int k = 0; k < n; ++k) mesh.triangles.push_back({0, 1 + k, 1 + (k + 1) % rim});
  return mesh;
}

/// A mesh with one more triangle on each boundary side: an ear.
inline TriangleMesh with_ears(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++sides[{t[i], t[(i + 1) % 3]}];
  }
  TriangleMesh result = mesh;
  for (const auto& [side, count] : sides) {
    const auto [a, b] = side;
    if (sides.count({b, a})) continue;
    const Vector3 along = mesh.points[b] - mesh.points[a];
    result.points.push_back((mesh.points[a] + mesh.points[b]) / 2 + 0.2 * Vector3(along.y(), -along.x(), 0));
    result.triangles.push_back({b, a, static_cast<int>(result.points.size()) - 1});
    if (!mesh.tags.empty()) result.tags.push_back(mesh.tags.front());
  }
  return result;
}

/// A grid of n x m cells, each cut along a diagonal that is random or the same throughout.
inline TriangleMesh grid(int n, int m, unsigned seed = 0) {
  std::mt19937 generator(seed);
  TriangleMesh mesh;
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back(i, j, 0);
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      if (seed != 0 && generator() % 2) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

/// The icosahedron, each triangle cut into four `level` times.
inline TriangleMesh icosphere(int level) {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (; level > 0; --level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
      if (fresh) mesh.points.push_back((mesh.points[a] + mesh.points[b]) / 2);
      return place->second;
    };
    Triangles finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Vector3& p : mesh.points) p.normalize();
  return mesh;
}

/// A torus of n x m cells, diagonals at random.
inline TriangleMesh torus(int n, int m, unsigned seed) {
  std::mt19937 generator(seed);
  TriangleMesh mesh;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      mesh.points.emplace_back((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * n + i, b = j * n + (i + 1) % n, d = (j + 1) % m * n + i,
                c = (j + 1) % m * n + (i + 1) % n;
      if (generator() % 2) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

/// Two tori, each without one triangle, joined by a tube of six triangles at the wound.
inline TriangleMesh double_torus(int n, int m, unsigned seed) {
  TriangleMesh mesh = torus(n, m, seed);
  const TriangleMesh other = torus(n, m, seed + 1);
  const int offset = static_cast<int>(mesh.points.size());
  const std::array<int, 3> wound = mesh.triangles.back();
  mesh.triangles.pop_back();
  for (const Vector3& p : other.points) mesh.points.emplace_back(p + Vector3(9, 0, 0));
  for (std::size_t t = 0; t + 1 < other.triangles.size(); ++t) {
    const auto& [a, b, c] = other.triangles[t];
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  std::array<int, 3> facing = other.triangles.back();
  std::reverse(facing.begin(), facing.end());
  for (int i = 0; i < 3; ++i) {
    const int a = wound[i], b = wound[(i + 1) % 3], p = facing[i] + offset, q = facing[(i + 1) % 3] + offset;
    mesh.triangles.push_back({a, b, q});
    mesh.triangles.push_back({a, q, p});
  }
  return mesh;
}

/// How many connected pieces (by sides, of one tag) have an odd number of triangles.
inline int odd_pieces(const TriangleMesh& mesh) {
  std::map<std::array<int, 3>, int> owner;
  std::vector<int> parent(mesh.triangles.size()), size(mesh.triangles.size(), 1);
  for (std::size_t t = 0; t < parent.size(); ++t) parent[t] = static_cast<int>(t);
  const std::function<int(int)> root = [&](int t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (std::size_t t = 0; t < parent.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      const int a = triangle[i], b = triangle[(i + 1) % 3], tag = mesh.tags.empty() ? 0 : mesh.tags[t];
      const auto [place, fresh] =
          owner.try_emplace({std::min(a, b), std::max(a, b), tag}, static_cast<int>(t));
      if (fresh) continue;
      const int one = root(static_cast<int>(t)), two = root(place->second);
      if (one == two) continue;
      parent[one] = two;
      size[two] += size[one];
    }
  }
  int odd = 0;
  for (std::size_t t = 0; t < parent.size(); ++t) odd += parent[t] == static_cast<int>(t) && size[t] % 2;
  return odd;
}

/// Directed sides with their tag, and how often they come: +1 for each, -1 for each taken the other way.
template <class Element>
void add_sides(const std::vector<Element>& elements, const std::vector<int>& tags,
               std::map<std::array<int, 3>, int>& sides) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& corners = elements[e];
    const int tag = tags.empty() ? 0 : tags[e];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      sides[{std::min(a, b), std::max(a, b), tag}] += a < b ? 1 : -1;
    }
  }
  std::erase_if(sides, [](const auto& side) { return side.second == 0; });
}

template <class Element>
Vector3 area_vector(const std::vector<Vector3>& points, const std::vector<Element>& elements) {
  Vector3 sum = Vector3::Zero();
  for (const auto& corners : elements) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      sum += (points[corners[i - 1]] - points[corners[0]]).cross(points[corners[i]] - points[corners[0]]) / 2;
    }
  }
  return sum;
}

/// What is wrong with the quads made of a triangulation: one sentence, empty if nothing is.
inline std::string faults(const TriangleMesh& mesh, const QuadMesh& quads) {
  const int odd = odd_pieces(mesh);
  if (static_cast<int>(quads.triangles.size()) != odd) {
    return fmt::format("{} triangles are left, but {} pieces are odd", quads.triangles.size(), odd);
  }
  if (2 * quads.quads.size() + quads.triangles.size() != mesh.triangles.size()) {
    return fmt::format("{} triangles became {} quads", mesh.triangles.size(), quads.quads.size());
  }
  if (quads.points != mesh.points) return "the points have changed";
  if (!mesh.tags.empty() && (quads.quad_tags.size() != quads.quads.size() ||
                             quads.triangle_tags.size() != quads.triangles.size())) {
    return "tags are missing";
  }
  for (const auto& quad : quads.quads) {
    if (std::set<int>(quad.begin(), quad.end()).size() != 4) {
      return fmt::format("the quad {} {} {} {} has a point twice", quad[0], quad[1], quad[2], quad[3]);
    }
  }
  // Inner sides cancel where the elements are oriented alike: what stays is the boundary, with its direction.
  std::map<std::array<int, 3>, int> before, after;
  add_sides(mesh.triangles, mesh.tags, before);
  add_sides(quads.quads, quads.quad_tags, after);
  add_sides(quads.triangles, quads.triangle_tags, after);
  if (before != after) return "the boundary has changed";
  const Vector3 area = area_vector(mesh.points, mesh.triangles);
  const Vector3 covered = area_vector(quads.points, quads.quads) + area_vector(quads.points, quads.triangles);
  if ((area - covered).norm() > 1e-9 * (1 + area.norm()))
    return fmt::format("the area went from {} to {}", area.norm(), covered.norm());
  return "";
}

/// A smaller mesh for which `fails` still holds: triangles are dropped in ever smaller groups.
inline TriangleMesh shrink(TriangleMesh mesh, const std::function<bool(const TriangleMesh&)>& fails) {
  for (std::size_t group = mesh.triangles.size() / 2; group >= 1; group /= 2) {
    for (std::size_t first = 0; first < mesh.triangles.size();) {
      const TriangleMesh smaller = keep_triangles(mesh, [&](int t, const Vector3&) {
        return static_cast<std::size_t>(t) < first || static_cast<std::size_t>(t) >= first + group;
      });
      if (!smaller.triangles.empty() && fails(smaller)) {
        mesh = smaller;
      } else {
        first += group;
      }
    }
  }
  return mesh;
}

/// The triangles as a C++ initializer, for a failing case to be kept as a test.
inline std::string describe(const TriangleMesh& mesh) {
  std::string text;
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("{{{}, {}, {}}}, ", a, b, c);
  return text;
}

}  // namespace quadrille::testing
