/// Based on: Sheffer, Bercovier, Blacker & Clements, Virtual topology operators for meshing (2000), for
/// merging faces and edges where the model divides them into parts smaller than the elements.

#include "mesher/edges/suppressed_features.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

class HarmFinder {
 public:
  HarmFinder(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny, double reach)
      : shape_(shape), used_(used), tiny_(tiny), reach_(reach), uses_(uses_of_nodes(shape, used, tiny)) {}

  /// A suppressed edge of a face that must be kept, because no good quads fit without it.
  struct Harm {
    EdgeId edge;      // became a point, or shares the nodes of another
    std::string why;  // what would be wrong without it
  };

  std::vector<Harm> find(FaceId id) const {
    const CadFace& face = shape_.faces[id];
    std::vector<Harm> harms;
    for (const CadWire& wire : face.wires) {
      if (is_closed_hole(id, wire)) continue;
      std::string why;
      if (!wire.ordered || is_small_loop(id, wire)) {
        why = fmt::format("a loop of Face{} would be too small for elements", id.number());
      } else if (is_narrow(id, wire)) {
        why = fmt::format("Face{} is so narrow that it would lose much of its area", id.number());
      }
      if (why.empty()) continue;
      for (const Coedge& coedge : wire.coedges) {
        if (is_gone(id, coedge)) harms.push_back({coedge.edge, why});
      }
    }
    find_edges_twice(id, harms);
    return harms;
  }

 private:
  bool is_gone(FaceId face, const Coedge& coedge) const { return !tiny_.has(face, coedge.edge); }

  /// Whether nothing is left of a hole and of the faces behind it, so that the face continues across it.
  bool is_closed_hole(FaceId id, const CadWire& hole) const {
    const auto is_left = [&](const Coedge& coedge) { return !is_gone(id, coedge); };
    const auto is_open = [&](const Coedge& coedge) {
      const auto& faces = shape_.edges[coedge.edge].faces;
      return std::ranges::any_of(
          faces, [&](FaceId other) { return other != id && used_[other] && !tiny_.merged_faces[other]; });
    };
    const auto edges = shape_.faces[id].edges();
    return hole.ordered && std::ranges::none_of(hole.coedges, is_left) &&
           std::ranges::none_of(hole.coedges, is_open) &&
           std::ranges::any_of(edges, [&](EdgeId edge) { return tiny_.has(id, edge); });
  }

  /// Whether the rest of a loop is too small for elements.
  bool is_small_loop(FaceId id, const CadWire& wire) const {
    constexpr double least = 4;
    double length = 0;
    std::vector<const CadEdge*> left;
    for (const Coedge& coedge : wire.coedges) {
      if (is_gone(id, coedge)) continue;
      left.push_back(&shape_.edges[coedge.edge]);
      length += left.back()->length;
    }
    return left.empty() || length < least * reach_ ||
           (left.size() == 2 && distance_between(*left[0], *left[1]) < least * reach_);
  }

  /// Whether a loop with free edges that would lose others is hardly wider than these may be long.
  bool is_narrow(FaceId id, const CadWire& wire) const {
    constexpr double hardly = 2;
    const auto is_free = [&](const Coedge& coedge) {
      return !is_gone(id, coedge) && shape_.edges[coedge.edge].faces.size() == 1;
    };
    if (std::ranges::none_of(wire.coedges, is_free) ||
        std::ranges::none_of(wire.coedges, [&](const Coedge& c) { return is_gone(id, c); }))
      return false;
    const double area = vector_area(points_around(shape_, wire)).norm();
    return area < 0.5 * length_of(shape_, wire) * hardly * reach_;
  }

  /// Finds edges of a face that share their nodes, since the two sides of a slot must not become one. Two
  /// sides of one loop may if nothing is left between them: then the edge lies inside the face.
  void find_edges_twice(FaceId id, std::vector<Harm>& harms) const {
    struct Use {
      Coedge coedge;
      const CadWire* wire;
    };
    std::map<EdgeId, Use> first;  // edge whose nodes are used -> first use
    for (const CadWire& wire : shape_.faces[id].wires) {
      for (const Coedge& coedge : wire.coedges) {
        const EdgeId edge = coedge.edge;
        if (is_gone(id, coedge)) continue;
        const auto [at, is_new] = first.emplace(tiny_.edges[edge], Use{coedge, &wire});
        const Use& other = at->second;
        if (is_new || other.coedge.edge == edge) continue;
        if (uses_[tiny_.edges[edge]] == 2 && other.wire == &wire &&
            tiny_.forward(coedge) != tiny_.forward(other.coedge))
          continue;
        for (const EdgeId one : {edge, other.coedge.edge})
          harms.push_back({one, fmt::format("two edges of Face{} would share their nodes", id.number())});
      }
    }
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  const TinyFeatures& tiny_;
  double reach_;
  IdVector<EdgeId, int> uses_;  // by faces that are left, of the edge that keeps the nodes
};

}  // namespace

SuppressedFeatures::SuppressedFeatures(const CadShape& shape, const FaceFlags& used, double reach,
                                       const EdgeFlags& wanted_fine, const std::vector<VertexId>& held)
    : shape_(shape),
      used_(used),
      reach_(reach),
      slivers_{find_slivers(shape, used, reach), FaceFlags(shape.faces.size()), wanted_fine},
      edges_(shape.edges.size()) {
  if (!(reach > 0)) return;
  EdgeFlags fine = wanted_fine;
  hold(held, fine);
  for (const FaceId face : used.ids()) {
    const auto edges = shape.faces[face].edges();
    slivers_.kept[face] = std::ranges::all_of(edges, [&](EdgeId edge) { return fine[edge] != 0; });
  }
  choose(fine);
  while (keep_harmed()) {
  }
}

/// Keeps the edges that end at the vertices, and the faces that would become edges there.
void SuppressedFeatures::hold(const std::vector<VertexId>& held, EdgeFlags& fine) {
  const auto ends_there = [&](EdgeId id) {
    const CadEdge& edge = shape_.edges[id];
    return std::ranges::any_of(
        held, [&](VertexId vertex) { return edge.first_vertex == vertex || edge.last_vertex == vertex; });
  };
  for (const EdgeId edge : fine.ids()) fine[edge] |= ends_there(edge);
  for (const Sliver& sliver : slivers_.slivers)
    if (std::ranges::any_of(shape_.faces[sliver.face].edges(), ends_there))
      keep_face(sliver.face, "a node is placed at its boundary");
}

TinyFeatures SuppressedFeatures::find(double length) const {
  return find_tiny_features(shape_, used_, edges_, length, slivers_);
}

/// Takes edges, the shortest first, if all vertices that then share a node lie within reach of each other.
void SuppressedFeatures::choose(const EdgeFlags& fine) {
  std::vector<EdgeId> candidates;
  for (const EdgeId id : edges_.ids()) {
    const CadEdge& edge = shape_.edges[id];
    if (!fine[id] && edge.is_used(used_) && has_ends(edge) && edge.length > 0 && is_small(edge, reach_))
      candidates.push_back(id);
  }
  std::ranges::stable_sort(candidates, {}, [&](EdgeId edge) { return shape_.edges[edge].length; });
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
      return std::ranges::all_of(
          members[b], [&](VertexId q) { return (shape_.vertices[p] - shape_.vertices[q]).norm() <= reach_; });
    };
    if (!std::ranges::all_of(members[a], fits)) continue;
    edges_[edge] = 1;
    for (const VertexId vertex : members[b]) cluster[vertex] = a;
    members[a].insert(members[a].end(), members[b].begin(), members[b].end());
    members[b].clear();
  }
}

/// Keeps the features whose suppression would harm a face. \return whether there was something to keep.
bool SuppressedFeatures::keep_harmed() {
  const TinyFeatures tiny = find(0);
  const HarmFinder finder(shape_, used_, tiny, reach_);
  bool any = false;
  const auto keep_edge = [&](EdgeId edge, const std::string& why) {
    if (edges_[edge]) kept_edges_.try_emplace(edge, why);
    any |= edges_[edge] != 0;
    edges_[edge] = 0;
  };
  const auto keep_slivers_at = [&](EdgeId edge, const std::string& why) {
    for (const FaceId face : shape_.edges[edge].faces) {
      if (!tiny.cuts(face) || slivers_.kept[face]) continue;
      keep_face(face, why);
      any = true;
      for (const EdgeId other : shape_.faces[face].edges()) keep_edge(other, why);
    }
  };
  for (const FaceId face : used_.ids()) {
    if (!used_[face] || tiny.merged_faces[face]) continue;
    for (const auto& [edge, why] : finder.find(face)) {
      const bool is_point = edges_[edge] != 0;
      keep_edge(edge, why);
      if (!is_point) keep_slivers_at(edge, why);
    }
  }
  for (const EdgeId edge : edges_.ids()) {
    const EdgeId lender = tiny.edges[edge];
    if (lender != edge && !tiny.collapsed_edges[edge] &&
        !(distance_between(shape_.edges[edge], shape_.edges[lender]) < reach_))
      keep_slivers_at(edge, "its long sides are not everywhere close together");
  }
  return any;
}

/// An edge below this share of the reach moves nothing by so much that a face fails because of it.
constexpr double too_small_to_matter = 0.01;

bool SuppressedFeatures::keep_around(FaceId face, const std::vector<EdgeId>& edges,
                                     const TinyFeatures& tiny) {
  const std::string why = fmt::format("Face{} has no valid mesh without it", face.number());
  bool any = false;
  std::set<VertexId> here;
  const auto keep = [&](FaceId other) {
    if (!tiny.cuts(other) || slivers_.kept[other]) return;
    any = true;
    keep_face(other, why);
  };
  keep(face);
  for (const EdgeId id : shape_.faces[face].edges()) {
    if (!edges.empty() && std::ranges::find(edges, id) == edges.end()) continue;
    const CadEdge& edge = shape_.edges[id];
    here.insert({tiny.end(edge.first_vertex), tiny.end(edge.last_vertex)});
    for (const FaceId other : edge.faces) keep(other);
  }
  for (const EdgeId edge : edges_.ids()) {
    if (!edges_[edge] || !here.contains(tiny.end(shape_.edges[edge].first_vertex))) continue;
    if (shape_.edges[edge].length < too_small_to_matter * reach_) continue;
    edges_[edge] = 0;
    kept_edges_.try_emplace(edge, why);
    any = true;
  }
  return any || (!edges.empty() && keep_around(face, {}, tiny));
}

void SuppressedFeatures::keep_face(FaceId face, const std::string& why) {
  slivers_.kept[face] = 1;
  reasons_.try_emplace(face, why);
}

}  // namespace quadrille
