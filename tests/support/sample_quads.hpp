#pragma once
/// Quad meshes to test improvement on: jittered points, Delaunay by flips, triangles paired. Deterministic
/// for the seed.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/improve.hpp"

namespace quadrille::sample {

using Triangle = std::array<int, 3>;

/// A planar triangulation with its boundary nodes.
struct Triangulation {
  std::vector<Vector2> points;
  std::vector<Triangle> triangles;
  std::vector<char> boundary;
};

/// A grid of columns x rows cells, the odd rows shifted; `wrap` joins the last column to the first.
inline Triangulation lattice(int columns, int rows, bool wrap) {
  Triangulation result;
  const int stride = wrap ? columns : columns + 1;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < stride; ++i) {
      const bool border = j == 0 || j == rows || (!wrap && (i == 0 || i == columns));
      const double shift = wrap ? 0.5 * (j & 1) : (border ? 0.0 : 0.5 * (j & 1) - 0.25);
      result.points.push_back({(i + shift) / columns, static_cast<double>(j) / rows});
      result.boundary.push_back(border);
    }
  const auto at = [&](int i, int j) { return j * stride + (wrap ? i % columns : i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (j & 1) {
        result.triangles.push_back({a, b, c});
        result.triangles.push_back({a, c, d});
      } else {
        result.triangles.push_back({a, b, d});
        result.triangles.push_back({b, c, d});
      }
    }
  return result;
}

inline double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
inline double area(const Vector2& a, const Vector2& b, const Vector2& c) {
  return 0.5 * cross(b - a, c - a);
}

/// Flips sides until each meets the Delaunay criterion (Lawson).
inline void make_delaunay(Triangulation& mesh) {
  const auto& p = mesh.points;
  for (int pass = 0; pass < 100; ++pass) {
    std::map<std::pair<int, int>, int> owner;  // directed side -> triangle
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for (int k = 0; k < 3; ++k) owner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
    std::vector<char> touched(mesh.triangles.size(), 0);
    int flips = 0;
    for (const auto& [side, t] : owner) {
      const int a = side.first, b = side.second;
      const auto other = owner.find({b, a});
      if (other == owner.end() || a > b) continue;
      const int s = other->second;
      if (touched[t] || touched[s]) continue;
      const auto apex = [&](int triangle) {
        for (const int node : mesh.triangles[triangle])
          if (node != a && node != b) return node;
        return -1;
      };
      const int c = apex(t), d = apex(s);
      const auto cotangent = [&](int at) {
        return (p[a] - p[at]).dot(p[b] - p[at]) / std::abs(cross(p[a] - p[at], p[b] - p[at]));
      };
      if (cotangent(c) + cotangent(d) > -1e-9) continue;
      if (area(p[c], p[a], p[d]) <= 1e-12 || area(p[d], p[b], p[c]) <= 1e-12) continue;
      mesh.triangles[t] = {c, a, d};
      mesh.triangles[s] = {d, b, c};
      touched[t] = touched[s] = 1;
      ++flips;
    }
    if (flips == 0) return;
  }
}

/// Moves the inner points of a triangulation by a random share of the spacing, then makes it Delaunay.
inline void jitter(Triangulation& mesh, double spacing_x, double spacing_y, double share,
                   std::uint32_t seed) {
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double dx = static_cast<double>(random()) / 4294967296.0 - 0.5;
    const double dy = static_cast<double>(random()) / 4294967296.0 - 0.5;
    if (!mesh.boundary[i]) mesh.points[i] += Vector2(2 * share * spacing_x * dx, 2 * share * spacing_y * dy);
  }
}

/// The surface mesh of the paired triangles, with points placed by `place` from the plane of the
/// triangulation.
inline SurfaceMesh surface_mesh(const Triangulation& flat,
                                const std::function<void(const Vector2&, Vector3&, Vector3&)>& place) {
  SurfaceMesh result;
  std::vector<Vector3> points(flat.points.size());
  result.normals.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) place(flat.points[i], points[i], result.normals[i]);
  TriangleMesh triangles;
  triangles.points = std::move(points);
  triangles.triangles = flat.triangles;
  ExecutionContext context(1);
  result.mesh = recombine(triangles, {}, context);
  result.parameters = flat.points;
  result.fixed = flat.boundary;
  return result;
}

inline void place_in_plane(const Vector2& p, Vector3& x, Vector3& normal) {
  x = {p.x(), p.y(), 0};
  normal = {0, 0, 1};
}

/// A rectangle 1 x height, about `columns` cells wide.
inline SurfaceMesh rectangle(int columns, double height, std::uint32_t seed) {
  const int rows = std::max(2, static_cast<int>(std::lround(height * columns / 0.9)));
  Triangulation flat = lattice(columns, rows, false);
  jitter(flat, 1.0 / columns, 1.0 / rows, 0.4, seed);
  for (Vector2& p : flat.points) p.y() *= height;
  make_delaunay(flat);
  return surface_mesh(flat, place_in_plane);
}

/// Whether work on quads looks at least once in 30 of them whether to go on, at any size. Empty if so.
inline std::string rare_looks(const std::function<void(SurfaceMesh&, ExecutionContext&)>& work) {
  constexpr double most_quads = 30, least_growth = 2.2;
  double before = 0;
  for (const int columns : {30, 60}) {
    SurfaceMesh mesh = rectangle(columns, 1, 1);
    const auto quads = static_cast<double>(mesh.mesh.quads.size());
    ExecutionContext context(1);
    work(mesh, context);
    const auto looks = static_cast<double>(context.work());
    if (quads > most_quads * looks || looks < least_growth * before)
      return std::to_string(looks) + " looks in " + std::to_string(quads) + " quads, " +
             std::to_string(before) + " in a quarter of them";
    before = looks;
  }
  return "";
}

/// A ring of inner radius 0.4 and outer radius 1: a domain with a hole, sizes growing outwards.
inline SurfaceMesh ring(int columns, std::uint32_t seed) {
  const double growth = std::log(1 / 0.4);
  const int rows =
      std::max(2, static_cast<int>(std::lround(columns * growth / (2 * std::numbers::pi) / 0.9)));
  Triangulation flat = lattice(columns, rows, true);
  jitter(flat, 1.0 / columns, 1.0 / rows, 0.4, seed);
  for (Vector2& p : flat.points) {
    const double angle = -2 * std::numbers::pi * p.x(), radius = 0.4 * std::exp(growth * p.y());
    p = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  make_delaunay(flat);
  return surface_mesh(flat, place_in_plane);
}

/// A sphere round the origin; parameters are not used.
class SphereSurface : public MeshSurface {
 public:
  explicit SphereSurface(double radius) : radius_(radius) {}
  Vector3 move(Vector2&, const Vector3& target, Vector3& normal) const override {
    normal = target.normalized();
    return radius_ * normal;
  }

 private:
  double radius_;
};

/// A cylinder round the z axis; parameters are not used.
class CylinderSurface : public MeshSurface {
 public:
  explicit CylinderSurface(double radius) : radius_(radius) {}
  Vector3 move(Vector2&, const Vector3& target, Vector3& normal) const override {
    normal = Vector3(target.x(), target.y(), 0).normalized();
    return {radius_ * normal.x(), radius_ * normal.y(), target.z()};
  }

 private:
  double radius_;
};

/// A patch of the unit sphere, a quarter of its upper half.
inline SurfaceMesh dome(int columns, std::uint32_t seed) {
  Triangulation flat = lattice(columns, static_cast<int>(std::lround(columns / 0.9)), false);
  jitter(flat, 1.0 / columns, 0.9 / columns, 0.35, seed);
  make_delaunay(flat);
  return surface_mesh(flat, [](const Vector2& p, Vector3& x, Vector3& normal) {
    normal = Vector3(2 * p.x() - 1, 2 * p.y() - 1, 1.2).normalized();
    x = normal;
  });
}

/// A full cylinder of radius 1, open at both ends, meshed without a seam.
inline SurfaceMesh tube(int columns, std::uint32_t seed) {
  Triangulation flat = lattice(columns, std::max(2, columns / 3), true);
  const double length = 2 * std::numbers::pi / 3 * 0.9;
  jitter(flat, 1.0 / columns, 3.0 / columns, 0.35, seed);
  for (Vector2& p : flat.points) {
    // The conformal image in the plane, where the Delaunay criterion is the same.
    const double angle = 2 * std::numbers::pi * p.x(), radius = std::exp(-length * p.y());
    p = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  make_delaunay(flat);
  return surface_mesh(flat, [](const Vector2& p, Vector3& x, Vector3& normal) {
    normal = Vector3(p.x(), p.y(), 0).normalized();
    x = {normal.x(), normal.y(), -std::log(p.norm())};
  });
}

/// A mesh to improve and the surface it lies on.
struct Sample {
  std::string name;
  SurfaceMesh mesh;
  std::shared_ptr<const MeshSurface> surface;
};

/// Samples of every kind: plane with and without a hole, sizes that grow, sphere, closed cylinder.
inline std::vector<Sample> samples(int columns) {
  std::vector<Sample> result;
  for (const std::uint32_t seed : {1u, 2u}) {
    const std::string number = std::to_string(seed);
    result.push_back({"rectangle " + number, rectangle(columns, 2, seed), std::make_shared<PlanarSurface>()});
    result.push_back({"ring " + number, ring(4 * columns, seed), std::make_shared<PlanarSurface>()});
    result.push_back({"dome " + number, dome(columns, seed), std::make_shared<SphereSurface>(1)});
    result.push_back({"tube " + number, tube(2 * columns, seed), std::make_shared<CylinderSurface>(1)});
  }
  return result;
}

/// Each quad split in four, the new nodes put on the surface.
inline SurfaceMesh subdivide(const SurfaceMesh& coarse, const MeshSurface& surface) {
  SurfaceMesh fine = coarse;
  fine.mesh.quads.clear();
  fine.mesh.quad_tags.clear();
  std::map<std::pair<int, int>, int> middles, uses;
  for (const auto& q : coarse.mesh.quads)
    for (int k = 0; k < 4; ++k) ++uses[std::minmax(q[k], q[(k + 1) & 3])];
  const auto add = [&](const Vector3& target, int from, bool fixed) {
    Vector2 uv = coarse.parameters[from];
    Vector3 normal = coarse.normals[from];
    fine.mesh.points.push_back(surface.move(uv, target, normal));
    fine.parameters.push_back(uv);
    fine.normals.push_back(normal);
    fine.fixed.push_back(fixed);
    return static_cast<int>(fine.mesh.points.size()) - 1;
  };
  const auto middle = [&](int a, int b) {
    const std::pair<int, int> key = std::minmax(a, b);
    const auto [entry, fresh] = middles.try_emplace(key, -1);
    if (fresh) entry->second = add(0.5 * (coarse.mesh.points[a] + coarse.mesh.points[b]), a, uses[key] == 1);
    return entry->second;
  };
  for (const auto& q : coarse.mesh.quads) {
    Vector3 center = Vector3::Zero();
    for (const int node : q) center += 0.25 * coarse.mesh.points[node];
    const int m = add(center, q[0], false);
    for (int k = 0; k < 4; ++k)
      fine.mesh.quads.push_back({q[k], middle(q[k], q[(k + 1) & 3]), m, middle(q[(k + 3) & 3], q[k])});
  }
  return fine;
}

inline ShellMesh shell(const SurfaceMesh& mesh) {
  ShellMesh result;
  result.points = mesh.mesh.points;
  result.quads = mesh.mesh.quads;
  result.quad_faces.assign(result.quads.size(), 1);
  result.triangles = mesh.mesh.triangles;
  result.triangle_faces.assign(result.triangles.size(), 1);
  return result;
}

}  // namespace quadrille::sample
