/// Nearest point on a triangle: Ericson, Real-Time Collision Detection (2005), section 5.1.5.

#include "mesher/quads/triangulated_surface.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

namespace quadrille {

TriangulatedSurface::TriangulatedSurface(TriangleMesh patch)
    : twins_(patch.triangles.size(), {-1, -1, -1}),
      normals_(patch.points.size(), Vector3::Zero()),
      triangle_at_(patch.points.size(), -1),
      boundary_(patch.points.size(), 0) {
  patch.tags.clear();
  join_twins(patch, [this](Side a, Side b) {
    twins_[triangle_of(a)][index_of(a)] = b;
    twins_[triangle_of(b)][index_of(b)] = a;
  });
  points_ = std::move(patch.points);
  triangles_ = std::move(patch.triangles);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const Vector3 area = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    for (int i = 0; i < 3; ++i) {
      const int v = triangles_[t][i];
      normals_[v] += area;
      triangle_at_[v] = static_cast<int>(t);
      if (twins_[t][i] < 0) boundary_[v] = boundary_[triangles_[t][next_index(i)]] = 1;
    }
  }
  for (Vector3& normal : normals_) normal.normalize();
}

TriangulatedSurface::Nearest TriangulatedSurface::nearest_on(int triangle, const Vector3& target) const {
  const auto& corners = triangles_[triangle];
  const Vector3 &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
  const Vector3 ab = b - a, ac = c - a, ap = target - a;
  const double aa = ab.squaredNorm(), cc = ac.squaredNorm(), mixed = ab.dot(ac);
  const double along_b = ap.dot(ab), along_c = ap.dot(ac);
  const double area = aa * cc - mixed * mixed;
  // The area of a triangle that is almost a line is lost in rounding errors. Never divide by it.
  const bool is_line = !(area > 1e-10 * aa * cc);
  Vector3 weights(1, 0, 0);
  if (!is_line) {
    const double v = (cc * along_b - mixed * along_c) / area, w = (aa * along_c - mixed * along_b) / area;
    weights = {1 - v - w, v, w};
  }
  if (is_line || weights.minCoeff() < 0) {
    double best = -1;
    for (int i = 0; i < 3; ++i) {
      const int j = next_index(i);
      const Vector3 side = points_[corners[j]] - points_[corners[i]];
      const double length = side.squaredNorm();
      const double s =
          length > 0 ? std::clamp((target - points_[corners[i]]).dot(side) / length, 0.0, 1.0) : 0;
      const double distance = (points_[corners[i]] + s * side - target).squaredNorm();
      if (best >= 0 && distance >= best) continue;
      best = distance;
      weights.setZero();
      weights[i] = 1 - s;
      weights[j] = s;
    }
  }
  return {(weights[0] * a + weights[1] * b + weights[2] * c - target).squaredNorm(), weights};
}

Vector3 TriangulatedSurface::move(Vector2& uv, const Vector3& target, Vector3& normal) const {
  // A few steps may come no closer while the walk turns around a point.
  constexpr int max_steps = 200, max_idle = 4;
  int at = static_cast<int>(uv.x()), best = at, came_from = -1;
  Nearest found = nearest_on(at, target), here = found;
  for (int step = 0, idle = 0; step < max_steps && idle < max_idle; ++step) {
    if (here.weights.minCoeff() > 0) break;
    int next = -1;
    Nearest there{};
    for (int i = 0; i < 3; ++i) {
      // Only sides that the nearest point lies on lead closer.
      const Side twin = twins_[at][i];
      if (here.weights[previous_index(i)] > 0 || twin < 0 || triangle_of(twin) == came_from) continue;
      const Nearest candidate = nearest_on(triangle_of(twin), target);
      if (next >= 0 && candidate.squared_distance >= there.squared_distance) continue;
      next = triangle_of(twin);
      there = candidate;
    }
    if (next < 0) break;
    came_from = at;
    at = next;
    here = there;
    if (here.squared_distance < found.squared_distance * (1 - 1e-12)) {
      found = here;
      best = at;
      idle = 0;
    } else {
      ++idle;
    }
  }
  uv = {best, 0};
  const auto& [a, b, c] = triangles_[best];
  const Vector3& w = found.weights;
  normal = (w[0] * normals_[a] + w[1] * normals_[b] + w[2] * normals_[c]).normalized();
  return w[0] * points_[a] + w[1] * points_[b] + w[2] * points_[c];
}

namespace {

/// The elements of one tag, with their own numbering of the points.
struct Patch {
  TriangleMesh triangulation;
  QuadMesh quads;
  std::vector<int> global;  ///< (points of the patch) index of the point in the whole
};

/// The elements of each tag, in the order of the mesh.
template <class Element>
std::map<int, std::vector<int>> by_tag(const std::vector<Element>& elements, const std::vector<int>& tags) {
  std::map<int, std::vector<int>> result;
  for (std::size_t e = 0; e < elements.size(); ++e)
    result[tags.empty() ? 0 : tags[e]].push_back(static_cast<int>(e));
  return result;
}

/// Marks the points that triangles of more than one tag use, and those that must keep their places.
std::vector<char> points_that_stay(const TriangleMesh& mesh) {
  std::vector<char> several = mesh.fixed;
  several.resize(mesh.points.size(), 0);
  if (mesh.tags.empty()) return several;
  std::vector<int> first(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int v : mesh.triangles[t]) {
      if (first[v] < 0) first[v] = static_cast<int>(t);
      if (mesh.tags[first[v]] != mesh.tags[t]) several[v] = 1;
    }
  }
  return several;
}

bool is_level(const TriangleMesh& patch) {
  const double z = patch.points.front().z();
  if (std::any_of(patch.points.begin(), patch.points.end(), [z](const Vector3& p) { return p.z() != z; }))
    return false;
  return std::all_of(patch.triangles.begin(), patch.triangles.end(), [&](const auto& t) {
    const Vector3 ab = patch.points[t[1]] - patch.points[t[0]], ac = patch.points[t[2]] - patch.points[t[0]];
    return ab.cross(ac).z() >= 0;
  });
}

/// Improves one patch.
/// \param shared points of the whole mesh that several tags use or that stay.
/// \param fixed out: the patch's points that kept their place, in the order of the result.
SurfaceMesh improve_patch(Patch& patch, const std::vector<char>& shared, const ImproveOptions& options,
                          std::vector<int>& fixed, ExecutionContext& context) {
  const TriangulatedSurface triangulated(patch.triangulation);
  std::unique_ptr<MeshSurface> level;
  if (is_level(patch.triangulation))
    level = std::make_unique<PlanarSurface>(patch.triangulation.points.front().z());
  const MeshSurface& surface = level ? *level : static_cast<const MeshSurface&>(triangulated);
  SurfaceMesh mesh;
  mesh.mesh = std::move(patch.quads);
  mesh.mesh.points = patch.triangulation.points;
  for (int v = 0; v < static_cast<int>(mesh.mesh.points.size()); ++v) {
    const Vector3& p = mesh.mesh.points[v];
    mesh.parameters.push_back(level ? Vector2(p.x(), p.y()) : triangulated.parameters_of(v));
    mesh.normals.push_back(level ? Vector3(0, 0, 1) : triangulated.normal_of(v));
    mesh.fixed.push_back(triangulated.on_boundary(v) || shared[patch.global[v]] ? 1 : 0);
    if (mesh.fixed.back()) fixed.push_back(v);
  }
  if (options.clean_up) {
    clean_up(mesh, surface, options, context);
  } else {
    // Without clean-up nothing is renumbered: all points are where they were.
    fixed.resize(mesh.mesh.points.size());
    std::iota(fixed.begin(), fixed.end(), 0);
  }
  smooth(mesh, surface, options, context);
  return mesh;
}

}  // namespace

QuadMesh improve_on(const TriangleMesh& triangulation, const QuadMesh& quads, const ImproveOptions& options,
                    std::vector<int>& renumbered, ExecutionContext& context) {
  QuadMesh result;
  std::vector<int> local(triangulation.points.size(), -1);  // number in the patch at hand
  renumbered.assign(triangulation.points.size(), -1);
  const auto triangles_by_tag = by_tag(triangulation.triangles, triangulation.tags);
  auto quads_by_tag = by_tag(quads.quads, quads.quad_tags);
  auto left_by_tag = by_tag(quads.triangles, quads.triangle_tags);
  const bool tagged = !triangulation.tags.empty();
  const std::vector<char> shared = points_that_stay(triangulation);
  for (const auto& [tag, members] : triangles_by_tag) {
    context.check();
    Patch patch;
    const auto localise = [&](auto corners) {  // points are numbered in the order in which they come
      for (int& v : corners) {
        if (local[v] < 0) {
          local[v] = static_cast<int>(patch.global.size());
          patch.global.push_back(v);
          patch.triangulation.points.push_back(triangulation.points[v]);
        }
        v = local[v];
      }
      return corners;
    };
    for (int t : members) patch.triangulation.triangles.push_back(localise(triangulation.triangles[t]));
    for (int q : quads_by_tag[tag]) patch.quads.quads.push_back(localise(quads.quads[q]));
    for (int t : left_by_tag[tag]) patch.quads.triangles.push_back(localise(quads.triangles[t]));
    std::vector<int> fixed;
    const SurfaceMesh improved = improve_patch(patch, shared, options, fixed, context);
    // The fixed points come first, and patches share them; the others are the patch's own.
    std::vector<int> number(improved.mesh.points.size(), -1);
    for (std::size_t v = 0; v < number.size(); ++v) {
      const bool kept = v < fixed.size() && improved.fixed[v];
      int* known = kept ? &renumbered[patch.global[fixed[v]]] : nullptr;
      if (known && *known >= 0) {
        number[v] = *known;
        continue;
      }
      number[v] = static_cast<int>(result.points.size());
      if (known) *known = number[v];
      result.points.push_back(improved.mesh.points[v]);
    }
    for (const auto& quad : improved.mesh.quads) result.quads.push_back(with_numbers(quad, number));
    for (const auto& triangle : improved.mesh.triangles)
      result.triangles.push_back(with_numbers(triangle, number));
    if (tagged) {
      result.quad_tags.resize(result.quads.size(), tag);
      result.triangle_tags.resize(result.triangles.size(), tag);
    }
    for (const int v : patch.global) local[v] = -1;
  }
  return result;
}

}  // namespace quadrille
