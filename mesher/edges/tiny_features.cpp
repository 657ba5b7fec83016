#include "mesher/edges/tiny_features.hpp"

#include <algorithm>

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
      if (edge.degenerate || !edge.first_vertex.exists() || !edge.last_vertex.exists() || !(edge.length > 0))
        continue;
      if (edge.length < length_ || collapse[id]) make_point(id);
    }
    if (slivers_.slivers != nullptr) {
      for (const Sliver& sliver : *slivers_.slivers) zip(sliver);
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (used_[face] && !tiny_.merged_faces[face]) merge(face);
    }
    resolve_edges();
    return std::move(tiny_);
  }

 private:
  void make_point(EdgeId id) {
    const CadEdge& edge = shape_.edges[id];
    tiny_.collapsed_edges[id] = 1;
    join(edge.first_vertex, edge.last_vertex);
  }

  void join(VertexId first, VertexId second) {
    const VertexId a = tiny_.vertices[first], b = tiny_.vertices[second];
    if (a != b) std::replace(tiny_.vertices.begin(), tiny_.vertices.end(), std::max(a, b), std::min(a, b));
  }

  /// Makes a sliver an edge, all of it or nothing.
  void zip(const Sliver& sliver) {
    if (!used_[sliver.face] || (slivers_.kept != nullptr && (*slivers_.kept)[sliver.face])) return;
    const auto is_open = [&](const auto& joint) { return tiny_.end(joint[0]) != tiny_.end(joint[1]); };
    const auto is_free = [&](EdgeId edge) {
      return tiny_.edges[edge] == edge && !tiny_.collapsed_edges[edge];
    };
    if (std::any_of(sliver.joints.begin(), sliver.joints.end(), is_open)) return;
    if (std::any_of(sliver.pairs.begin(), sliver.pairs.end(),
                    [&](const Sliver::Pair& pair) { return !is_free(pair.edge) && !is_free(pair.other); }))
      return;
    for (const auto& [a, b] : sliver.ties) join(a, b);
    for (const Sliver::Pair& pair : sliver.pairs) {
      const bool as_is = is_free(pair.other);
      const EdgeId edge = as_is ? pair.edge : pair.other, other = as_is ? pair.other : pair.edge;
      tiny_.edges[other] = edge;
      tiny_.reversed_edges[other] = pair.reversed;
    }
    tiny_.merged_faces[sliver.face] = 1;
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
    if (!(along || against) || !lies_along(a, b, length_)) return;
    // Either direction fits the ends of two closed edges: the distances of points decide.
    const bool reversed = along && against ? !runs_along(a, b) : against;
    tiny_.merged_faces[face] = 1;
    tiny_.edges[left[1]] = left[0];
    tiny_.reversed_edges[left[1]] = reversed;
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
  SliverChoice slivers_;
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
                                double length, const SliverChoice& slivers) {
  return Finder(shape, used, length, slivers).run(collapse);
}

}  // namespace quadrille
