/// Bridges the holes to the outline and fills it by CGAL's triangulate_hole_polyline.

// CGAL first: OpenCASCADE defines a macro named Handle.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include "mesher/faces/loop_filling.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

/// Joins a hole to an outline by the shortest bridge, along which the outline runs there and back.
void join_hole(const std::vector<Vector3>& points, std::vector<int> hole, std::vector<int>& outline) {
  std::pair<std::size_t, std::size_t> bridge;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t k = 0; k < hole.size(); ++k) {
      const double length = (points[outline[i]] - points[hole[k]]).squaredNorm();
      if (length < shortest) {
        shortest = length;
        bridge = {i, k};
      }
    }
  }
  std::rotate(hole.begin(), hole.begin() + static_cast<long>(bridge.second), hole.end());
  hole.push_back(hole.front());
  hole.push_back(outline[bridge.first]);
  outline.insert(outline.begin() + static_cast<long>(bridge.first) + 1, hole.begin(), hole.end());
}

}  // namespace

void flip_flat(const std::vector<Vector3>& points, const std::set<std::pair<int, int>>& kept,
               std::vector<std::array<int, 3>>& triangles) {
  constexpr int most_passes = 20;
  bool any = true;
  for (int pass = 0; any && pass < most_passes; ++pass) {
    any = false;
    std::map<std::pair<int, int>, std::pair<std::size_t, int>> first;  // side -> triangle, corner before it
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
        const auto [found, is_new] = first.try_emplace(std::minmax(a, b), t, k);
        if (is_new || kept.contains(std::minmax(a, b))) continue;
        const auto [u, j] = found->second;
        // A triangle that was flipped in this pass may have another side there now.
        if (u == t || triangles[u][j] != b || triangles[u][(j + 1) % 3] != a) continue;
        const int c = triangles[t][(k + 2) % 3], d = triangles[u][(j + 2) % 3];
        const double at_c = angle_between(points[a] - points[c], points[b] - points[c]),
                     at_d = angle_between(points[a] - points[d], points[b] - points[d]);
        constexpr double flat = 2.8, both = 3.2;  // radians; with a sum of pi, the flip changes nothing
        if (c == d || std::max(at_c, at_d) < flat || at_c + at_d < both) continue;
        triangles[t] = {c, a, d};
        triangles[u] = {d, b, c};
        any = true;
        break;
      }
    }
  }
}

std::vector<std::array<int, 3>> fill_loops(const std::vector<Vector3>& points,
                                           const std::vector<std::vector<int>>& loops, bool flips) {
  constexpr std::size_t max_points = 2000;
  std::size_t count = 0;
  for (const std::vector<int>& loop : loops) count += loop.size();
  if (loops.empty() || count > max_points) return {};
  std::vector<int> outline = loops.front();
  for (std::size_t i = 1; i < loops.size(); ++i) join_hole(points, loops[i], outline);
  std::vector<Point> polyline;
  std::vector<Vector3> places;
  std::set<std::pair<int, int>> sides;  // by places in the outline, where bridges are two sides
  const int last = static_cast<int>(outline.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const Vector3& place = places.emplace_back(points[outline[i]]);
    polyline.emplace_back(place.x(), place.y(), place.z());
    sides.insert(std::minmax(i, i < last ? i + 1 : 0));
  }
  std::vector<CGAL::Triple<int, int, int>> found;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(polyline, std::back_inserter(found));
  std::vector<std::array<int, 3>> triangles;
  bool along = true;  // the triangle at the first side runs along it
  for (const auto& [i, j, k] : found) {
    const std::array<int, 3> t{i, j, k};
    for (int c = 0; c < 3; ++c) {
      const int from = t[c], to = t[(c + 1) % 3];
      if ((from == 1 && to == 0) || (from == 0 && to == last)) along = false;
    }
    triangles.push_back(t);
  }
  if (!along) {
    for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
  }
  if (flips) flip_flat(places, sides, triangles);
  for (auto& triangle : triangles) triangle = with_numbers(triangle, outline);
  const bool is_degenerate = std::any_of(triangles.begin(), triangles.end(), [](const auto& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  if (is_degenerate) triangles.clear();
  return triangles;
}

}  // namespace quadrille
