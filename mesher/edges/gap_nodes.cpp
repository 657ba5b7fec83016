/// Finds segments face to face by box intersection and moves their nodes along the edges towards a match.

// CGAL first: OpenCASCADE defines a macro named Handle.
#include <CGAL/box_intersection_d.h>

#include "mesher/edges/gap_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// A segment of the mesh that is recombined.
struct Segment {
  EdgeId edge;
  int wire;
  int first, last;  ///< indices of its nodes on the edge
  Vector3 a, b;

  double length() const { return (b - a).norm(); }
};

class GapNodes {
 public:
  GapNodes(const CadShape& shape, const FaceFlags& used, BoundaryNodes& nodes)
      : shape_(shape), used_(used), nodes_(nodes), ties_(nodes.edges.size()) {}

  void run(const FaceOutlines& sides, const FaceFlags& unaligned) {
    for (const FaceId face : shape_.faces.ids()) {
      if (used_[face] && !unaligned[face] && !sides[face].is_filled() && shape_.faces[face].wires.size() > 1)
        find_pairs(face);
    }
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    for (const Pair& pair : pairs_) align(pair);
    for (const EdgeId edge : ties_.ids()) {
      if (!ties_[edge].empty()) move_nodes(edge);
    }
  }

 private:
  /// A node and the segment that it faces across the gap.
  struct Pair {
    double distance;
    EdgeId edge;
    int place;  ///< index of the node on `edge`
    EdgeId other;
    int first;  ///< index of the segment's first node on `other`
  };

  /// The current place of a node of the mesh that is recombined.
  struct Tie {
    bool settled = false;  ///< the node must not move any more
    double parameter = 0;
  };

  void find_pairs(FaceId face) {
    std::vector<Segment> segments;
    int wires = 0;
    for (const CadWire& wire : shape_.faces[face].wires) {
      ++wires;
      for (const Coedge& coedge : wire.coedges) {
        const BoundaryNodes::Edge& edge = nodes_.edges[coedge.edge];
        const int stride = edge.stride;
        if (edge.nodes.empty() || edge.segments() % stride != 0) continue;
        for (int i = 0; i + stride <= edge.segments(); i += stride)
          segments.push_back({coedge.edge, wires, i, i + stride, point(edge, i), point(edge, i + stride)});
      }
    }
    std::vector<Box> boxes;
    boxes.reserve(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i)
      boxes.push_back(box_about(segments[i], static_cast<int>(i)));
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      const Segment &s = segments[a.info()], &t = segments[b.info()];
      if (s.wire == t.wire) return;
      for (const int i : {s.first, s.last}) add_pair(s.edge, i, t);
      for (const int i : {t.first, t.last}) add_pair(t.edge, i, s);
    });
  }

  Vector3 point(const BoundaryNodes::Edge& edge, int i) const { return nodes_.points[edge.nodes[i]]; }

  static Box box_about(const Segment& segment, int number) {
    const double reach = 0.5 * widest_gap * segment.length();
    const Vector3 low = segment.a.cwiseMin(segment.b).array() - reach;
    const Vector3 high = segment.a.cwiseMax(segment.b).array() + reach;
    std::array<double, 3> from{low.x(), low.y(), low.z()}, to{high.x(), high.y(), high.z()};
    return {CGAL::Bbox_3(from[0], from[1], from[2], to[0], to[1], to[2]), number};
  }

  /// The share of a segment from a to b at which a point projects onto it.
  static double share_along(const Vector3& a, const Vector3& b, const Vector3& point) {
    const Vector3 along = b - a;
    return (point - a).dot(along) / along.squaredNorm();
  }

  void add_pair(EdgeId edge, int place, const Segment& across) {
    const BoundaryNodes::Edge &own = nodes_.edges[edge], &other = nodes_.edges[across.edge];
    const int node = own.nodes[place];
    if (node == other.nodes[across.first] || node == other.nodes[across.last]) return;
    const Vector3 at = nodes_.points[node];
    const double share = share_along(across.a, across.b, at);
    if (!(share >= 0 && share <= 1)) return;
    const double distance = (at - across.a - share * (across.b - across.a)).norm();
    if (distance < widest_gap * across.length())
      pairs_.push_back({distance, edge, place, across.edge, across.first});
  }

  std::vector<Tie>& ties(EdgeId edge) {
    std::vector<Tie>& ties = ties_[edge];
    const BoundaryNodes::Edge& own = nodes_.edges[edge];
    if (!ties.empty()) return ties;
    ties.resize(own.segments() / own.stride + 1);
    for (std::size_t k = 0; k < ties.size(); ++k) ties[k].parameter = own.parameters[k * own.stride];
    ties.front().settled = ties.back().settled = true;
    for (Tie& tie : ties) tie.settled |= own.kept || own.copied || own.borrows();
    return ties;
  }

  void align(const Pair& pair) {
    std::vector<Tie>&own = ties(pair.edge), &others = ties(pair.other);
    const int k = pair.place / nodes_.edges[pair.edge].stride;
    const int i = pair.first / nodes_.edges[pair.other].stride;
    const EdgeCurve curve(shape_.edges[pair.edge]), across(shape_.edges[pair.other]);
    const Vector3 at = curve.point(own[k].parameter);
    const double from = others[i].parameter, to = others[i + 1].parameter;
    const double share = share_along(across.point(from), across.point(to), at);
    if (!(share >= 0 && share <= 1)) return;
    const int facing = share < 0.5 ? i : i + 1;
    if (!others[facing].settled) {
      if (place(others, facing, from + share * (to - from))) own[k].settled = true;
      return;
    }
    if (own[k].settled) return;
    const Vector3 fixed = across.point(others[facing].parameter);
    for (const int j : {k - 1, k}) {
      const double low = own[j].parameter, high = own[j + 1].parameter;
      const double back = share_along(curve.point(low), curve.point(high), fixed);
      const bool near = j == k ? back >= 0 && back <= 0.5 : back >= 0.5 && back <= 1;
      if (near && place(own, k, low + back * (high - low))) return;
    }
  }

  /// Moves a node along its edge if that leaves room on both sides.
  static bool place(std::vector<Tie>& ties, int k, double parameter) {
    constexpr double room = 0.4;
    const double low = ties[k - 1].parameter, high = ties[k + 1].parameter, at = ties[k].parameter;
    if (parameter - low < room * (at - low) || high - parameter < room * (high - at)) return false;
    ties[k] = {true, parameter};
    return true;
  }

  /// Neighbors of moved nodes follow by decreasing amounts. Nodes inside segments keep their shares.
  void move_nodes(EdgeId edge) {
    constexpr int fading = 3;
    BoundaryNodes::Edge& own = nodes_.edges[edge];
    const std::vector<Tie>& ties = ties_[edge];
    const std::vector<double> before = own.parameters;
    const int n = static_cast<int>(ties.size()) - 1;
    std::vector<double> shifts(n + 1, 0);
    for (int k = 0; k <= n; ++k) shifts[k] = ties[k].parameter - before[k * own.stride];
    const auto is_fixed = [&](int k) { return k < 0 || k > n || ties[k].settled; };
    std::vector<double> result = shifts;
    for (int k = 1; k < n; ++k) {
      if (ties[k].settled) continue;
      int down = 1, up = 1;
      while (down < fading && !is_fixed(k - down)) ++down;
      while (up < fading && !is_fixed(k + up)) ++up;
      result[k] = (shifts[k - down] * up + shifts[k + up] * down) / (down + up);
    }
    if (std::all_of(result.begin(), result.end(), [](double shift) { return shift == 0; })) return;
    for (int k = 0; k <= n; ++k) own.parameters[k * own.stride] = before[k * own.stride] + result[k];
    for (int i = 0; i < own.segments(); ++i) {
      const int k = i - i % own.stride;
      if (i == k) continue;
      const double share = (before[i] - before[k]) / (before[k + own.stride] - before[k]);
      own.parameters[i] = own.parameters[k] + share * (own.parameters[k + own.stride] - own.parameters[k]);
    }
    const EdgeCurve curve(shape_.edges[edge]);
    for (int i = 1; i < own.segments(); ++i) nodes_.points[own.nodes[i]] = curve.point(own.parameters[i]);
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  BoundaryNodes& nodes_;
  std::vector<Pair> pairs_;
  IdVector<EdgeId, std::vector<Tie>> ties_;  ///< one per node of the mesh that is recombined
};

}  // namespace

void align_gaps(const CadShape& shape, const FaceFlags& used, const FaceOutlines& sides,
                const FaceFlags& unaligned, BoundaryNodes& nodes) {
  GapNodes(shape, used, nodes).run(sides, unaligned);
}

}  // namespace quadrille
