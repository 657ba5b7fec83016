/// Searches a tree of boxes over the surface triangles for the first one that a ray meets on its way out.

#include "geometry/sizing/wall_rays.hpp"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/surfaces/surface_triangles.hpp"

namespace quadrille {

namespace {

using Box = Eigen::AlignedBox3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Cosine of the largest angle at which skins face each other, as in FaceGaps.
const double facing_wall = std::cos(40 * M_PI / 180);
/// Largest distance of triangles from the surface, as a share of the narrowest thickness.
constexpr double deflection_share = 0.05;
constexpr double turn_of_triangle = 0.2;

double signed_volume(const SurfaceTriangles& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += surface.points[a].dot(surface.points[b].cross(surface.points[c])) / 6;
  return sum;
}

}  // namespace

struct WallRays::Tree {
  SurfaceTriangles surface;
  Eigen::KdBVH<double, 3, int> boxes;
  bool inside_out = false;
};

namespace {

/// The first triangle through which a ray leaves the material, for Eigen's BVMinimize.
struct Exit {
  using Scalar = double;
  const SurfaceTriangles& surface;
  Vector3 from, way;  ///< `way`: unit vector
  bool inside_out;
  double nearest = infinity;
  double cosine = 0;  ///< cosine of the angle between the ray and the outward normal there

  /// Distance at which the ray enters a box; infinite if it misses the box.
  Scalar minimumOnVolume(const Box& box) const {
    double first = 0, last = infinity;
    for (int axis = 0; axis < 3; ++axis) {
      if (way[axis] == 0) {
        if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) return infinity;
        continue;
      }
      const double a = (box.min()[axis] - from[axis]) / way[axis],
                   b = (box.max()[axis] - from[axis]) / way[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first <= last ? first : infinity;
  }

  /// Möller and Trumbore (1997). Triangles are slightly enlarged, so that no ray passes between two.
  Scalar minimumOnObject(int triangle) {
    const auto& [a, b, c] = surface.triangles[triangle];
    const Vector3 ab = surface.points[b] - surface.points[a], ac = surface.points[c] - surface.points[a];
    const Vector3 normal = ab.cross(ac), aside = way.cross(ac), offset = from - surface.points[a];
    const double volume = ab.dot(aside);
    const double leaving = (inside_out ? -1 : 1) * way.dot(normal);
    if (!(leaving > 0) || volume == 0) return infinity;  // the skin that the ray starts from, or edge-on
    constexpr double beyond = 1e-9;
    const double u = offset.dot(aside) / volume;
    const Vector3 across = offset.cross(ab);
    const double v = way.dot(across) / volume, t = ac.dot(across) / volume;
    if (u < -beyond || v < -beyond || u + v > 1 + beyond || !(t > 0) || t >= nearest) return infinity;
    nearest = t;
    cosine = leaving / normal.norm();
    return t;
  }
};

}  // namespace

WallRays::WallRays(const CadShape& shape, double narrowest, const ExecutionContext& context)
    : tree_(std::make_unique<Tree>()) {
  tree_->surface = triangulate_surface(shape, deflection_share * narrowest, turn_of_triangle,
                                       FaceFlags(shape.faces.size(), 1), context);
  const SurfaceTriangles& surface = tree_->surface;
  std::vector<Box> boxes;
  std::vector<int> numbers;
  for (const auto& nodes : surface.triangles) {
    Box box;
    for (const int node : nodes) box.extend(surface.points[node]);
    numbers.push_back(static_cast<int>(boxes.size()));
    boxes.push_back(box);
  }
  tree_->inside_out = signed_volume(surface) < 0;
  tree_->boxes.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

WallRays::~WallRays() = default;

std::optional<double> WallRays::thickness(const Vector3& point, const Vector3& inward, double widest) const {
  if (tree_->surface.triangles.empty()) return std::nullopt;
  Exit exit{tree_->surface, point, (tree_->inside_out ? -1 : 1) * inward, tree_->inside_out, widest};
  Eigen::BVMinimize(tree_->boxes, exit);
  if (exit.nearest >= widest || exit.cosine < facing_wall) return std::nullopt;
  return exit.nearest;
}

}  // namespace quadrille
