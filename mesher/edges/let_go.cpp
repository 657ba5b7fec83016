// Based on: Sheffer, Bercovier, Blacker & Clements, Virtual topology operators for meshing (2000), for
// merging faces and edges where the model divides them into parts smaller than the elements.

#include "mesher/edges/let_go.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Limits of a face's angle (radians) where two edges meet that did not meet before. Below the first limit,
/// the two would lie along each other: a sharp corner is better than a side below the least size. Above the
/// second, the edges would be the two sides of a slot.
constexpr double sharpest = 0.3, bluntest = 6;

class HarmFinder {
 public:
  HarmFinder(const CadShape& shape, const TinyFeatures& tiny, double reach)
      : shape_(shape), tiny_(tiny), reach_(reach) {}

  /// What was let go on a face but must be kept, since no good quads fit otherwise.
  struct Harm {
    std::vector<EdgeId> points;   // edges that became points
    std::vector<EdgeId> slivers;  // edges that share the nodes of others
  };

  Harm find(const CadFace& face) const {
    Harm harm;
    for (const CadWire& wire : face.wires) {
      const std::vector<Gap> gaps = find_gaps(wire);
      const bool is_lost = !wire.ordered || is_small(wire);
      for (const Gap& gap : gaps) {
        if (is_lost || !meet_well(face, wire.coedges[gap.before], wire.coedges[gap.after]))
          harm.points.insert(harm.points.end(), gap.edges.begin(), gap.edges.end());
      }
    }
    find_edges_twice(face, harm);
    return harm;
  }

 private:
  /// Consecutive edges of a wire that became points.
  struct Gap {
    std::size_t before = 0, after = 0;  // neighboring coedges; any if no edge of the wire is left
    std::vector<EdgeId> edges;
  };

  bool is_gone(const Coedge& coedge) const { return tiny_.collapsed_edges[coedge.edge] != 0; }

  std::vector<Gap> find_gaps(const CadWire& wire) const {
    const std::size_t n = wire.coedges.size();
    std::vector<Gap> gaps;
    std::size_t start = 0;
    while (start < n && is_gone(wire.coedges[start])) ++start;
    if (start == n) start = 0;
    bool inside = false;
    for (std::size_t k = start; k < start + n; ++k) {
      const bool gone = is_gone(wire.coedges[k % n]);
      if (gone && !inside) gaps.push_back({(k + n - 1) % n, k % n, {}});
      if (gone) {
        gaps.back().edges.push_back(wire.coedges[k % n].edge);
        gaps.back().after = (k + 1) % n;
      }
      inside = gone;
    }
    return gaps;
  }

  /// Whether the rest of a loop is too small for elements.
  bool is_small(const CadWire& wire) const {
    constexpr double least = 4;
    double length = 0;
    std::vector<const CadEdge*> left;
    for (const Coedge& coedge : wire.coedges) {
      if (is_gone(coedge)) continue;
      left.push_back(&shape_.edges[coedge.edge]);
      length += left.back()->length;
    }
    return left.empty() || length < least * reach_ ||
           (left.size() == 2 && lies_along(*left[0], *left[1], least * reach_));
  }

  /// Whether two edges meet at an angle between the limits.
  bool meet_well(const CadFace& face, const Coedge& from, const Coedge& to) const {
    const CadEdge &before = shape_.edges[from.edge], &after = shape_.edges[to.edge];
    if (before.degenerate || after.degenerate || from.internal || to.internal) return false;
    const double t = to.forward ? after.first : after.last;
    const Vector3 in = (from.forward ? 1 : -1) *
                       EdgeCurve(before).derivative(from.forward ? before.last : before.first),
                  out = (to.forward ? 1 : -1) * EdgeCurve(after).derivative(t);
    const Vector3 normal = FaceSurface(face).normal(parametric_point(to, t));
    const double angle = M_PI - std::atan2(in.cross(out).dot(normal), in.dot(out));
    return angle > sharpest && angle < bluntest;
  }

  /// Finds edges of a face that share their nodes, since the two sides of a slot must not become one.
  void find_edges_twice(const CadFace& face, Harm& harm) const {
    std::map<EdgeId, EdgeId> first;  // edge whose nodes are used -> edge of the face
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) {
        const EdgeId edge = coedge.edge;
        if (is_gone(coedge)) continue;
        const auto [at, is_new] = first.emplace(tiny_.edges[edge], edge);
        if (!is_new && at->second != edge) harm.slivers.insert(harm.slivers.end(), {edge, at->second});
      }
    }
  }

  const CadShape& shape_;
  const TinyFeatures& tiny_;
  double reach_;
};

}  // namespace

LetGo::LetGo(const CadShape& shape, const FaceFlags& used, double reach, const EdgeFlags& fine)
    : shape_(shape),
      used_(used),
      reach_(reach),
      slivers_(find_slivers(shape, used, reach)),
      edges_(shape.edges.size()),
      kept_faces_(shape.faces.size()) {
  if (!(reach > 0)) return;
  for (const FaceId face : kept_faces_.ids()) {
    const auto& wires = shape.faces[face].wires;
    kept_faces_[face] = std::all_of(wires.begin(), wires.end(), [&](const CadWire& wire) {
      return std::all_of(wire.coedges.begin(), wire.coedges.end(),
                         [&](const Coedge& coedge) { return fine[coedge.edge] != 0; });
    });
  }
  choose(fine);
  while (keep_harmed()) {
  }
}

TinyFeatures LetGo::find(const EdgeFlags& collapse, double length) const {
  EdgeFlags both = collapse;
  for (const EdgeId edge : both.ids()) both[edge] |= edges_[edge];
  return find_tiny_features(shape_, used_, both, length, {&slivers_, &kept_faces_});
}

/// Takes edges, the shortest first, if all vertices that then share a node lie within reach of each other.
void LetGo::choose(const EdgeFlags& fine) {
  std::vector<EdgeId> candidates;
  for (const EdgeId id : edges_.ids()) {
    const CadEdge& edge = shape_.edges[id];
    if (!fine[id] && edge.is_used(used_) && !edge.degenerate && !edge.closed() &&
        edge.first_vertex.exists() && edge.last_vertex.exists() && edge.length > 0 && edge.length < reach_)
      candidates.push_back(id);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](EdgeId a, EdgeId b) { return shape_.edges[a].length < shape_.edges[b].length; });
  IdVector<VertexId, VertexId> cluster;
  IdVector<VertexId, std::vector<VertexId>> members;
  for (const VertexId vertex : shape_.vertices.ids()) {
    cluster.push_back(vertex);
    members.push_back({vertex});
  }
  for (const EdgeId edge : candidates) {
    const VertexId a = cluster[shape_.edges[edge].first_vertex], b = cluster[shape_.edges[edge].last_vertex];
    if (a == b) {  // closes a loop of such edges
      edges_[edge] = 1;
      continue;
    }
    const auto fits = [&](VertexId p) {
      return std::all_of(members[b].begin(), members[b].end(), [&](VertexId q) {
        return (shape_.vertices[p] - shape_.vertices[q]).norm() <= reach_;
      });
    };
    if (!std::all_of(members[a].begin(), members[a].end(), fits)) continue;
    edges_[edge] = 1;
    for (const VertexId vertex : members[b]) cluster[vertex] = a;
    members[a].insert(members[a].end(), members[b].begin(), members[b].end());
    members[b].clear();
  }
}

/// Keeps the features that would harm a face if let go. \return whether there was something to keep.
bool LetGo::keep_harmed() {
  const TinyFeatures tiny = find(EdgeFlags(edges_.size()), 0);
  const HarmFinder finder(shape_, tiny, reach_);
  bool any = false;
  const auto keep_edge = [&](EdgeId edge) {
    any |= edges_[edge] != 0;
    edges_[edge] = 0;
  };
  const auto keep_slivers_at = [&](EdgeId edge) {
    for (const FaceId face : shape_.edges[edge].faces) {
      if (!tiny.merged_faces[face] || kept_faces_[face]) continue;
      kept_faces_[face] = 1;
      any = true;
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) keep_edge(coedge.edge);
      }
    }
  };
  for (const FaceId face : used_.ids()) {
    if (!used_[face] || tiny.merged_faces[face]) continue;
    const auto harm = finder.find(shape_.faces[face]);
    for (const EdgeId edge : harm.points) keep_edge(edge);
    for (const EdgeId edge : harm.slivers) keep_slivers_at(edge);
  }
  for (const EdgeId edge : edges_.ids()) {
    const EdgeId lender = tiny.edges[edge];
    if (lender != edge && !lies_along(shape_.edges[edge], shape_.edges[lender], reach_))
      keep_slivers_at(edge);
  }
  return any;
}

bool LetGo::keep_around(FaceId face, const TinyFeatures& tiny) {
  bool any = false;
  std::set<VertexId> here;
  const auto keep_face = [&](FaceId other) {
    any |= tiny.merged_faces[other] && !kept_faces_[other];
    kept_faces_[other] = 1;
  };
  keep_face(face);
  for (const CadWire& wire : shape_.faces[face].wires) {
    for (const Coedge& coedge : wire.coedges) {
      const CadEdge& edge = shape_.edges[coedge.edge];
      here.insert({tiny.end(edge.first_vertex), tiny.end(edge.last_vertex)});
      for (const FaceId other : edge.faces) keep_face(other);
    }
  }
  for (const EdgeId edge : edges_.ids()) {
    if (!edges_[edge] || !here.contains(tiny.end(shape_.edges[edge].first_vertex))) continue;
    edges_[edge] = 0;
    any = true;
  }
  return any;
}

}  // namespace quadrille
