/// Finds the wanted and the least counts by the sizing field, the edges' shapes, and what users prescribe.

#include "mesher/edges/edge_targets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "geometry/surfaces/edge_curve.hpp"

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

class TargetFinder {
 public:
  TargetFinder(const CadShape& shape, const SizingField& field, int stride, const SamplingPlan& plan,
               ExecutionContext& context, EdgeTables* known)
      : shape_(shape),
        field_(field),
        stride_(stride),
        plan_(plan),
        context_(context),
        known_(known),
        n_(shape.edges.size()) {}

  EdgeDemand run(const FaceFlags& used) && {
    demand_.used = find_used_edges(shape_, used, plan_.tiny);
    const EdgeFlags shared_ends = find_shared_ends(shape_, plan_.tiny);
    const EdgeFlags inner = find_inner_edges(shape_);
    demand_.tables.resize(n_);
    demand_.targets.stride = stride_;
    demand_.targets.check = [&context = context_] { context.check(); };
    demand_.targets.least.assign(n_, 0);
    demand_.targets.least_of_grids.assign(n_, 0);
    demand_.targets.wanted.assign(n_, 0);
    demand_.targets.fixed.assign(n_, 0);
    demand_.targets.even.assign(n_, 0);
    double segments = 0;
    for (const EdgeId i : shape_.edges.ids()) {
      if (i.index() % 256 == 0) context_.report(Stage::sample, 0.5 * i.index() / static_cast<double>(n_));
      context_.check();
      const CadEdge& edge = shape_.edges[i];
      if (edge.degenerate || edge.length <= 0 || !demand_.used[i] || plan_.tiny.collapsed_edges[i]) continue;
      demand_.tables[i] = table_of(i);
      const int stride = plan_.stride_of(edge, stride_);
      bool is_finer = false;
      for (const EdgeStretch& part : plan_.finer) {
        if (part.edge != i) continue;
        demand_.tables[i].make_finer(part.from, part.to,
                                     std::min(part.segments * stride, most_segments(part)));
        is_finer = true;
      }
      double& wanted = demand_.targets.wanted[i];
      wanted = demand_.tables[i].total() / stride_;
      // An edge has at least one segment, which the factor multiplies.
      if (plan_.factor[i] > 1) wanted = std::max(wanted, 1.0) * plan_.factor[i];
      if (plan_.along_chord(i, edge)) wanted *= chord_of(edge) / edge.length;
      segments += stride_ * wanted;
      hold_segments(segments, field_.budget(), edge);
      const double turning = plan_.ignore_curvature[i] ? 0 : demand_.tables[i].turning;
      demand_.targets.least[i] =
          least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride_);
      // The count that a face needs to be meshed at all overrides the wanted counts of opposite edges.
      if (is_finer) demand_.targets.least[i] = std::max(demand_.targets.least[i], static_cast<int>(wanted));
      raise_least(i, turning, is_finer || shared_ends[i] != 0 || inner[i] != 0);
      add_heads(i);
      if (plan_.prescribes(i)) {
        fix_count(i, shared_ends[i], inner[i]);
      } else if (stride != stride_) {
        demand_.targets.even[i] = 1;
        demand_.targets.least[i] = std::max(
            demand_.targets.least[i] + demand_.targets.least[i] % 2,
            stride * least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride));
      }
    }
    share_targets();
    return std::move(demand_);
  }

 private:
  /// Sets the least count between grids, and raises both least counts on arcs.
  void raise_least(EdgeId i, double turning, bool needs_least) {
    const double wanted = demand_.targets.wanted[i];
    int &least = demand_.targets.least[i], &of_grids = demand_.targets.least_of_grids[i];
    // Between grids, one segment may do for a straight edge, and for a short arc of up to a quarter turn.
    // Other curves keep their shape there as elsewhere.
    constexpr double straight = 1e-3, quarter_turn = 1.6;
    const bool is_curve = turning > straight && (stride_ * wanted > 1 || turning > quarter_turn);
    of_grids = is_curve || needs_least ? stride_ * least : 1;
    if (turning <= least_arc) return;
    // On an arc, the number that the sizes give is a minimum: the stresses there depend on it.
    constexpr double nearly = 0.25;
    least = std::max(least, to_int(std::ceil(wanted - nearly)));
    of_grids = std::max(of_grids, to_int(std::ceil(stride_ * wanted - nearly)));
  }

  /// Edges with the same nodes get the larger of their wanted counts.
  void share_targets() {
    const auto take = [&](EdgeId to, EdgeId from) {
      const auto raise = [&](auto& values) { values[to] = std::max(values[to], values[from]); };
      if (demand_.targets.fixed[to] != 0 && demand_.targets.fixed[from] != 0)
        return;  // choose_counts() compares them
      raise(demand_.targets.least);
      raise(demand_.targets.least_of_grids);
      raise(demand_.targets.wanted);
      raise(demand_.targets.fixed);
      raise(demand_.targets.even);
    };
    for (auto copy = plan_.matched.rbegin(); copy != plan_.matched.rend(); ++copy) take(copy->from, copy->to);
    for (const MatchedEdge& copy : plan_.matched) {
      take(copy.to, copy.from);
      demand_.targets.tied.push_back({{copy.from, true}, {copy.to, !copy.reversed}});
    }
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

  /// Adds the segments on which rows end to those that the sizes give on the rest of the edge.
  void add_heads(EdgeId i) {
    const auto heads = plan_.rows.heads.find(i);
    if (heads == plan_.rows.heads.end()) return;
    const auto [from, to] = counts_between(demand_.tables[i], heads->second);
    const int own = heads->second.segments(), least = own + 1;
    demand_.targets.wanted[i] = (own + std::max(1.0, plan_.factor[i] * (to - from))) / stride_;
    demand_.targets.least[i] = std::max(demand_.targets.least[i], (least + stride_ - 1) / stride_);
    demand_.targets.least_of_grids[i] = std::max(demand_.targets.least_of_grids[i], least);
  }

  /// Users may prescribe too few segments to keep the edge's shape, but a loop must stay open.
  void fix_count(EdgeId i, bool shares_both_ends, bool inner) {
    const int segments = plan_.prescribed[i]->segments;
    const bool closed = plan_.tiny.closed(shape_.edges[i]);
    constexpr double hardly = 0.01;
    const double turning = std::min(demand_.tables[i].turning, hardly);
    const int least = least_segments(closed, turning, shares_both_ends, inner, stride_);
    const bool needs_stride = closed || shares_both_ends || inner;
    if (plan_.prescribed[i]->is_fixed() && segments < (needs_stride ? stride_ * least : 1))
      throw usage_error("segments", fmt::format("`segments` gives {} to Edge{}, which needs {} or more",
                                                segments, shape_.edges[i].number, stride_ * least));
    if (plan_.prescribed[i]->is_fixed()) demand_.targets.fixed[i] = segments;
    demand_.targets.wanted[i] = 1.0 * segments / stride_;
    demand_.targets.least[i] = std::max(1, std::min(demand_.targets.least[i], segments / stride_));
    demand_.targets.least_of_grids[i] = std::min(demand_.targets.least_of_grids[i], segments);
  }

  const CadShape& shape_;
  const SizingField& field_;
  const int stride_;
  const SamplingPlan& plan_;
  ExecutionContext& context_;
  EdgeTables* known_;    // may be null
  const std::size_t n_;  // edges
  EdgeDemand demand_;
};

}  // namespace

std::pair<double, double> counts_between(const CountTable& table, const EdgeHeads& heads) {
  return {table.count_at_length(sum_of(heads.first)),
          table.count_at_length(table.length() - sum_of(heads.last))};
}

EdgeDemand edge_demand(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                       const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known) {
  return TargetFinder(shape, field, stride, plan, context, known).run(used);
}

}  // namespace quadrille
