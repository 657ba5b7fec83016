/// Based on: Lawson (1977) for the flips; CGAL, 2D Triangulations, for the constrained Delaunay
/// triangulation.

// CGAL first: OpenCASCADE defines a macro named Handle.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/spatial_sort.h>

#include "mesher/faces/face_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/function_property_map.hpp>

#include "geometry/base/place_text.hpp"
#include "mesher/faces/face_problem.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
/// Where a triangle lies, once it is known.
using IsInside = std::optional<bool>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<IsInside, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

FaceProblem no_triangles(FaceId face, const Vector3& near) {
  return {
      Cause::no_mesh, face,
      fmt::format("the boundary of Face{} encloses no triangles near {}", face.number(), place_text(near))};
}

class Triangulator {
 public:
  Triangulator(FaceId face, const FaceBoundary& boundary, const PlacedPoints& placed,
               const FaceSurface& surface, const ExecutionContext& context)
      : face_(face),
        boundary_(boundary),
        placed_(placed),
        scale_(surface.mean_scale()),
        context_(context),
        check_(context) {}

  /// Triangles over the boundary's points followed by the placed ones; none if placed points lie on segments.
  std::vector<std::array<int, 3>> run() {
    insert_points();
    insert_segments();
    if (!on_segments_.empty()) return {};
    mark_domain();
    std::vector<std::array<int, 3>> triangles;
    for (auto f = cdt_.finite_faces_begin(); f != cdt_.finite_faces_end(); ++f) {
      check_();
      if (*f->info()) triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    }
    return triangles;
  }

  /// The placed points that run() found on segments, descending.
  const std::set<int, std::greater<>>& on_segments() const { return on_segments_; }

 private:
  Kernel::Point_2 scaled(const Vector2& uv) const { return {uv.x() * scale_.x(), uv.y() * scale_.y()}; }

  void insert_points() {
    std::vector<Kernel::Point_2> points;
    points.reserve(boundary_.uv.size() + placed_.uv.size());
    for (const Vector2& uv : boundary_.uv) points.push_back(scaled(uv));
    for (const Vector2& uv : placed_.uv) points.push_back(scaled(uv));
    insert_along_curve(points);
    if (cdt_.dimension() < 2) throw no_triangles(face_, boundary_.points.front());
    handles_.assign(points.size(), nullptr);
    for (auto v = cdt_.finite_vertices_begin(); v != cdt_.finite_vertices_end(); ++v) handles_[v->info()] = v;
    // A point that coincides with another one was not inserted: find that other one.
    for (std::size_t i = 0; i < boundary_.uv.size(); ++i)
      if (handles_[i] == nullptr) handles_[i] = cdt_.insert(points[i]);
  }

  /// Inserts points as CGAL inserts a range, which is one call without checks and takes 1 s for a million
  /// points.
  void insert_along_curve(const std::vector<Kernel::Point_2>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    constexpr int looks = 1 << 16;
    SparseCheck check_sorting(context_, looks);
    // Sorting is a single call, so accesses to points check the context at times.
    const auto point_at = [&](std::size_t i) -> const Kernel::Point_2& {
      check_sorting();
      return points[i];
    };
    using Points = boost::function_property_map<decltype(point_at), std::size_t, const Kernel::Point_2&>;
    using Traits = CGAL::Spatial_sort_traits_adapter_2<Kernel, Points>;
    CGAL::spatial_sort(order.begin(), order.end(), Traits(Points(point_at)));
    Cdt::Face_handle hint;
    for (const std::size_t i : order) {
      check_();
      const Cdt::Vertex_handle vertex = cdt_.insert(points[i], hint);
      vertex->info() = static_cast<int>(i);
      hint = vertex->face();
    }
  }

  void insert_segments() {
    for (const auto& segment : boundary_.segments) {
      check_();
      const auto a = handles_[segment.a], b = handles_[segment.b];
      if (a == b) throw no_triangles(face_, boundary_.points[segment.a]);
      // Used twice (a slit) or internal: the face lies on both sides.
      const auto key = std::minmax(a->info(), b->info());
      const bool is_new = seen_.insert(key).second;
      if (segment.internal || !is_new) transparent_.insert(key);
      if (!is_new) continue;
      try {
        cdt_.insert_constraint(a, b);
      } catch (const Cdt::Intersection_of_constraints_exception&) {
        throw no_triangles(face_, boundary_.points[segment.a]);
      }
      find_points_between(a, b);
    }
  }

  /// Finds the points that lie on a segment, which split it.
  void find_points_between(Cdt::Vertex_handle a, Cdt::Vertex_handle b) {
    Cdt::Face_handle f;
    int i = 0;
    for (Cdt::Vertex_handle next; a != b; a = next) {
      if (!cdt_.includes_edge(a, b, next, f, i)) throw no_triangles(face_, boundary_.points.front());
      if (next == b) return;
      const int placed = next->info() - boundary_.size();
      if (placed < 0) throw no_triangles(face_, boundary_.points[next->info()]);
      on_segments_.insert(placed);
    }
  }

  bool switches_side(Cdt::Face_handle f, int i) const {
    if (!f->is_constrained(i)) return false;
    if (transparent_.empty()) return true;
    return !transparent_.contains(std::minmax(f->vertex(Cdt::cw(i))->info(), f->vertex(Cdt::ccw(i))->info()));
  }

  /// Marks triangles as inside or outside by nesting, from the infinite face inward.
  void mark_domain() {
    std::vector<Cdt::Face_handle> stack{cdt_.infinite_face()};
    cdt_.infinite_face()->info() = false;
    while (!stack.empty()) {
      check_();
      const Cdt::Face_handle f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Cdt::Face_handle neighbor = f->neighbor(i);
        if (neighbor->info()) continue;
        neighbor->info() = *f->info() != switches_side(f, i);
        stack.push_back(neighbor);
      }
    }
  }

  FaceId face_;
  const FaceBoundary& boundary_;
  const PlacedPoints& placed_;
  Vector2 scale_;
  const ExecutionContext& context_;
  SparseCheck check_;
  Cdt cdt_;
  std::vector<Cdt::Vertex_handle> handles_;
  std::set<std::pair<int, int>> seen_, transparent_;
  std::set<int, std::greater<>> on_segments_;
};

/// Triangulates without the placed points that lie on segments, and removes these from `placed`.
std::vector<std::array<int, 3>> triangles_of(FaceId face, const FaceBoundary& boundary, PlacedPoints& placed,
                                             const FaceSurface& surface, const ExecutionContext& context) {
  while (true) {
    Triangulator triangulator(face, boundary, placed, surface, context);
    auto triangles = triangulator.run();
    if (triangulator.on_segments().empty()) return triangles;
    // Ends, since at least one point is removed each time.
    for (const int i : triangulator.on_segments()) {
      placed.uv.erase(placed.uv.begin() + i);
      placed.points.erase(placed.points.begin() + i);
    }
  }
}

/// Opens the triangulation along segments with the face on both sides, as if each side had its own boundary.
/// Recombination then keeps these segments as sides of quads.
class CrackOpener {
 public:
  /// \param inner_count number of points inside the boundary
  CrackOpener(FaceBoundary& boundary, std::vector<std::array<int, 3>>& triangles, std::size_t inner_count,
              const ExecutionContext& context)
      : boundary_(boundary),
        triangles_(triangles),
        inner_start_(boundary.size()),
        point_count_(boundary.size() + inner_count),
        check_(context) {}

  void run() {
    find_cracks();
    if (cracks_.empty()) return;
    original_ = triangles_;
    for (const auto& [key, segment] : cracks_) ends_.insert({key.first, key.second});
    corners_ = corners_by_node(point_count_, triangles_, check_);
    for (const int point : ends_) split(point);
    renumber_inner_points();
    replace_segments();
  }

 private:
  using Key = std::pair<int, int>;
  static Key key(int a, int b) { return std::minmax(a, b); }

  void find_cracks() {
    std::map<Key, int> uses;
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate) continue;
      if (segment.internal || ++uses[key(segment.a, segment.b)] > 1) {
        cracks_.emplace(key(segment.a, segment.b), segment);
      }
    }
  }

  int original(int triangle, int k) const { return original_[triangle][k % 3]; }

  /// Gives every fan of triangles at a point but the first its own copy of the point.
  void split(int point) {
    std::vector<Side> left(corners_[point].begin(), corners_[point].end());
    for (bool first = true; !left.empty(); first = false) {
      std::vector<Side> fan{left.back()};
      left.pop_back();
      for (std::size_t i = 0; i < fan.size(); ++i) {
        std::erase_if(left, [&](Side corner) {
          if (!joined(fan[i], corner)) return false;
          fan.push_back(corner);
          return true;
        });
      }
      if (first) continue;
      const int copy = inner_start_ + static_cast<int>(copies_.size());
      copies_.push_back(point);
      for (const Side corner : fan)
        triangles_[element_of(corner)][index_of(corner)] = -1 - copy;  // renumbered below
    }
  }

  /// Whether two triangles at a point share a side there, and the side is not a crack.
  bool joined(Side corner, Side other) const {
    const int t = element_of(corner), k = index_of(corner), u = element_of(other), j = index_of(other);
    const auto open = [&](int end) { return cracks_.contains(key(original(t, k), end)); };
    if (original(t, k + 1) == original(u, j + 2) && !open(original(t, k + 1))) return true;
    return original(t, k + 2) == original(u, j + 1) && !open(original(t, k + 2));
  }

  void renumber_inner_points() {
    const int shift = static_cast<int>(copies_.size());
    for (auto& triangle : triangles_) {
      for (int& corner : triangle)
        corner = corner < 0 ? -1 - corner : corner < inner_start_ ? corner : corner + shift;
    }
    for (const int point : copies_) {
      boundary_.add(boundary_.uv[point], boundary_.points[point], boundary_.nodes[point]);
      boundary_.angles[point] = 0;
    }
  }

  /// Makes one segment for each side of a crack. Segments that end at a crack get the point of their side.
  void replace_segments() {
    std::map<Key, FaceBoundary::Segment> replaced;
    std::erase_if(boundary_.segments, [&](const auto& segment) {
      if (segment.degenerate || (!ends_.contains(segment.a) && !ends_.contains(segment.b))) return false;
      replaced.emplace(key(segment.a, segment.b), segment);
      return true;
    });
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      check_();
      for (int k = 0; k < 3; ++k) {
        const auto it = replaced.find(key(original(t, k), original(t, k + 1)));
        if (it == replaced.end()) continue;
        FaceBoundary::Segment segment = it->second;
        segment.a = triangles_[t][k];
        segment.b = triangles_[t][(k + 1) % 3];
        boundary_.segments.push_back(segment);
      }
    }
  }

  FaceBoundary& boundary_;
  std::vector<std::array<int, 3>>& triangles_;
  int inner_start_;
  std::size_t point_count_;
  SparseCheck check_;
  std::map<Key, FaceBoundary::Segment> cracks_;
  std::set<int> ends_;                        // points at ends of cracks
  Rows<Side> corners_;                        // of triangles, before the splits
  std::vector<std::array<int, 3>> original_;  // triangles before the splits
  std::vector<int> copies_;
};

/// (points) the first of the parameter points of a pole for all of these; each other point itself.
std::vector<int> collapsed_poles(const FaceBoundary& boundary, int count) {
  boost::disjoint_sets_with_storage<> poles(count);
  for (const auto& segment : boundary.segments)
    if (segment.degenerate) poles.union_set(segment.a, segment.b);
  std::vector<int> first(count, -1), target;
  for (int i = 0; i < count; ++i) {
    int& point = first[poles.find_set(i)];
    if (point < 0) point = i;
    target.push_back(point);
  }
  return target;
}

/// Replaces the corners by their targets. Triangles with two corners in a pole vanish, and their neighbors
/// across the other two sides become neighbors. Thus several sides between two points stay distinct.
void rename_corners(const std::vector<int>& target, std::vector<std::array<int, 3>>& triangles,
                    std::vector<int>& across) {
  std::vector<int> renumbered(triangles.size());
  int left = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t] = with_numbers(triangles[t], target);
    const auto& corners = triangles[t];
    int collapsed = 0;
    while (collapsed < 3 && corners[collapsed] != corners[(collapsed + 1) % 3]) ++collapsed;
    renumbered[t] = collapsed < 3 ? -1 : left++;
    if (collapsed == 3 || across.empty()) continue;
    const std::size_t first = 3 * t;
    const int a = across[first + (collapsed + 1) % 3], b = across[first + (collapsed + 2) % 3];
    if (a >= 0) across[a] = b;
    if (b >= 0) across[b] = a;
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (renumbered[t] < 0) continue;
    const std::size_t to = renumbered[t];
    triangles[to] = triangles[t];
    for (std::size_t k = 0; k < 3 && !across.empty(); ++k) {
      const int other = across[3 * t + k];
      across[3 * to + k] = other < 0 ? -1 : 3 * renumbered[other / 3] + other % 3;
    }
  }
  triangles.resize(left);
  if (!across.empty()) across.resize(3 * triangles.size());
}

/// Replaces an angle by 2 pi minus it where that is closer to the angle that the triangles fill: wires may
/// run the wrong way around.
void choose_sides(FaceTriangulation& face) {
  std::vector<double> filled(face.boundary_count, 0);
  for (const auto& t : face.mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= face.boundary_count) continue;
      const Vector3& p = face.mesh.points[t[k]];
      const Vector3 a = face.mesh.points[t[(k + 1) % 3]] - p, b = face.mesh.points[t[(k + 2) % 3]] - p;
      filled[t[k]] += angle_between(a, b);
    }
  }
  for (int i = 0; i < face.boundary_count; ++i) {
    double& angle = face.angles[i];
    if (angle <= 0) continue;
    if (std::abs(2 * M_PI - angle - filled[i]) < std::abs(angle - filled[i])) angle = 2 * M_PI - angle;
  }
}

}  // namespace

FaceTriangulation triangulate_face(FaceId face, FaceBoundary boundary, PlacedPoints placed,
                                   const FaceSurface& surface, const ExecutionContext& context) {
  std::vector<std::array<int, 3>> triangles = triangles_of(face, boundary, placed, surface, context);
  CrackOpener(boundary, triangles, placed.uv.size(), context).run();

  const int count = boundary.size() + static_cast<int>(placed.uv.size());
  std::vector<int> target = collapsed_poles(boundary, count);
  std::vector<char> pole(count, 0);
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate) pole[target[segment.a]] = 1;
  }
  std::vector<int> across;
  if (!surface.planar()) across = triangle_neighbors(triangles, count, context);
  rename_corners(target, triangles, across);
  if (triangles.empty()) throw no_triangles(face, boundary.points.front());
  context.check();

  // Keep the points that are used, boundary points first.
  std::vector<int> renumbered(count, -1);
  for (const auto& t : triangles) {
    for (const int corner : t) renumbered[corner] = 0;
  }
  FaceTriangulation result;
  SparseCheck check(context);
  for (int i = 0; i < count; ++i) {
    check();
    if (renumbered[i] < 0) continue;
    renumbered[i] = static_cast<int>(result.uv.size());
    const bool on_boundary = i < boundary.size();
    result.uv.push_back(on_boundary ? boundary.uv[i] : placed.uv[i - boundary.size()]);
    result.mesh.points.push_back(on_boundary ? boundary.points[i] : placed.points[i - boundary.size()]);
    result.normals.push_back(surface.normal(result.uv.back()));
    result.pole.push_back(pole[i]);
    if (!on_boundary) continue;
    result.nodes.push_back(boundary.nodes[i]);
    result.angles.push_back(pole[i] ? 0 : boundary.angles[i]);
  }
  result.boundary_count = static_cast<int>(result.nodes.size());
  for (auto& t : triangles) t = with_numbers(t, renumbered);
  result.mesh.triangles = std::move(triangles);
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate) continue;
    FaceBoundary::Segment kept = segment;
    kept.a = renumbered[target[segment.a]];
    kept.b = renumbered[target[segment.b]];
    if (kept.a < 0 || kept.b < 0) throw no_triangles(face, boundary.points[segment.a]);
    result.segments.push_back(kept);
  }
  if (!surface.planar()) flip_in_space(result, std::move(across), context);
  context.check();
  choose_sides(result);
  context.check();
  return result;
}

}  // namespace quadrille
