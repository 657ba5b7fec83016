#include "mesher/edges/tiny_features.hpp"

#include <algorithm>

#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

class Finder {
 public:
  Finder(const CadShape& shape, const FaceFlags& used, double length, const SliverLimits& slivers)
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
      if (edge.degenerate || !edge.first_vertex.exists() || !edge.last_vertex.exists() || !(edge.length > 0))
        continue;
      if (edge.length < length_ || collapse[id]) make_point(id);
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (used_[face]) merge(face);
    }
    resolve_edges();
    return std::move(tiny_);
  }

 private:
  void make_point(EdgeId id) {
    const CadEdge& edge = shape_.edges[id];
    tiny_.collapsed_edges[id] = 1;
    const VertexId a = tiny_.vertices[edge.first_vertex], b = tiny_.vertices[edge.last_vertex];
    std::replace(tiny_.vertices.begin(), tiny_.vertices.end(), std::max(a, b), std::min(a, b));
  }

  /// Removes a face that is left with no edges, or with two that lie close together.
  void merge(FaceId face) {
    std::vector<EdgeId> left;
    bool any_collapsed = false;
    for (const CadWire& wire : shape_.faces[face].wires) {
      for (const Coedge& coedge : wire.coedges) {
        const EdgeId edge = coedge.edge;
        any_collapsed |= tiny_.collapsed_edges[edge] != 0;
        if (!tiny_.collapsed_edges[edge] && !shape_.edges[edge].degenerate) left.push_back(edge);
      }
    }
    // A face without any collapsed edge is not tiny, even if all its edges are poles.
    if (left.empty() && any_collapsed) tiny_.merged_faces[face] = 1;
    if (left.size() != 2 || left[0] == left[1]) return;
    const CadEdge &a = shape_.edges[left[0]], &b = shape_.edges[left[1]];
    const bool along = tiny_.end(a.first_vertex) == tiny_.end(b.first_vertex) &&
                       tiny_.end(a.last_vertex) == tiny_.end(b.last_vertex);
    const bool against = tiny_.end(a.first_vertex) == tiny_.end(b.last_vertex) &&
                         tiny_.end(a.last_vertex) == tiny_.end(b.first_vertex);
    if (!(along || against) || !lies_along(a, b, reach_of(face, any_collapsed, a, b))) return;
    // Either direction fits the ends of two closed edges: the distances of points decide.
    const bool reversed = along && against ? !runs_along(a, b) : against;
    tiny_.merged_faces[face] = 1;
    tiny_.edges[left[1]] = left[0];
    tiny_.reversed_edges[left[1]] = reversed;
  }

  /// The largest distance between the two edges of a face that may become an edge.
  double reach_of(FaceId face, bool has_points, const CadEdge& a, const CadEdge& b) const {
    constexpr double slender = 4;  // shorter faces without collapsed edges are discs, not slivers
    const bool is_sliver = (has_points || std::min(a.length, b.length) > slender * slivers_.reach) &&
                           lies_between_others(a) && lies_between_others(b) &&
                           (slivers_.kept == nullptr || !(*slivers_.kept)[face]);
    return std::max(length_, is_sliver ? slivers_.reach : 0);
  }

  /// Whether the edge has another used face. A sliver without neighbors on both sides is a part of its own.
  bool lies_between_others(const CadEdge& edge) const {
    return std::count_if(edge.faces.begin(), edge.faces.end(),
                         [&](FaceId face) { return used_[face] != 0; }) > 1;
  }

  static Vector3 at(const CadEdge& edge, double t) {
    return EdgeCurve(edge).point(edge.first + t * (edge.last - edge.first));
  }

  static bool runs_along(const CadEdge& a, const CadEdge& b) {
    const Vector3 p = at(a, 0.25);
    return (p - at(b, 0.25)).norm() < (p - at(b, 0.75)).norm();
  }

  /// Replaces chains of merged edges by their last edge, which keeps its nodes. Each merge removes a face, so
  /// a ring of merged edges is a closed fan of slivers: the edge that closes the ring keeps its own nodes.
  void resolve_edges() {
    for (const EdgeId i : tiny_.edges.ids()) {
      EdgeId end = i;
      char reversed = 0;
      for (std::size_t step = 0; tiny_.edges[end] != end && step < tiny_.edges.size(); ++step) {
        reversed ^= tiny_.reversed_edges[end];
        end = tiny_.edges[end];
        if (end == i) {
          tiny_.edges[i] = end;
          reversed = 0;
        }
      }
      tiny_.edges[i] = end;
      tiny_.reversed_edges[i] = reversed;
    }
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  double length_;
  SliverLimits slivers_;
  TinyFeatures tiny_;
};

}  // namespace

bool lies_along(const CadEdge& edge, const CadEdge& other, double reach) {
  if (!(reach > 0)) return false;
  constexpr int samples = 16, dense = 256;
  const auto place = [](const CadEdge& on, const EdgeCurve& curve, int i, int of) {
    return curve.point(on.first + (on.last - on.first) * (static_cast<double>(i) / of));
  };
  const EdgeCurve curve(edge), other_curve(other);
  std::vector<Vector3> points;
  for (int i = 0; i <= dense; ++i) points.push_back(place(other, other_curve, i, dense));
  for (int i = 1; i < samples; ++i) {
    const Vector3 p = place(edge, curve, i, samples);
    double nearest = (p - points[0]).norm();
    for (int k = 0; k < dense; ++k) {
      const Vector3 side = points[k + 1] - points[k];
      const double square = side.squaredNorm();
      const double t = square > 0 ? std::clamp((p - points[k]).dot(side) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, (p - points[k] - t * side).norm());
    }
    if (!(nearest < reach)) return false;
  }
  return true;
}

TinyFeatures find_tiny_features(const CadShape& shape, const FaceFlags& used, const EdgeFlags& collapse,
                                double length, const SliverLimits& slivers) {
  return Finder(shape, used, length, slivers).run(collapse);
}

}  // namespace quadrille
