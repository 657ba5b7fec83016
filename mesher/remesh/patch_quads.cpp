#include "mesher/remesh/patch_quads.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/mesh/quality.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/subdivision.hpp"

namespace quadrille {

namespace {

class PatchMesher {
 public:
  PatchMesher(PatchTriangles triangles, const PatchSurface& on, ExecutionContext& context)
      : triangles_(std::move(triangles)), on_(on), surface_(on, triangles_.patch), context_(context) {
    for (const PatchTriangles::Side& side : triangles_.sides) {
      FaceBoundary::Segment& segment = segments_.emplace_back();
      segment.a = side.a;
      segment.b = side.b;
      segment.middle_node = side.middle;
      segment.middle_point = side.place;
    }
    place_points();
  }

  PatchQuads run(const RecombineOptions& recombination, const ImproveOptions& improvement) {
    tie_across_gaps(triangles_.mesh, coarse_.normals, segments_);
    coarse_.mesh = recombine(triangles_.mesh, recombination, context_);
    coarse_.mesh.quad_tags.clear();
    coarse_.mesh.triangle_tags.clear();
    ImproveReport report;
    {
      const StageTimer timer(context_, Stage::improve);
      if (improvement.clean_up) clean_up(coarse_, surface(), improvement, report, context_);
      smooth(coarse_, surface(), improvement, report, context_);
    }
    cut_flat_quads(coarse_.mesh, coarse_.normals, segments_, context_);
    split();
    const StageTimer timer(context_, Stage::improve);
    smooth(fine_, surface(), improvement, report, context_);
    PatchQuads result;
    result.off_surface = unfold();
    result.patch = triangles_.patch;
    result.points = std::move(fine_.mesh.points);
    result.places = std::move(fine_.parameters);
    result.quads = std::move(fine_.mesh.quads);
    result.nodes = std::move(nodes_);
    return result;
  }

 private:
  const SmoothingSurface& surface() const { return surface_; }

  void place_points() {
    const std::vector<Vector3>& points = triangles_.mesh.points;
    const std::size_t boundary = triangles_.nodes.size();
    for (std::size_t v = 0; v < points.size(); ++v) {
      Vector2 place(on_.locator.nearest(triangles_.patch, points[v]).triangle, 0);
      Vector3 normal;
      const Vector3 there = surface().move(place, points[v], normal);
      if (v >= boundary) triangles_.mesh.points[v] = there;
      coarse_.parameters.push_back(place);
      coarse_.normals.push_back(normal);
      coarse_.fixed.push_back(v < boundary);
      coarse_.boundary_angles.push_back(v < boundary ? triangles_.angles[v] : 0);
    }
  }

  /// Moves the free nodes of inverted quads off the surface: first to the mean of their neighbors, then to
  /// the place where the worst quad around them is best. \return the number of nodes moved.
  int unfold() {
    constexpr int rounds = 20;
    std::vector<Vector3>& p = fine_.mesh.points;
    std::map<int, std::vector<int>> round_node;  // node -> quads around it
    std::vector<char> moved(p.size(), 0);
    const auto shape = [&](int quad) {
      const auto& [a, b, c, d] = fine_.mesh.quads[quad];
      return quad_scaled_jacobian(p[a], p[b], p[c], p[d]);
    };
    for (int round = 0; round < rounds; ++round) {
      context_.check();
      round_node.clear();
      for (int quad = 0; quad < static_cast<int>(fine_.mesh.quads.size()); ++quad) {
        if (shape(quad) > 0) continue;
        for (const int v : fine_.mesh.quads[quad])
          if (!fine_.fixed[v]) round_node[v];
      }
      if (round_node.empty()) break;
      for (int quad = 0; quad < static_cast<int>(fine_.mesh.quads.size()); ++quad)
        for (const int v : fine_.mesh.quads[quad])
          if (const auto found = round_node.find(v); found != round_node.end()) found->second.push_back(quad);
      for (const auto& [v, quads] : round_node) {
        if (round == 0)
          p[v] = middle_of_neighbors(v, quads);
        else
          search(v, quads, shape);
        moved[v] = 1;
      }
    }
    return static_cast<int>(std::count(moved.begin(), moved.end(), 1));
  }

  Vector3 middle_of_neighbors(int v, const std::vector<int>& quads) const {
    Vector3 sum = Vector3::Zero();
    for (const int quad : quads) {
      const auto& corners = fine_.mesh.quads[quad];
      for (int k = 0; k < 4; ++k)
        if (corners[k] == v)
          sum += fine_.mesh.points[corners[(k + 1) % 4]] + fine_.mesh.points[corners[(k + 3) % 4]];
    }
    return sum / (2.0 * static_cast<double>(quads.size()));
  }

  /// Moves node v by ever shorter steps along the axes to the place where the worst quad is best.
  template <class Shape>
  void search(int v, const std::vector<int>& quads, const Shape& shape) {
    std::vector<Vector3>& p = fine_.mesh.points;
    double step = 0;
    for (const int quad : quads)
      for (const int other : fine_.mesh.quads[quad]) step = std::max(step, 0.5 * (p[other] - p[v]).norm());
    const auto worst = [&] {
      double least = 1;
      for (const int quad : quads) least = std::min(least, shape(quad));
      return least;
    };
    double best = worst();
    constexpr int halvings = 6;
    for (int k = 0; k < halvings; ++k, step *= 0.5) {
      for (int axis = 0; axis < 6; ++axis) {
        const Vector3 before = p[v];
        p[v] += (axis < 3 ? step : -step) * Vector3::Unit(axis % 3);
        if (const double now = worst(); now > best)
          best = now;
        else
          p[v] = before;
      }
    }
  }

  int add(const Vector3& point, const Vector2& place, const Vector3& normal, int node) {
    fine_.mesh.points.push_back(point);
    fine_.parameters.push_back(place);
    fine_.normals.push_back(normal);
    fine_.fixed.push_back(node >= 0);
    nodes_.push_back(node);
    return static_cast<int>(nodes_.size()) - 1;
  }

  /// Adds the point of the surface near a target. The search starts at point `from` of the fine mesh.
  int add_near(int from, const Vector3& target) {
    Vector2 place = fine_.parameters[from];
    Vector3 normal;
    const Vector3 point = surface().move(place, target, normal);
    return add(point, place, normal, -1);
  }

  void split() {
    fine_.mesh.points.clear();
    const std::vector<Vector3>& points = coarse_.mesh.points;
    for (std::size_t v = 0; v < points.size(); ++v)
      add(points[v], coarse_.parameters[v], coarse_.normals[v],
          v < triangles_.nodes.size() ? triangles_.nodes[v] : -1);
    for (const auto& segment : segments_) {
      Vector2 place = coarse_.parameters[segment.a];
      Vector3 normal;
      surface().move(place, segment.middle_point, normal);
      middles_.emplace(side_key(segment.a, segment.b),
                       add(segment.middle_point, place, normal, segment.middle_node));
    }
    for (const auto& quad : coarse_.mesh.quads) split(quad);
    for (const auto& triangle : coarse_.mesh.triangles) split(triangle);
  }

  template <std::size_t n>
  void split(const std::array<int, n>& element) {
    std::array<int, n> middles;
    Vector3 target = Vector3::Zero();
    for (std::size_t k = 0; k < n; ++k) {
      const int a = element[k], b = element[(k + 1) % n];
      const auto [found, is_new] = middles_.emplace(side_key(a, b), -1);
      if (is_new) found->second = add_near(a, 0.5 * (fine_.mesh.points[a] + fine_.mesh.points[b]));
      middles[k] = found->second;
      target += fine_.mesh.points[middles[k]] / static_cast<double>(n);
    }
    const int center = add_near(middles[0], target);
    for (std::size_t k = 0; k < n; ++k)
      fine_.mesh.quads.push_back({element[k], middles[k], center, middles[(k + n - 1) % n]});
  }

  PatchTriangles triangles_;
  const PatchSurface on_;
  const PatchOfSurface surface_;
  ExecutionContext& context_;
  std::vector<FaceBoundary::Segment> segments_;
  SurfaceMesh coarse_, fine_;
  std::vector<int> nodes_;  // (points of fine_) see PatchQuads::nodes
  std::unordered_map<std::uint64_t, int> middles_;
};

}  // namespace

Vector3 PatchOfSurface::move(Vector2& uv, const Vector3& target, Vector3& normal) const {
  Vector3 walked = on_.surface.move(uv, target, normal);
  const SurfaceLocator::Place found = on_.locator.nearest(patch_, target);
  constexpr double closer = 1 - 1e-9;
  if ((found.point - target).norm() >= closer * (walked - target).norm()) return walked;
  Vector2 place(found.triangle, 0);
  Vector3 there;
  on_.surface.move(place, found.point, there);
  if (there.dot(normal) <= 0) return walked;  // another sheet of the surface
  uv = place;
  normal = there;
  return found.point;
}

PatchQuads quads_on_patch(PatchTriangles triangles, const PatchSurface& on, const RecombineOptions& recombine,
                          const ImproveOptions& improve, ExecutionContext& context) {
  return PatchMesher(std::move(triangles), on, context).run(recombine, improve);
}

}  // namespace quadrille
