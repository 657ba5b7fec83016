/// Makes points of edges below the reach, merges edges side by side, and drops faces that this empties.

#include "mesher/edges/tiny_features.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/base/vector.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

class Finder {
 public:
  Finder(const CadShape& shape, const FaceFlags& used, double length, const SliverChoice& slivers)
      : shape_(shape), used_(used), length_(length), slivers_(slivers) {
    for (const VertexId vertex : shape.vertices.ids()) tiny_.vertices.push_back(vertex);
    for (const EdgeId edge : shape.edges.ids()) tiny_.edges.push_back(edge);
    tiny_.collapsed_edges.resize(shape.edges.size());
    tiny_.reversed_edges.resize(shape.edges.size());
    tiny_.merged_faces.resize(shape.faces.size());
  }

  TinyFeatures run(const EdgeFlags& collapse) {
    for (const EdgeId id : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      if (!has_ends(edge) || !(edge.length > 0) || (!(edge.length < length_) && !collapse[id])) continue;
      tiny_.collapsed_edges[id] = 1;
      join(edge.first_vertex, edge.last_vertex);
    }
    for (const Sliver& sliver : slivers_.slivers) zip(sliver);
    for (const FaceId face : shape_.faces.ids()) {
      if (used_[face] && !tiny_.merged_faces[face]) merge(face);
    }
    resolve_edges();
    drop_edges_inside();
    return std::move(tiny_);
  }

 private:
  void join(VertexId first, VertexId second) {
    const VertexId a = tiny_.vertices[first], b = tiny_.vertices[second];
    if (a != b) std::ranges::replace(tiny_.vertices, std::max(a, b), std::min(a, b));
  }

  /// Makes a sliver an edge, all of it or nothing.
  void zip(const Sliver& sliver) {
    if (!used_[sliver.face] || is_set(slivers_.kept, sliver.face)) return;
    const auto is_open = [&](const auto& joint) { return tiny_.end(joint[0]) != tiny_.end(joint[1]); };
    const auto is_left = [&](EdgeId edge) { return !tiny_.collapsed_edges[edge]; };
    if (std::ranges::any_of(sliver.joints, is_open) || std::ranges::any_of(sliver.rims, is_left)) return;
    if (std::ranges::any_of(sliver.pairs, [&](const Sliver::Pair& pair) {
          return !is_left(pair.edge) || !is_left(pair.other) || keep_apart(pair.edge, pair.other);
        }))
      return;
    for (const auto& [a, b] : sliver.ties) join(a, b);
    for (const Sliver::Pair& pair : sliver.pairs) {
      share(pair.edge, pair.other, pair.reversed);
      if (sliver.is_spike) tiny_.folded.insert({{sliver.face, pair.edge}, {sliver.face, pair.other}});
    }
    tiny_.merged_faces[sliver.face] = static_cast<char>(!sliver.is_spike);
  }

  /// The edge whose nodes an edge has so far, and whether it runs in the opposite direction.
  std::pair<EdgeId, bool> lender(EdgeId edge) const {
    bool reversed = false;
    for (; tiny_.edges[edge] != edge; edge = tiny_.edges[edge]) reversed ^= tiny_.reversed_edges[edge] != 0;
    return {edge, reversed};
  }

  /// Whether both edges, or those whose nodes they have so far, keep their own nodes.
  bool keep_apart(EdgeId edge, EdgeId other) const {
    const EdgeId a = lender(edge).first, b = lender(other).first;
    return a != b && is_set(slivers_.own, a) && is_set(slivers_.own, b);
  }

  /// Gives an edge, and those that share its nodes already, the nodes of another one.
  void share(EdgeId edge, EdgeId other, bool reversed) {
    auto [from, from_reversed] = lender(edge);
    auto [to, to_reversed] = lender(other);
    if (from == to) return;
    if (is_set(slivers_.own, to)) std::swap(from, to);
    tiny_.edges[to] = from;
    tiny_.reversed_edges[to] = static_cast<char>(reversed ^ from_reversed ^ to_reversed);
  }

  /// Removes a face that is left with no edges, or with two that lie close together.
  void merge(FaceId face) {
    std::vector<EdgeId> left;
    bool any_collapsed = false;
    for (const EdgeId edge : shape_.faces[face].edges()) {
      any_collapsed |= tiny_.collapsed_edges[edge] != 0;
      if (tiny_.has(face, edge) && !shape_.edges[edge].degenerate) left.push_back(edge);
    }
    // A face without any collapsed edge is not tiny, even if all its edges are poles.
    if (left.empty() && any_collapsed) tiny_.merged_faces[face] = 1;
    if (left.size() != 2 || left[0] == left[1]) return;
    const CadEdge &a = shape_.edges[left[0]], &b = shape_.edges[left[1]];
    const bool along = tiny_.end(a.first_vertex) == tiny_.end(b.first_vertex) &&
                       tiny_.end(a.last_vertex) == tiny_.end(b.last_vertex);
    const bool against = tiny_.end(a.first_vertex) == tiny_.end(b.last_vertex) &&
                         tiny_.end(a.last_vertex) == tiny_.end(b.first_vertex);
    if (!(along || against) || !(distance_between(a, b) < length_) || keep_apart(left[0], left[1])) return;
    // Either direction fits the ends of two closed edges: the distances of points decide.
    const bool reversed = along && against ? !runs_along(a, b) : against;
    tiny_.merged_faces[face] = 1;
    share(left[0], left[1], reversed);
  }

  static bool runs_along(const CadEdge& a, const CadEdge& b) {
    const std::vector<Vector3> quarters = points_along(a, 4), others = points_along(b, 4);
    return (quarters[1] - others[1]).norm() < (quarters[1] - others[3]).norm();
  }

  /// Replaces chains of merged edges by the edge that keeps its nodes.
  void resolve_edges() {
    for (const EdgeId i : tiny_.edges.ids()) {
      const auto [edge, reversed] = lender(i);
      tiny_.edges[i] = edge;
      tiny_.reversed_edges[i] = static_cast<char>(reversed);
    }
  }

  /// A wire's use of an edge that it shares with others.
  struct Use {
    EdgeId edge;  // keeps the nodes
    bool forward;
    bool is_back_of(const Use& other) const { return edge == other.edge && forward != other.forward; }
  };

  /// Merged edges that only one face is left with, on both sides, lie inside that face and are not needed.
  void drop_edges_inside() {
    const IdVector<EdgeId, int> uses = uses_of_nodes(shape_, used_, tiny_);
    EdgeFlags merged(shape_.edges.size()), inside(shape_.edges.size());
    for (const EdgeId edge : tiny_.edges.ids()) {
      if (tiny_.edges[edge] != edge) merged[tiny_.edges[edge]] = 1;
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (!used_[face] || tiny_.merged_faces[face]) continue;
      for (const CadWire& wire : shape_.faces[face].wires) {
        const auto may_go = [&](EdgeId edge) { return merged[edge] && uses[edge] == 2; };
        for (const EdgeId edge : there_and_back(face, wire, may_go)) inside[edge] = 1;
      }
    }
    for (const EdgeId edge : tiny_.edges.ids()) {
      if (inside[tiny_.edges[edge]]) tiny_.collapsed_edges[edge] = 1;
    }
  }

  /// The edges that may be dropped because a wire runs back along them, with nothing left between.
  template <class MayGo>
  std::vector<EdgeId> there_and_back(FaceId face, const CadWire& wire, MayGo&& may_go) const {
    std::vector<EdgeId> result;
    std::vector<Use> left;
    for (const Coedge* coedge : coedges_left(shape_, tiny_, face, wire)) {
      const Use use{tiny_.edges[coedge->edge], tiny_.forward(*coedge)};
      if (!left.empty() && use.is_back_of(left.back()) && may_go(use.edge)) {
        result.push_back(use.edge);
        left.pop_back();
      } else {
        left.push_back(use);
      }
    }
    for (std::size_t i = 0; 2 * i + 1 < left.size(); ++i) {
      if (!left[i].is_back_of(left[left.size() - 1 - i]) || !may_go(left[i].edge)) break;
      result.push_back(left[i].edge);
    }
    return result;
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  double length_;
  const SliverChoice& slivers_;
  TinyFeatures tiny_;
};

}  // namespace

std::vector<const Coedge*> coedges_left(const CadShape& shape, const TinyFeatures& tiny, FaceId face,
                                        const CadWire& wire) {
  std::vector<const Coedge*> result;
  if (!wire.ordered) return result;
  for (const Coedge& coedge : wire.coedges) {
    if (coedge.internal || shape.edges[coedge.edge].degenerate) return {};
    if (tiny.has(face, coedge.edge)) result.push_back(&coedge);
  }
  return result;
}

IdVector<EdgeId, int> uses_of_nodes(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny) {
  IdVector<EdgeId, int> uses(shape.edges.size());
  for (const FaceId face : used.ids()) {
    if (!used[face] || tiny.merged_faces[face]) continue;
    for (const EdgeId edge : shape.faces[face].edges())
      uses[tiny.edges[edge]] += !tiny.folded.contains({face, edge});
  }
  return uses;
}

bool is_small(const CadEdge& edge, double reach) {
  if (edge.length < reach) return true;
  // The longest smooth loop of that size without turning back is about a circle.
  constexpr double longest = 4;
  if (!(edge.length < longest * reach)) return false;
  if (EdgeCurve(edge).straight()) return false;
  const std::vector<Vector3> points = points_along(edge);
  for (const Vector3& one : points)
    for (const Vector3& other : points)
      if ((one - other).norm() > reach) return false;
  return true;
}

std::vector<Vector3> points_along(const CadEdge& edge, int steps, bool forward) {
  const EdgeCurve curve(edge);
  std::vector<Vector3> points;
  for (int i = 0; i <= steps; ++i)
    points.push_back(curve.point(edge.first + (edge.last - edge.first) * (static_cast<double>(i) / steps)));
  if (!forward) std::ranges::reverse(points);
  return points;
}

std::vector<Vector3> points_around(const CadShape& shape, const CadWire& wire) {
  std::vector<Vector3> points;
  for (const Coedge& coedge : wire.coedges) {
    const std::vector<Vector3> along = points_along(shape.edges[coedge.edge], steps_of_edge, coedge.forward);
    points.insert(points.end(), along.begin(), along.end() - 1);
  }
  return points;
}

double length_of(const CadShape& shape, const CadWire& wire) {
  double length = 0;
  for (const Coedge& coedge : wire.coedges) length += shape.edges[coedge.edge].length;
  return length;
}

double distance_to_line(const Vector3& point, const std::vector<Vector3>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i)
    least = std::min(least, distance_to_segment(point, line[i - 1], line[i]));
  return least;
}

double distance_between(const CadEdge& edge, const CadEdge& other) {
  constexpr int dense = 256;
  const std::vector<Vector3> along = points_along(edge), points = points_along(other, dense);
  double farthest = 0;
  for (int i = 1; i < steps_of_edge; ++i) farthest = std::max(farthest, distance_to_line(along[i], points));
  return farthest;
}

TinyFeatures find_tiny_features(const CadShape& shape, const FaceFlags& used, const EdgeFlags& collapse,
                                double length, const SliverChoice& slivers) {
  return Finder(shape, used, length, slivers).run(collapse);
}

}  // namespace quadrille
