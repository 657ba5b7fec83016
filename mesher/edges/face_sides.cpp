/// Finds outlines that grids fill: with four corners, or two loops without.

#include "mesher/edges/face_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

constexpr double corner_turning = 0.7;  // radians; a right-angled corner turns by pi / 2
constexpr double smooth_turning = 0.6;  // radians; largest turn at other vertices

/// A wire without the edges that are left out of the mesh.
struct Walk {
  std::vector<int> coedges;  // indices into the wire
  std::vector<SideEdge> edges;
  std::vector<double> turnings;  // turn at the start of each edge, radians, positive to the left
};

/// How much the boundary of a face turns from a coedge to the next one: radians, positive to the left.
double turning_at(const CadShape& shape, const FaceSurface& surface, const Coedge& from, const Coedge& to) {
  const CadEdge &before = shape.edges[from.edge], &after = shape.edges[to.edge];
  const double t = to.forward ? after.first : after.last;
  const Vector3 in = (from.forward ? 1 : -1) *
                     EdgeCurve(before).derivative(from.forward ? before.last : before.first),
                out = (to.forward ? 1 : -1) * EdgeCurve(after).derivative(t);
  const Vector3 normal = surface.normal(parametric_point(to, t));
  return std::atan2(in.cross(out).dot(normal), in.dot(out));
}

class SideFinder {
 public:
  SideFinder(const CadShape& shape, const TinyFeatures& tiny, const IdVector<EdgeId, double>& wanted)
      : shape_(shape), tiny_(tiny), wanted_(wanted) {}

  FaceSides find(FaceId id) const {
    const CadFace& face = shape_.faces[id];
    FaceSides sides;
    std::vector<Walk> walks;
    if (face.inner_vertices.empty()) walks = usable_walks(id);
    if (walks.size() == 1) take_corners(walks[0], sides);
    if (walks.size() == 2) take_ring(walks[0], walks[1], sides);
    if (walks.size() >= 2 && sides.facing.empty()) take_holes(walks, sides);
    if (sides.facing.empty()) sides.rest = face.edges();
    return sides;
  }

 private:
  /// The wires; none if one is unordered or has cracks or poles, or if nothing of it is left.
  std::vector<Walk> usable_walks(FaceId id) const {
    const CadFace& face = shape_.faces[id];
    std::vector<Walk> walks;
    const FaceSurface surface(face);
    for (const CadWire& wire : face.wires) {
      const std::vector<const Coedge*> coedges = coedges_left(shape_, tiny_, id, wire);
      if (coedges.empty()) return {};
      Walk& walk = walks.emplace_back();
      const Coedge* before = coedges.back();
      for (const Coedge* coedge : coedges) {
        walk.coedges.push_back(static_cast<int>(coedge - wire.coedges.data()));
        walk.edges.push_back({coedge->edge, coedge->forward});
        walk.turnings.push_back(turning_at(shape_, surface, *std::exchange(before, coedge), *coedge));
      }
    }
    return walks;
  }

  /// The vertices where the boundary turns by about a right angle; nothing if another one is not smooth.
  static std::optional<std::vector<int>> corners_of(const Walk& walk) {
    std::vector<int> corners;
    for (int k = 0; k < static_cast<int>(walk.turnings.size()); ++k) {
      const double turning = walk.turnings[k];
      if (turning > corner_turning) {
        corners.push_back(k);
      } else if (std::abs(turning) > smooth_turning) {
        return std::nullopt;
      }
    }
    return corners;
  }

  static FaceSide between(const Walk& walk, int from, int to) {
    FaceSide side;
    const int n = static_cast<int>(walk.edges.size());
    for (int k = from; side.empty() || k != to; k = (k + 1) % n) side.push_back(walk.edges[k]);
    return side;
  }

  /// Finds outlines with four corners.
  void take_corners(const Walk& walk, FaceSides& sides) const {
    const auto corners = corners_of(walk);
    sides.may_be_odd = corners && (corners->size() == 3 || corners->size() == 5);
    if (!corners || corners->size() != 4) return;
    for (const int corner : *corners) sides.starts.push_back(walk.coedges[corner]);
    sides.kind = GridKind::four;
    std::array<FaceSide, 4> four;
    for (int c = 0; c < 4; ++c) four[c] = between(walk, (*corners)[c], (*corners)[(c + 1) % 4]);
    add_pairs(four[0], turned(four[2]), sides);
    sides.across = sides.facing.size();
    add_pairs(four[1], turned(four[3]), sides);
  }

  static bool is_smooth(const Walk& walk) {
    return std::ranges::all_of(walk.turnings,
                               [](double turning) { return std::abs(turning) <= smooth_turning; });
  }

  /// Finds outlines with four corners outside and none at the holes.
  void take_holes(const std::vector<Walk>& walks, FaceSides& sides) const {
    if (std::ranges::count_if(walks, is_smooth) != std::ssize(walks) - 1) return;
    const auto outer = std::ranges::find_if_not(walks, is_smooth);
    FaceSides found;
    take_corners(*outer, found);
    if (found.kind != GridKind::four) return;
    sides = std::move(found);
    sides.kind = GridKind::holed;
    sides.outer = static_cast<int>(outer - walks.begin());
    for (auto walk = walks.begin(); walk != walks.end(); ++walk) {
      if (walk == outer) continue;
      for (const SideEdge& edge : walk->edges) sides.rest.push_back(edge.edge);
    }
  }

  /// Finds two loops without corners. Their sides start at the two vertices that are nearest to each other.
  void take_ring(const Walk& first, const Walk& second, FaceSides& sides) const {
    if (!is_smooth(first) || !is_smooth(second)) return;
    std::size_t a = 0, b = 0;
    double nearest = std::numeric_limits<double>::infinity();
    const FaceSide back = turned(second.edges);
    for (std::size_t i = 0; i < first.edges.size(); ++i) {
      for (std::size_t k = 0; k < back.size(); ++k) {
        const double distance = (start_of(first.edges[i]) - start_of(back[k])).norm();
        if (distance < nearest) {
          nearest = distance;
          a = i;
          b = k;
        }
      }
    }
    FaceSide one = first.edges, other = back;
    std::rotate(one.begin(), one.begin() + static_cast<long>(a), one.end());
    std::rotate(other.begin(), other.begin() + static_cast<long>(b), other.end());
    if (!is_even_ring(one, other)) return;
    sides.kind = GridKind::ring;
    add_pairs(one, other, sides);
  }

  /// Whether two loops neither touch nor lie far off center.
  bool is_even_ring(const FaceSide& one, const FaceSide& other) const {
    constexpr double narrowest = 0.3;  // least width over largest width
    const std::vector<Vector3> a = points_along(one), b = points_along(other);
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Vector3& p : a) {
      double width = std::numeric_limits<double>::infinity();
      for (const Vector3& q : b) width = std::min(width, (p - q).norm());
      least = std::min(least, width);
      most = std::max(most, width);
    }
    return least > narrowest * most;
  }

  std::vector<Vector3> points_along(const FaceSide& side) const {
    constexpr int samples = 64;
    const int each = std::max(4, samples / static_cast<int>(side.size()));
    std::vector<Vector3> points;
    for (const SideEdge& part : side) {
      const std::vector<Vector3> own = quadrille::points_along(shape_.edges[part.edge], each);
      points.insert(points.end(), own.begin(), own.end() - 1);
    }
    return points;
  }

  static FaceSide turned(FaceSide side) {
    std::ranges::reverse(side);
    for (SideEdge& edge : side) edge.forward = !edge.forward;
    return side;
  }

  Vector3 start_of(const SideEdge& side) const {
    const CadEdge& edge = shape_.edges[side.edge];
    return EdgeCurve(edge).point(side.forward ? edge.first : edge.last);
  }

  /// The ends of a side's edges, as shares of the side's length.
  std::vector<double> ends_of(const FaceSide& side) const {
    std::vector<double> ends;
    for (const SideEdge& edge : side)
      ends.push_back((ends.empty() ? 0 : ends.back()) + shape_.edges[edge.edge].length);
    for (double& end : ends) end /= std::max(ends.back(), std::numeric_limits<double>::min());
    return ends;
  }

  /// Cuts two sides into pairs where their vertices face each other.
  void add_pairs(const FaceSide& first, const FaceSide& second, FaceSides& sides) const {
    const std::vector<double> a = ends_of(first), b = ends_of(second);
    constexpr double of_segment = 0.4, of_side = 0.05;
    const double wanted = std::max(sum_over(first, wanted_), sum_over(second, wanted_));
    const double near = std::min(of_side, of_segment / std::max(1.0, wanted));
    FacingPair pair;
    std::size_t i = 0, k = 0;
    while (i < a.size() || k < b.size()) {
      const bool both = i < a.size() && k < b.size() && std::abs(a[i] - b[k]) <= near;
      const bool take_first = k == b.size() || (i < a.size() && (both || a[i] < b[k]));
      const bool take_second = i == a.size() || (k < b.size() && (both || !(a[i] < b[k])));
      if (take_first) pair.first.push_back(first[i++]);
      if (take_second) pair.second.push_back(second[k++]);
      if (both) {
        sides.facing.push_back(pair);
        pair = {};
      }
    }
    if (pair.first.empty() && pair.second.empty()) return;
    // The last edge is so short that its start already faced the end of the other side.
    if (sides.facing.empty()) sides.facing.emplace_back();
    auto& last = sides.facing.back();
    last.first.insert(last.first.end(), pair.first.begin(), pair.first.end());
    last.second.insert(last.second.end(), pair.second.begin(), pair.second.end());
  }

  const CadShape& shape_;
  const TinyFeatures& tiny_;
  const IdVector<EdgeId, double>& wanted_;
};

}  // namespace

FaceSide FacingPair::edges() const {
  FaceSide result = first;
  result.insert(result.end(), second.begin(), second.end());
  return result;
}

std::vector<EdgeId> FaceSides::facing_edges() const {
  std::vector<EdgeId> result;
  for (const FacingPair& pair : facing)
    for (const SideEdge& edge : pair.edges()) result.push_back(edge.edge);
  return result;
}

void FaceSides::drop_facing() {
  const std::vector<EdgeId> edges = facing_edges();
  rest.insert(rest.end(), edges.begin(), edges.end());
  facing.clear();
  kind = GridKind::other;
}

FaceOutlines find_face_sides(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny,
                             const IdVector<EdgeId, double>& wanted) {
  const SideFinder finder(shape, tiny, wanted);
  FaceOutlines result(shape.faces.size());
  for (const FaceId face : result.ids()) {
    if (used[face]) result[face] = finder.find(face);
  }
  return result;
}

}  // namespace quadrille
