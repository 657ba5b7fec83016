/// Poisson disk sampling over a hash grid, CGAL's constrained Delaunay triangulation, and a few relaxations.

#include "bench/planar_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "geometry/base/error.hpp"
#include "geometry/base/trimmed_domain.hpp"

namespace quadrille::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

/// The wanted size on a raster, from the distance to the boundary points (swept to and fro, Danielsson 1980).
class SizeRaster {
 public:
  SizeRaster(const std::vector<Vector2>& boundary, const Grading& grading) : grading_(grading) {
    low_ = high_ = boundary.front();
    for (const Vector2& p : boundary) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    cell_ = (high_ - low_).maxCoeff() / 1000;
    columns_ = static_cast<int>((high_ - low_).x() / cell_) + 2;
    rows_ = static_cast<int>((high_ - low_).y() / cell_) + 2;
    std::vector<int> nearest(static_cast<std::size_t>(columns_) * rows_, -1);
    distance_.assign(nearest.size(), 1e300);
    const auto offer = [&](int i, int j, int site) {
      if (site < 0 || i < 0 || j < 0 || i >= columns_ || j >= rows_) return;
      const std::size_t k = static_cast<std::size_t>(j) * columns_ + i;
      const double d = (boundary[site] - low_ - cell_ * Vector2(i, j)).norm();
      if (d >= distance_[k]) return;
      distance_[k] = d;
      nearest[k] = site;
    };
    for (int s = 0; s < static_cast<int>(boundary.size()); ++s) {
      const Vector2 at = (boundary[s] - low_) / cell_;
      for (int k = 0; k < 4; ++k)
        offer(static_cast<int>(at.x()) + k % 2, static_cast<int>(at.y()) + k / 2, s);
    }
    const auto sweep = [&](int direction) {
      for (int n = 0; n < columns_ * rows_; ++n) {
        const int k = direction > 0 ? n : columns_ * rows_ - 1 - n;
        const int i = k % columns_, j = k / columns_;
        if (nearest[k] < 0) continue;
        for (int dj = -1; dj <= 1; ++dj) {
          for (int di = -1; di <= 1; ++di) offer(i + di, j + dj, nearest[k]);
        }
      }
    };
    for (int pass = 0; pass < 4; ++pass) sweep(pass % 2 == 0 ? 1 : -1);
  }

  double operator()(const Vector2& p) const {
    const Vector2 at = (p - low_) / cell_;
    const int i = std::clamp(static_cast<int>(at.x()), 0, columns_ - 2);
    const int j = std::clamp(static_cast<int>(at.y()), 0, rows_ - 2);
    const double s = at.x() - i, t = at.y() - j;
    const double* d = &distance_[static_cast<std::size_t>(j) * columns_ + i];
    const double distance =
        (1 - t) * ((1 - s) * d[0] + s * d[1]) + t * ((1 - s) * d[columns_] + s * d[columns_ + 1]);
    return std::min(grading_.boundary_size + grading_.growth * distance, grading_.largest);
  }

  const Vector2& low() const { return low_; }
  const Vector2& high() const { return high_; }

 private:
  Grading grading_;
  Vector2 low_, high_;
  double cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<double> distance_;
};

/// Points in a hash grid; a cell lists the points in it.
class PointGrid {
 public:
  PointGrid(const Vector2& low, const Vector2& high, double cell) : low_(low), cell_(cell) {
    columns_ = static_cast<int>((high - low).x() / cell) + 1;
    rows_ = static_cast<int>((high - low).y() / cell) + 1;
    first_.assign(static_cast<std::size_t>(columns_) * rows_, -1);
  }

  void add(int index, const Vector2& p) {
    int& head = first_[cell_of(p)];
    next_.resize(index + 1, -1);
    next_[index] = head;
    head = index;
  }

  bool clear(const std::vector<Vector2>& points, const Vector2& p, double radius) const {
    const Vector2 a = (p - low_ - Vector2(radius, radius)) / cell_,
                  b = (p - low_ + Vector2(radius, radius)) / cell_;
    const int i0 = std::max(0, static_cast<int>(a.x())), i1 = std::min(columns_ - 1, static_cast<int>(b.x()));
    const int j0 = std::max(0, static_cast<int>(a.y())), j1 = std::min(rows_ - 1, static_cast<int>(b.y()));
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        for (int k = first_[static_cast<std::size_t>(j) * columns_ + i]; k >= 0; k = next_[k]) {
          if ((points[k] - p).squaredNorm() < radius * radius) return false;
        }
      }
    }
    return true;
  }

 private:
  std::size_t cell_of(const Vector2& p) const {
    const int i = std::clamp(static_cast<int>((p.x() - low_.x()) / cell_), 0, columns_ - 1);
    const int j = std::clamp(static_cast<int>((p.y() - low_.y()) / cell_), 0, rows_ - 1);
    return static_cast<std::size_t>(j) * columns_ + i;
  }

  Vector2 low_;
  double cell_;
  int columns_, rows_;
  std::vector<int> first_, next_;
};

struct Boundary {
  std::vector<Vector2> points;
  std::vector<std::array<int, 2>> segments;
};

Boundary sample(const std::vector<Ring>& rings, double size) {
  Boundary boundary;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring& ring = rings[r];
    const int first = static_cast<int>(boundary.points.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const int pieces = std::max(1, static_cast<int>(std::lround((b - a).norm() / size)));
      for (int s = 0; s < pieces; ++s) boundary.points.emplace_back(a + (b - a) * s / pieces);
    }
    // Only a boundary with an even number of sides in all can be meshed with quads alone.
    if (r + 1 == rings.size() && boundary.points.size() % 2 == 1) {
      boundary.points.emplace_back((boundary.points.back() + ring.front()) / 2);
    }
    const int count = static_cast<int>(boundary.points.size()) - first;
    for (int k = 0; k < count; ++k) boundary.segments.push_back({first + k, first + (k + 1) % count});
  }
  return boundary;
}

/// Appends random points around the existing ones, with distances of at least `apart` times the size.
void fill(std::vector<Vector2>& points, const TrimmedDomain& domain, const SizeRaster& size, double least,
          unsigned seed) {
  constexpr double apart = 0.66;  // share of the size; triangle sides then equal the size on average
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  PointGrid grid(size.low(), size.high(), least);
  for (std::size_t k = 0; k < points.size(); ++k) grid.add(static_cast<int>(k), points[k]);
  for (std::size_t head = 0; head < points.size(); ++head) {
    const Vector2 from = points[head];
    const double start = uniform(generator);
    constexpr int tries = 14;
    for (int k = 0; k < tries; ++k) {
      const double angle = 2 * std::numbers::pi * (start + static_cast<double>(k) / tries);
      const double reach = size(from) * apart * (1.0001 + 0.85 * uniform(generator));
      const Vector2 p = from + reach * Vector2(std::cos(angle), std::sin(angle));
      if (!grid.clear(points, p, apart * size(p)) || !domain.inside(p)) continue;
      grid.add(static_cast<int>(points.size()), p);
      points.push_back(p);
    }
  }
}

/// Marks the faces with the number of boundaries around them: odd = inside.
void mark_nesting(Triangulation& triangulation) {
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face)
    face->info() = -1;
  std::vector<Triangulation::Face_handle> now{triangulation.infinite_face()}, beyond;
  for (int level = 0; !now.empty(); ++level) {
    while (!now.empty()) {
      const auto face = now.back();
      now.pop_back();
      if (face->info() >= 0) continue;
      face->info() = level;
      for (int i = 0; i < 3; ++i) {
        if (face->neighbor(i)->info() >= 0) continue;
        (face->is_constrained(i) ? beyond : now).push_back(face->neighbor(i));
      }
    }
    now.swap(beyond);
  }
}

TriangleMesh delaunay(const std::vector<Vector2>& points, const std::vector<std::array<int, 2>>& segments) {
  std::vector<std::pair<Kernel::Point_2, int>> sites;
  sites.reserve(points.size());
  for (const Vector2& p : points)
    sites.emplace_back(Kernel::Point_2(p.x(), p.y()), static_cast<int>(sites.size()));
  Triangulation triangulation;
  triangulation.insert(sites.begin(), sites.end());
  std::vector<Triangulation::Vertex_handle> vertices(points.size());
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
    vertices[v->info()] = v;
  }
  for (const auto& [a, b] : segments) triangulation.insert_constraint(vertices[a], vertices[b]);
  mark_nesting(triangulation);
  TriangleMesh mesh;
  mesh.points.reserve(points.size());
  for (const Vector2& p : points) mesh.points.emplace_back(p.x(), p.y(), 0);
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
    if (face->info() % 2 == 0) continue;
    mesh.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return mesh;
}

/// Moves each point from index `first` on by a share of the way to the mean of its neighbors.
void relax(std::vector<Vector2>& points, const TriangleMesh& mesh, std::size_t first) {
  constexpr double share = 0.15;
  std::vector<Vector2> sum(points.size(), Vector2::Zero());
  std::vector<int> count(points.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      sum[t[i]] += points[t[(i + 1) % 3]] + points[t[(i + 2) % 3]];
      count[t[i]] += 2;
    }
  }
  for (std::size_t v = first; v < points.size(); ++v) {
    if (count[v] > 0) points[v] = (1 - share) * points[v] + share * sum[v] / count[v];
  }
}

}  // namespace

TriangleMesh triangulate(const std::vector<Ring>& rings, const Grading& grading, unsigned seed) {
  const Boundary boundary = sample(rings, grading.boundary_size);
  std::vector<TrimmedDomain::Segment> segments;
  for (const auto& [a, b] : boundary.segments) segments.push_back({boundary.points[a], boundary.points[b]});
  const TrimmedDomain domain(std::move(segments));
  std::vector<Vector2> points = boundary.points;
  fill(points, domain, SizeRaster(boundary.points, grading), grading.boundary_size, seed);
  TriangleMesh mesh = delaunay(points, boundary.segments);
  relax(points, mesh, boundary.points.size());
  return delaunay(points, boundary.segments);
}

std::vector<Ring> read_rings(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw failure(path.string(), path.string() + ": cannot be read");
  std::vector<Ring> rings;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '>') {
      rings.emplace_back();
      continue;
    }
    std::istringstream fields(line);
    double x = 0, y = 0;
    if (!(fields >> x >> y) || rings.empty())
      throw failure(path.string(), path.string() + ": bad line: " + line);
    rings.back().emplace_back(x, y);
  }
  for (Ring& ring : rings) {
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  }
  return rings;
}

}  // namespace quadrille::bench
