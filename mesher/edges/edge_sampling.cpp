/// Finds the least and wanted counts of all edges, chooses the counts, and places nodes along the curves.

#include "mesher/edges/edge_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"
#include "mesher/edges/face_plan.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/hole_blocks.hpp"
#include "mesher/edges/strip_counts.hpp"

namespace quadrille {

namespace {

/// Curves that turn by more than this, in radians, are arcs.
constexpr double least_arc = 0.52;

/// Least number of segments (of the mesh that is recombined) for the edge's shape and an open face loop.
int least_segments(bool closed, double turning, bool shares_both_ends, bool inner, int stride) {
  // Holes and pins need more segments than fillets to keep their area.
  const double turning_a_segment = turning > 2.5 ? 1.3 : 1.8;
  int least = std::max(1, to_int(std::ceil(turning / turning_a_segment - 0.01)));
  if (shares_both_ends && turning > 1e-3) least = std::max(least, 2);
  if (inner) least = std::max(least, 2);  // the face is cut open between the edge's ends
  if (closed) least = std::max(least, stride == 2 ? 3 : 4);
  return least;
}

/// Edges that share both end vertices with another edge: with one segment each, the two would coincide.
EdgeFlags find_shared_ends(const CadShape& shape, const TinyFeatures& tiny) {
  std::map<std::pair<VertexId, VertexId>, int> count;
  const auto key = [&](const CadEdge& e) -> std::pair<VertexId, VertexId> {
    return std::minmax({tiny.end(e.first_vertex), tiny.end(e.last_vertex)});
  };
  EdgeFlags shared(shape.edges.size());
  const auto is_open = [&](EdgeId i) {
    return !shape.edges[i].degenerate && !tiny.closed(shape.edges[i]) && tiny.edges[i] == i;
  };
  for (const EdgeId i : shared.ids()) {
    if (is_open(i)) ++count[key(shape.edges[i])];
  }
  for (const EdgeId i : shared.ids()) shared[i] = is_open(i) && count[key(shape.edges[i])] > 1;
  return shared;
}

/// Edges that lie inside a face (cracks).
EdgeFlags find_inner_edges(const CadShape& shape) {
  EdgeFlags inner(shape.edges.size());
  for (const CadFace& face : shape.faces) {
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) inner[coedge.edge] |= coedge.internal;
    }
  }
  return inner;
}

/// The edges that have nodes: those of the faces used, and those that lend their nodes to them.
EdgeFlags find_used_edges(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny) {
  EdgeFlags result(shape.edges.size());
  for (const EdgeId i : result.ids()) {
    if (shape.edges[i].is_used(used)) result[i] = result[tiny.edges[i]] = 1;
  }
  return result;
}

double chord_of(const CadEdge& edge) {
  const EdgeCurve curve(edge);
  return (curve.point(edge.last) - curve.point(edge.first)).norm();
}

/// The parameter of node k on a curve that may have loops: where the curve comes nearest to the point that
/// divides its chord in equal parts. \param before parameters of nodes 0 .. k - 1.
double parameter_near_chord(const CadEdge& edge, const EdgeCurve& curve, int k, int segments,
                            const std::vector<double>& before) {
  if (k == 0 || k == segments) return k == 0 ? edge.first : edge.last;
  constexpr int samples = 256;
  const double share = static_cast<double>(k) / segments;
  const Vector3 target = (1 - share) * curve.point(edge.first) + share * curve.point(edge.last);
  const double start = before.back(), reach = edge.last - start;
  double best = 0, nearest = std::numeric_limits<double>::infinity();
  for (int i = 1; i < samples; ++i) {
    // Leave room for the nodes that follow.
    const double t = start + reach * i / samples * (1 - 0.5 * share);
    const double distance = (curve.point(t) - target).norm();
    if (distance < nearest) {
      nearest = distance;
      best = t;
    }
  }
  return best;
}

class EdgeSampler {
 public:
  EdgeSampler(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
              const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known)
      : shape_(shape),
        field_(field),
        used_(used),
        plan_(plan),
        context_(context),
        known_(known),
        n_(shape.edges.size()),
        used_edges_(find_used_edges(shape, used, plan.tiny)) {
    result_.stride = stride;
    result_.vertex_nodes.assign(shape.vertices.size(), -1);
    result_.edges.resize(n_);
  }

  BoundaryNodes run() {
    tabulate_edges();
    share_targets();
    FaceOutlines found = find_face_sides(shape_, used_, plan_.tiny, targets_.wanted);
    free_sides_beside_chains(found);
    FaceOutlines sides = found;
    EdgeCounts chosen = choose(sides);
    constexpr int most_rounds = 3;
    for (int round = 0; round < most_rounds; ++round) {
      const bool refined = refine_along_strips(shape_, sides, chosen, result_, shares_, field_.aspect(),
                                               field_.size_min(), tables_, targets_);
      if (!(round == 0 && fit_holes_to_grids(shape_, sides, chosen, tables_, targets_)) && !refined) break;
      sides = found;
      chosen = choose(sides);
    }
    place_vertices();
    context_.check();
    SparseCheck check(context_, 64);
    for (const EdgeId i : shape_.edges.ids()) {
      if (counts_[i] > 0) place_nodes(i, check);
    }
    copy_nodes();
    end_faces_at_tips(shape_, plan_.tips, plan_.tiny, result_);
    copy_nodes();
    borrow_nodes();
    result_.plans = plan_faces(shape_, std::move(sides), plan_, result_);
    return std::move(result_);
  }

 private:
  /// Chooses the counts, and where nodes lie on the edges.
  EdgeCounts choose(FaceOutlines& sides) {
    EdgeCounts chosen = choose_counts(shape_, targets_, plan_.tiny, sides);
    counts_ = chosen.counts;
    shares_ = space_chords(shape_, sides, chosen.chords, tables_, counts_, prescribed_shares());
    keep_spacing(chosen.chords);
    return chosen;
  }

  void tabulate_edges() {
    const EdgeFlags shared_ends = find_shared_ends(shape_, plan_.tiny);
    const EdgeFlags inner = find_inner_edges(shape_);
    tables_.resize(n_);
    targets_.stride = result_.stride;
    targets_.check = [this] { context_.check(); };
    targets_.least.assign(n_, 0);
    targets_.least_of_grids.assign(n_, 0);
    targets_.wanted.assign(n_, 0);
    targets_.fixed.assign(n_, 0);
    targets_.even.assign(n_, 0);
    double segments = 0;
    for (const EdgeId i : shape_.edges.ids()) {
      if (i.index() % 256 == 0) context_.report(Stage::sample, 0.5 * i.index() / static_cast<double>(n_));
      context_.check();
      const CadEdge& edge = shape_.edges[i];
      if (edge.degenerate || edge.length <= 0 || !used_edges_[i] || plan_.tiny.collapsed_edges[i]) continue;
      tables_[i] = table_of(i);
      const bool even = result_.stride == 1 && edge.is_used(plan_.subdivided);
      const int stride = result_.edges[i].stride = even ? 2 : result_.stride;
      bool is_finer = false;
      for (const EdgeStretch& part : plan_.finer) {
        if (part.edge != i) continue;
        tables_[i].make_finer(part.from, part.to, std::min(part.segments * stride, most_segments(part)));
        is_finer = true;
      }
      double& wanted = targets_.wanted[i];
      wanted = std::min(tables_[i].total(), most_at_least_size(i, 1)) / result_.stride;
      // An edge has at least one segment, which the factor multiplies.
      if (plan_.factor[i] > 1) wanted = std::max(wanted, 1.0) * plan_.factor[i];
      if (along_chord(i)) wanted *= chord_of(edge) / edge.length;
      segments += result_.stride * wanted;
      hold_segments(segments, field_.budget(), edge);
      const double turning = plan_.ignore_curvature[i] ? 0 : tables_[i].turning;
      targets_.least[i] =
          least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], result_.stride);
      // The count that a face needs to be meshed at all overrides the wanted counts of opposite edges.
      if (is_finer) targets_.least[i] = std::max(targets_.least[i], static_cast<int>(wanted));
      raise_least(i, turning, is_finer || shared_ends[i] != 0 || inner[i] != 0);
      add_heads(i);
      if (is_prescribed(i)) {
        fix_count(i, shared_ends[i], inner[i]);
      } else if (even) {
        targets_.even[i] = 1;
        targets_.least[i] = std::max(
            targets_.least[i] + targets_.least[i] % 2,
            stride * least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride));
      }
    }
  }

  /// How many times `unit` segments an edge has room for where the least size limits them, or infinity: the
  /// count is rounded down there, since with one more all would be shorter. Sizes that are given by name may
  /// be below the least.
  double most_at_least_size(EdgeId i, int unit) const {
    constexpr double rounding = 1 + 1e-6;
    const double room = rounding * shape_.edges[i].length / field_.size_min();
    return tables_[i].total() > room ? std::numeric_limits<double>::infinity()
                                     : std::max(1.0, std::floor(room / unit));
  }

  /// Sets the least count between grids, and raises both least counts on arcs.
  void raise_least(EdgeId i, double turning, bool needs_least) {
    const double wanted = targets_.wanted[i];
    int &least = targets_.least[i], &of_grids = targets_.least_of_grids[i];
    // Between grids, one segment may do for a straight edge, and for a short arc of up to a quarter turn.
    // Other curves keep their shape there as elsewhere.
    constexpr double straight = 1e-3, quarter_turn = 1.6;
    const bool is_curve = turning > straight && (result_.stride * wanted > 1 || turning > quarter_turn);
    of_grids = is_curve || needs_least ? result_.stride * least : 1;
    if (turning <= least_arc) return;
    // On an arc, the number that the sizes give is a minimum: the stresses there depend on it.
    constexpr double nearly = 0.25;
    least =
        std::max(least, to_int(std::min(std::ceil(wanted - nearly), most_at_least_size(i, result_.stride))));
    of_grids = std::max(of_grids, to_int(std::ceil(result_.stride * wanted - nearly)));
  }

  /// Edges with the same nodes get the larger of their wanted counts.
  void share_targets() {
    const auto take = [&](EdgeId to, EdgeId from) {
      const auto raise = [&](auto& values) { values[to] = std::max(values[to], values[from]); };
      if (targets_.fixed[to] != 0 && targets_.fixed[from] != 0) return;  // choose_counts() compares them
      raise(targets_.least);
      raise(targets_.least_of_grids);
      raise(targets_.wanted);
      raise(targets_.fixed);
      raise(targets_.even);
    };
    for (auto copy = plan_.matched.rbegin(); copy != plan_.matched.rend(); ++copy) take(copy->from, copy->to);
    for (const MatchedEdge& copy : plan_.matched) {
      take(copy.to, copy.from);
      targets_.tied.push_back({{copy.from, true}, {copy.to, !copy.reversed}});
      result_.edges[copy.from].matched = result_.edges[copy.to].matched = result_.edges[copy.to].copied =
          true;
    }
  }

  /// Moves the nodes of matched edges to the images of their partners' nodes.
  void copy_nodes() {
    for (const MatchedEdge& copy : plan_.matched) {
      const BoundaryNodes::Edge& from = result_.edges[copy.from];
      BoundaryNodes::Edge& to = result_.edges[copy.to];
      if (from.segments() != to.segments())
        throw failure("match",
                      fmt::format("`match` cannot give Edge{} the nodes of Edge{}, since one of them is "
                                  "left out: use `keep_features`, or a smaller `merge_tiny`",
                                  shape_.edges[copy.to].number, shape_.edges[copy.from].number));
      const EdgeCurve curve(shape_.edges[copy.to]);
      for (int k = 1; k < to.segments(); ++k) {
        const Vector3& source = result_.points[from.nodes[copy.reversed ? from.segments() - k : k]];
        Vector3& point = result_.points[to.nodes[k]];
        point = copy.motion(source);
        to.parameters[k] = parameter_at(curve, shape_.edges[copy.to], to.parameters[k], point);
      }
    }
  }

  /// The parameter of a point on a curve, searched from another one by Newton's method.
  static double parameter_at(const EdgeCurve& curve, const CadEdge& edge, double t, const Vector3& point) {
    constexpr int most_steps = 30;
    for (int i = 0; i < most_steps; ++i) {
      const Vector3 along = curve.derivative(t);
      const double step = along.dot(point - curve.point(t)) / std::max(along.squaredNorm(), 1e-300);
      const double next = std::clamp(t + step, edge.first, edge.last);
      if (std::abs(next - t) <= 1e-14 * (edge.last - edge.first)) break;
      t = next;
    }
    return t;
  }

  CountTable table_of(EdgeId id) {
    const auto make = [&] {
      SizingField::Sampler sampler(field_, shape_.edges[id]);
      return tabulate(shape_.edges[id], plan_.tiny.edges[id] == id, sampler);
    };
    if (known_ == nullptr) return make();
    known_->resize(n_);
    if ((*known_)[id].counts.empty()) (*known_)[id] = make();
    return (*known_)[id];
  }

  /// How many segments a remedy may ask for on a part of an edge.
  int most_segments(const EdgeStretch& part) const {
    const CadEdge& edge = shape_.edges[part.edge];
    const double length = edge.length * (part.to - part.from) / (edge.last - edge.first);
    return plan_.shortest_segment > 0 ? std::max(2, to_int(std::ceil(length / plan_.shortest_segment)))
                                      : std::numeric_limits<int>::max();
  }

  bool is_prescribed(EdgeId edge) const {
    return !plan_.prescribed.empty() && plan_.prescribed[edge].has_value();
  }

  /// Adds the segments on which rows end to those that the sizes give on the rest of the edge.
  void add_heads(EdgeId i) {
    const auto heads = plan_.rows.heads.find(i);
    if (heads == plan_.rows.heads.end()) return;
    const auto [from, to] = counts_between(i, heads->second);
    const int own = heads->second.segments(), least = own + 1;
    targets_.wanted[i] = (own + std::max(1.0, plan_.factor[i] * (to - from))) / result_.stride;
    targets_.least[i] = std::max(targets_.least[i], (least + result_.stride - 1) / result_.stride);
    targets_.least_of_grids[i] = std::max(targets_.least_of_grids[i], least);
  }

  static double sum_of(const std::vector<double>& lengths) {
    return std::accumulate(lengths.begin(), lengths.end(), 0.0);
  }

  /// The counts by the sizing field at the ends of the part of an edge between its heads.
  std::pair<double, double> counts_between(EdgeId edge, const EdgeHeads& heads) const {
    const CountTable& table = tables_[edge];
    return {table.count_at_length(sum_of(heads.first)),
            table.count_at_length(table.length() - sum_of(heads.last))};
  }

  /// The places of an edge's nodes: its heads, and between them by the sizes; none if the heads have no room.
  std::vector<double> shares_with_heads(EdgeId edge, const EdgeHeads& heads) const {
    const CountTable& table = tables_[edge];
    const int between = counts_[edge] - heads.segments();
    if (between < 1) return {};
    const auto [from, to] = counts_between(edge, heads);
    std::vector<double> places{0};
    for (const double length : heads.first) places.push_back(places.back() + length);
    for (int k = 1; k < between; ++k) places.push_back(table.length_at(from + (to - from) * k / between));
    places.push_back(table.length() - sum_of(heads.last));
    for (auto length = heads.last.rbegin(); length != heads.last.rend(); ++length)
      places.push_back(places.back() + *length);
    for (double& place : places) place /= table.length();
    places.back() = 1;
    return places;
  }

  /// Faces with rows along chains, and faces at the edges on which rows end, are not treated as grids, which
  /// would pass the short segments on to edges far away: their sides need not face each other.
  void free_sides_beside_chains(FaceOutlines& sides) const {
    FaceFlags freed(shape_.faces.size());
    for (const FaceId face : freed.ids()) freed[face] = has_chain(plan_.rows.of_faces, face);
    for (const auto& [edge, heads] : plan_.rows.heads)
      for (const FaceId face : shape_.edges[edge].faces) freed[face] = 1;
    for (const FaceId face : freed.ids()) {
      if (!freed[face] || !used_[face]) continue;
      sides[face] = {};
      for (const CadWire& wire : shape_.faces[face].wires)
        for (const Coedge& coedge : wire.coedges) sides[face].rest.push_back(coedge.edge);
    }
  }

  /// Users may prescribe too few segments to keep the edge's shape, but a loop must stay open.
  void fix_count(EdgeId i, bool shares_both_ends, bool inner) {
    const int segments = plan_.prescribed[i]->segments;
    const bool closed = plan_.tiny.closed(shape_.edges[i]);
    constexpr double hardly = 0.01;
    const double turning = std::min(tables_[i].turning, hardly);
    const int least = least_segments(closed, turning, shares_both_ends, inner, result_.stride);
    const bool needs_stride = closed || shares_both_ends || inner;
    if (plan_.prescribed[i]->is_fixed() && segments < (needs_stride ? result_.stride * least : 1))
      throw usage_error("segments", fmt::format("`segments` gives {} to Edge{}, which needs {} or more",
                                                segments, shape_.edges[i].number, result_.stride * least));
    if (plan_.prescribed[i]->is_fixed()) targets_.fixed[i] = segments;
    targets_.wanted[i] = 1.0 * segments / result_.stride;
    targets_.least[i] = std::max(1, std::min(targets_.least[i], segments / result_.stride));
    targets_.least_of_grids[i] = std::min(targets_.least_of_grids[i], segments);
  }

  EdgeShares prescribed_shares() const {
    EdgeShares shares(n_);
    for (const EdgeId i : shape_.edges.ids()) {
      if (is_prescribed(i) && counts_[i] > 0) shares[i] = plan_.prescribed[i]->shares_of(counts_[i]);
    }
    for (const auto& [edge, heads] : plan_.rows.heads)
      if (counts_[edge] > 0) shares[edge] = shares_with_heads(edge, heads);
    return shares;
  }

  /// Marks the edges of chords whose count (divided) or spacing (kept) users prescribe.
  void keep_spacing(const Chords& chords) {
    EdgeFlags divided(n_), kept(n_);
    for (const EdgeId i : shape_.edges.ids()) {
      if (plan_.rows.heads.contains(i)) kept[chords.of(i)] = 1;
      if (!is_prescribed(i)) continue;
      divided[chords.of(i)] = 1;
      if (!plan_.prescribed[i]->shares.empty()) kept[chords.of(i)] = 1;
    }
    for (const EdgeId i : shape_.edges.ids()) {
      result_.edges[i].divided = divided[chords.of(i)] != 0;
      result_.edges[i].kept = kept[chords.of(i)] != 0;
    }
  }

  bool along_chord(EdgeId edge) const {
    return plan_.ignore_curvature[edge] && !plan_.tiny.closed(shape_.edges[edge]);
  }

  int add_point(const Vector3& point) {
    result_.points.push_back(point);
    return static_cast<int>(result_.points.size()) - 1;
  }

  /// The node of a vertex; a new one at `fallback` where the edge has no vertex.
  int vertex_node(VertexId vertex, const Vector3& fallback) {
    if (!vertex.exists()) return add_point(fallback);
    const VertexId end = plan_.tiny.end(vertex);
    int& node = result_.vertex_nodes[end];
    if (node < 0) node = add_point(shape_.vertices[end]);
    return result_.vertex_nodes[vertex] = node;
  }

  /// Vertices come first, so that their numbers do not depend on the counts.
  void place_vertices() {
    for (const EdgeId i : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[i];
      if (!used_edges_[i]) continue;
      if (edge.first_vertex.exists()) vertex_node(edge.first_vertex, Vector3::Zero());
      if (edge.last_vertex.exists()) vertex_node(edge.last_vertex, Vector3::Zero());
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (!used_[face]) continue;
      for (const InnerVertex& point : shape_.faces[face].inner_vertices)
        vertex_node(point.vertex, Vector3::Zero());
    }
  }

  void place_nodes(EdgeId i, SparseCheck& check) {
    const CadEdge& edge = shape_.edges[i];
    const EdgeCurve curve(edge);
    BoundaryNodes::Edge& nodes = result_.edges[i];
    const int segments = counts_[i];
    for (int k = 0; k <= segments; ++k) {
      check();
      double t = along_chord(i)       ? parameter_near_chord(edge, curve, k, segments, nodes.parameters)
                 : shares_[i].empty() ? tables_[i].parameter_at(tables_[i].total() * k / segments)
                                      : tables_[i].parameter_at_length(tables_[i].length() * shares_[i][k]);
      if (k == 0) t = edge.first;
      if (k == segments) t = edge.last;
      nodes.parameters.push_back(t);
      if (plan_.tiny.edges[i] != i) continue;  // has the nodes of another edge, see borrow_nodes()
      if (k == 0) {
        nodes.nodes.push_back(vertex_node(edge.first_vertex, curve.point(t)));
      } else if (k == segments) {
        nodes.nodes.push_back(plan_.tiny.closed(edge) ? nodes.nodes.front()
                                                      : vertex_node(edge.last_vertex, curve.point(t)));
      } else {
        nodes.nodes.push_back(add_point(curve.point(t)));
      }
    }
  }

  void borrow_nodes() {
    for (const EdgeId i : shape_.edges.ids()) {
      if (counts_[i] == 0 || plan_.tiny.edges[i] == i) continue;
      auto& edge = result_.edges[i];
      edge.nodes = result_.edges[plan_.tiny.edges[i]].nodes;
      edge.borrowed = {edge.segments(), 0};
      if (plan_.tiny.reversed_edges[i]) std::reverse(edge.nodes.begin(), edge.nodes.end());
    }
  }

  const CadShape& shape_;
  const SizingField& field_;
  const FaceFlags& used_;
  const SamplingPlan& plan_;
  ExecutionContext& context_;
  EdgeTables* known_;  // may be null
  std::size_t n_;      // edges
  EdgeFlags used_edges_;
  IdVector<EdgeId, CountTable> tables_;
  CountTargets targets_;
  IdVector<EdgeId, int> counts_;  // segments of the final mesh
  EdgeShares shares_;             // empty = by own sizes
  BoundaryNodes result_;
};

}  // namespace

SamplingPlan::SamplingPlan(const CadShape& shape)
    : factor(shape.edges.size(), 1),
      ignore_curvature(shape.edges.size()),
      subdivided(shape.faces.size()),
      tiny(find_tiny_features(shape, FaceFlags(shape.faces.size(), 1), EdgeFlags(shape.edges.size()), 0)) {}

BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                           const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known) {
  return EdgeSampler(shape, field, stride, used, plan, context, known).run();
}

}  // namespace quadrille
