/// Pairs the patch's triangles, improves the quads, splits each into four and smooths again on the surface.

#include "mesher/remesh/patch_quads.hpp"

#include <algorithm>
#include <unordered_map>

#include "geometry/base/side_key.hpp"
#include "mesher/faces/face_boundary.hpp"
#include "mesher/pairing/recombine.hpp"
#include "mesher/quads/improve.hpp"
#include "mesher/quads/subdivision.hpp"
#include "mesher/quads/unfold_in_space.hpp"

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
    const std::vector<char> moved = unfold_in_space(fine_.mesh, fine_.fixed, context_);
    result.off_surface = static_cast<int>(std::count(moved.begin(), moved.end(), 1));
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
