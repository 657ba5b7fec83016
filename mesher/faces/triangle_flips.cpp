/// Flips in space until triangles face along the surface normals and are Delaunay, by cotangents.

#include "mesher/faces/face_triangulation.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "mesher/mesh/sides.hpp"

namespace quadrille {

std::vector<int> triangle_neighbors(const std::vector<std::array<int, 3>>& triangles, int points,
                                    const ExecutionContext& context) {
  std::vector<int> neighbor(3 * triangles.size(), -1);
  const auto number = [](Side side) { return 3 * element_of(side) + index_of(side); };
  const auto join = [&](int, int, std::span<const Side> sides) {
    if (sides.size() != 2) return;
    neighbor[number(sides[0])] = number(sides[1]);
    neighbor[number(sides[1])] = number(sides[0]);
  };
  for_each_shared_side(points, SparseCheck(context), join, triangles);
  return neighbor;
}

namespace {

/// Flips sides in space.
class SpaceFlipper {
 public:
  /// \param across neighbors in the form of triangle_neighbors(), see flip_in_space().
  SpaceFlipper(FaceTriangulation& face, std::vector<int> across, const ExecutionContext& context)
      : triangles_(face.mesh.triangles),
        points_(face.mesh.points),
        normals_(face.normals),
        check_(context),
        across_(std::move(across)) {
    for (const auto& segment : face.segments) {
      if (segment.internal) kept_.insert(std::minmax(segment.a, segment.b));
    }
  }

  void run() {
    std::vector<int> queue(across_.size());
    for (std::size_t i = 0; i < queue.size(); ++i) queue[i] = static_cast<int>(i);
    const std::size_t bound = 30 * across_.size() + 1000;
    for (std::size_t k = 0; k < queue.size() && k < bound; ++k) {
      check_();
      const int side = queue[k];
      if (!improves(side)) continue;
      flip(side);
      const int t = side / 3, u = across_[side] / 3;
      for (int i = 0; i < 3; ++i) {
        queue.push_back(3 * t + i);
        queue.push_back(3 * u + i);
      }
    }
  }

 private:
  int corner(int side, int k) const { return triangles_[side / 3][(side % 3 + k) % 3]; }

  Vector3 area_normal(int a, int b, int c) const {
    return (points_[b] - points_[a]).cross(points_[c] - points_[a]);
  }

  /// The cosine between a triangle's normal and the mean surface normal at its corners; -1 if it has no area.
  double facing(int a, int b, int c) const {
    const Vector3 n = area_normal(a, b, c);
    const double length = n.norm();
    const double scale = (points_[b] - points_[a]).squaredNorm() + (points_[c] - points_[a]).squaredNorm();
    if (!(length > 1e-10 * scale)) return -1;
    return n.dot((normals_[a] + normals_[b] + normals_[c]).normalized()) / length;
  }

  /// Cotangent of the angle at c, opposite the side a b.
  double cotangent(int a, int b, int c) const {
    const Vector3 x = points_[a] - points_[c], y = points_[b] - points_[c];
    return x.dot(y) / std::max(x.cross(y).norm(), 1e-300);
  }

  /// Whether a flip turns badly facing triangles the right way, or satisfies the Delaunay criterion.
  bool improves(int side) const {
    const int other = across_[side];
    if (other < 0) return false;
    const int a = corner(side, 0), b = corner(side, 1), c = corner(side, 2), d = corner(other, 2);
    if (c == d || (!kept_.empty() && kept_.contains(std::minmax(a, b)))) return false;
    const double now = std::min(facing(a, b, c), facing(b, a, d));
    const double then = std::min(facing(c, d, b), facing(d, c, a));
    if (now < 0.1) return then > now + 0.05 && !has_side(side, c, d);
    if (then < std::min(0.3, 0.8 * now)) return false;
    return cotangent(a, b, c) + cotangent(a, b, d) < -1e-7 && !has_side(side, c, d);
  }

  /// Whether a side near either end of this one joins c and d already (only possible at low valence).
  bool has_side(int side, int c, int d) const {
    for (const int start : {side, across_[side]}) {
      int s = start;  // walk around the first corner of this side
      for (int k = 0; k < 8; ++k) {
        // Whether the side opposite the corner joins them.
        if (std::minmax(corner(s, 1), corner(s, 2)) == std::minmax(c, d)) return true;
        const int previous = 3 * (s / 3) + (s % 3 + 2) % 3;
        s = across_[previous];
        if (s < 0 || s == start) break;
      }
    }
    return false;
  }

  void link(int side, int other) {
    across_[side] = other;
    if (other >= 0) across_[other] = side;
  }

  /// Triangles (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d).
  void flip(int side) {
    const int other = across_[side], t = side / 3, u = other / 3;
    const auto next = [](int s) { return 3 * (s / 3) + (s % 3 + 1) % 3; };
    const int a = corner(side, 0), b = corner(side, 1), c = corner(side, 2), d = corner(other, 2);
    const int bc = across_[next(side)], ca = across_[next(next(side))];
    const int ad = across_[next(other)], db = across_[next(next(other))];
    triangles_[t] = {d, b, c};
    triangles_[u] = {c, a, d};
    link(3 * t, db);
    link(3 * t + 1, bc);
    link(3 * t + 2, 3 * u + 2);
    link(3 * u, ca);
    link(3 * u + 1, ad);
  }

  std::vector<std::array<int, 3>>& triangles_;
  const std::vector<Vector3>& points_;
  const std::vector<Vector3>& normals_;
  SparseCheck check_;
  std::vector<int> across_;
  std::set<std::pair<int, int>> kept_;
};

}  // namespace

void flip_in_space(FaceTriangulation& face, std::vector<int> across, const ExecutionContext& context) {
  SpaceFlipper(face, std::move(across), context).run();
}

}  // namespace quadrille
