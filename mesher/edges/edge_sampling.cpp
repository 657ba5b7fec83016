/// Finds the least and wanted counts of all edges, chooses the counts, and places nodes along the curves.

#include "mesher/edges/edge_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "geometry/surfaces/edge_curve.hpp"
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
  std::map<std::pair<VertexId, VertexId>, std::vector<EdgeId>> between;  // ends -> edges
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    if (edge.degenerate || tiny.closed(edge) || tiny.edges[id] != id) continue;
    between[std::minmax({tiny.end(edge.first_vertex), tiny.end(edge.last_vertex)})].push_back(id);
  }
  EdgeFlags shared(shape.edges.size());
  for (const auto& [ends, edges] : between)
    for (const EdgeId edge : edges) shared[edge] = edges.size() > 1;
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

/// What the sizing field and the plan ask of each edge.
struct EdgeDemand {
  EdgeFlags used;  ///< 1 = the edge has nodes
  EdgeTables tables;
  CountTargets targets;
};

/// No segment of an edge is shorter unless users give sizes below it by name there.
double least_size(const SizingField& field, const SamplingPlan& plan, EdgeId edge) {
  return is_set(plan.below_size_min, edge) ? field.limits().least : field.limits().size_min;
}

class TargetFinder {
 public:
  TargetFinder(const CadShape& shape, const SizingField& field, int stride, const SamplingPlan& plan,
               ExecutionContext& context, EdgeTables& known)
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
    known_.resize(n_);
    demand_.tables.resize(n_);
    targets_.stride = stride_;
    targets_.check = [&context = context_] { context.check(); };
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
      if (edge.degenerate || edge.length <= 0 || !demand_.used[i] || plan_.tiny.collapsed_edges[i]) continue;
      demand_.tables[i] = table_of(i);
      const int stride = edge.is_used(plan_.subdivided) ? 2 : stride_;
      bool is_finer = false;
      for (const EdgeStretch& part : plan_.finer) {
        if (part.edge != i) continue;
        demand_.tables[i].make_finer(part.from, part.to,
                                     std::min(part.segments * stride, most_segments(part)));
        is_finer = true;
      }
      double& wanted = targets_.wanted[i];
      wanted = std::min(demand_.tables[i].total(), most_at_least_size(i, 1)) / stride_;
      // An edge has at least one segment, which the factor multiplies.
      if (plan_.factor[i] > 1) wanted = std::max(wanted, 1.0) * plan_.factor[i];
      if (plan_.along_chord(i, edge)) wanted *= chord_of(edge) / edge.length;
      segments += stride_ * wanted;
      hold_segments(segments, field_.options().budget, edge);
      const double turning = plan_.ignore_curvature[i] ? 0 : demand_.tables[i].turning;
      targets_.least[i] = least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride_);
      // The count that a face needs to be meshed at all overrides the wanted counts of opposite edges.
      if (is_finer) targets_.least[i] = std::max(targets_.least[i], to_int(wanted));
      raise_least(i, turning, is_finer || shared_ends[i] != 0 || inner[i] != 0);
      if (plan_.prescribes(i)) {
        fix_count(i, shared_ends[i], inner[i]);
      } else if (stride != stride_) {
        targets_.even[i] = 1;
        targets_.least[i] = std::max(
            targets_.least[i] + targets_.least[i] % 2,
            stride * least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride));
      }
    }
    return std::move(demand_);
  }

 private:
  /// How many times `unit` segments an edge has room for where the least size limits them, or infinity: the
  /// count is rounded down there, since with one more all would be shorter. Sizes that are given by name may
  /// be below the least.
  double most_at_least_size(EdgeId i, int unit) const {
    constexpr double rounding = 1 + 1e-6;
    const double room = rounding * shape_.edges[i].length / least_size(field_, plan_, i);
    return demand_.tables[i].total() > room ? std::numeric_limits<double>::infinity()
                                            : std::max(1.0, std::floor(room / unit));
  }

  /// Sets the least count between grids, and raises both least counts on arcs.
  void raise_least(EdgeId i, double turning, bool needs_least) {
    const double wanted = targets_.wanted[i];
    int &least = targets_.least[i], &of_grids = targets_.least_of_grids[i];
    // Between grids, one segment may do for a straight edge, and for a short arc of up to a quarter turn.
    // Other curves keep their shape there as elsewhere.
    constexpr double straight = 1e-3, quarter_turn = 1.6;
    const bool is_curve = turning > straight && (stride_ * wanted > 1 || turning > quarter_turn);
    of_grids = is_curve || needs_least ? stride_ * least : 1;
    if (turning <= least_arc) return;
    // On an arc, the number that the sizes give is a minimum: the stresses there depend on it. Only a least
    // size that users gave goes before it.
    constexpr double nearly = 0.25;
    double of_arc = std::ceil(wanted - nearly);
    if (field_.options().size_min > 0) of_arc = std::min(of_arc, most_at_least_size(i, stride_));
    least = std::max(least, to_int(of_arc));
    of_grids = std::max(of_grids, to_int(std::ceil(stride_ * wanted - nearly)));
  }

  CountTable table_of(EdgeId id) {
    CountTable& known = known_[id];
    if (known.counts.empty()) {
      SizingField::Sampler sampler(field_, shape_.edges[id]);
      known = tabulate(shape_.edges[id], plan_.tiny.edges[id] == id, sampler);
    }
    return known;
  }

  /// How many segments a remedy may ask for on a part of an edge.
  int most_segments(const EdgeStretch& part) const {
    const CadEdge& edge = shape_.edges[part.edge];
    const double length = edge.length * (part.to - part.from) / (edge.last - edge.first);
    return plan_.shortest_segment > 0 ? std::max(2, to_int(std::ceil(length / plan_.shortest_segment)))
                                      : std::numeric_limits<int>::max();
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
    if (plan_.prescribed[i]->is_fixed()) targets_.fixed[i] = segments;
    targets_.wanted[i] = 1.0 * segments / stride_;
    targets_.least[i] = std::max(1, std::min(targets_.least[i], segments / stride_));
    targets_.least_of_grids[i] = std::min(targets_.least_of_grids[i], segments);
  }

  const CadShape& shape_;
  const SizingField& field_;
  const int stride_;
  const SamplingPlan& plan_;
  ExecutionContext& context_;
  EdgeTables& known_;
  const std::size_t n_;  // edges
  EdgeDemand demand_;
  CountTargets& targets_ = demand_.targets;
};

/// The numbers of segments, and where nodes lie on the edges.
struct Division {
  EdgeCounts counts;
  PlannedSpacing spacing;
};

/// \param sides see choose_counts()
Division divide_edges(const CadShape& shape, const SamplingPlan& plan, const EdgeDemand& demand,
                      FaceOutlines& sides) {
  Division result{choose_counts(shape, demand.targets, plan.tiny, sides), {}};
  const auto& [counts, chords] = result.counts;
  PlannedSpacing& spacing = result.spacing;
  spacing.divided.resize(counts.size());
  spacing.kept.resize(counts.size());
  EdgeShares shares(counts.size());
  for (const EdgeId i : counts.ids()) {
    if (!plan.prescribes(i)) continue;
    const PrescribedEdge& prescribed = *plan.prescribed[i];
    spacing.divided[chords.of(i)] = 1;
    if (!prescribed.shares.empty()) spacing.kept[chords.of(i)] = 1;
    if (counts[i] > 0) shares[i] = PrescribedEdge::make(shape.edges[i], counts[i], prescribed.spacing).shares;
  }
  spacing.shares = space_chords(shape, sides, chords, demand.tables, counts, shares);
  return result;
}

/// The parameter of node k on a curve that may have loops: where the curve comes nearest to the point that
/// divides its chord in equal parts, between its ends. \param before parameters of nodes 0 .. k - 1.
double parameter_near_chord(const CadEdge& edge, const EdgeCurve& curve, int k, int segments,
                            const std::vector<double>& before) {
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

class NodePlacer {
 public:
  NodePlacer(const CadShape& shape, const SamplingPlan& plan, const EdgeDemand& demand,
             const Division& division)
      : shape_(shape), plan_(plan), demand_(demand), division_(division) {}

  BoundaryNodes run(const FaceFlags& used, ExecutionContext& context) && {
    result_.stride = demand_.targets.stride;
    result_.vertex_nodes.assign(shape_.vertices.size(), -1);
    result_.edges.resize(shape_.edges.size());
    place_vertices(used);
    context.check();
    SparseCheck check(context, 64);
    const auto& [counts, chords] = division_.counts;
    for (const EdgeId i : shape_.edges.ids()) {
      result_.edges[i].divided = division_.spacing.divided[chords.of(i)] != 0;
      result_.edges[i].kept = division_.spacing.kept[chords.of(i)] != 0;
      if (counts[i] > 0) place_nodes(i, check);
    }
    return std::move(result_);
  }

 private:
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
  void place_vertices(const FaceFlags& used) {
    const auto place = [&](VertexId vertex) {
      if (vertex.exists()) vertex_node(vertex, Vector3::Zero());
    };
    for (const EdgeId i : shape_.edges.ids()) {
      if (!demand_.used[i]) continue;
      place(shape_.edges[i].first_vertex);
      place(shape_.edges[i].last_vertex);
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (!used[face]) continue;
      for (const InnerVertex& point : shape_.faces[face].inner_vertices) place(point.vertex);
    }
  }

  void place_nodes(EdgeId i, SparseCheck& check) {
    const CadEdge& edge = shape_.edges[i];
    const EdgeCurve curve(edge);
    BoundaryNodes::Edge& nodes = result_.edges[i];
    const CountTable& table = demand_.tables[i];
    const std::vector<double>& shares = division_.spacing.shares[i];
    const int segments = division_.counts.counts[i];
    for (int k = 0; k <= segments; ++k) {
      check();
      const double t = k == 0          ? edge.first
                       : k == segments ? edge.last
                       : plan_.along_chord(i, edge)
                           ? parameter_near_chord(edge, curve, k, segments, nodes.parameters)
                       : shares.empty() ? table.parameter_at(table.total() * k / segments)
                                        : table.parameter_at_length(table.length() * shares[k]);
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

  const CadShape& shape_;
  const SamplingPlan& plan_;
  const EdgeDemand& demand_;
  const Division& division_;
  BoundaryNodes result_;
};

/// Gives edges that share the nodes of another edge those, and lets faces end before their spikes.
void borrow_nodes(const TinyFeatures& tiny, BoundaryNodes& nodes) {
  for (const EdgeId i : nodes.edges.ids()) {
    if (nodes.edges[i].parameters.empty() || tiny.edges[i] == i) continue;
    auto& edge = nodes.edges[i];
    edge.nodes = nodes.edges[tiny.edges[i]].nodes;
    edge.borrows = true;
    if (tiny.reversed_edges[i]) std::ranges::reverse(edge.nodes);
  }
  nodes.left_out = tiny.folded;
}

}  // namespace

SamplingPlan::SamplingPlan(const CadShape& shape, EdgeFlags below)
    : factor(shape.edges.size(), 1),
      below_size_min(std::move(below)),
      ignore_curvature(shape.edges.size()),
      subdivided(shape.faces.size()),
      tiny(find_tiny_features(shape, FaceFlags(shape.faces.size(), 1), EdgeFlags(shape.edges.size()), 0)) {}

BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                           const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known) {
  EdgeTables unknown;
  EdgeDemand demand =
      TargetFinder(shape, field, stride, plan, context, known != nullptr ? *known : unknown).run(used);
  const FaceOutlines found = find_face_sides(shape, used, plan.tiny, demand.targets.wanted);
  FaceOutlines sides = found;
  Division division = divide_edges(shape, plan, demand, sides);
  IdVector<EdgeId, double> shortest;
  for (const EdgeId id : shape.edges.ids()) shortest.push_back(least_size(field, plan, id));
  StripRefiner strips(shape, field.options().aspect, std::move(shortest));
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    const bool refined =
        strips.refine(sides, division.counts, division.spacing, demand.tables, demand.targets);
    if (!(round == 0 && fit_holes_to_grids(shape, sides, division.counts, demand.tables, demand.targets)) &&
        !refined)
      break;
    sides = found;
    division = divide_edges(shape, plan, demand, sides);
  }
  BoundaryNodes nodes = NodePlacer(shape, plan, demand, division).run(used, context);
  borrow_nodes(plan.tiny, nodes);
  nodes.plans = plan_faces(shape, std::move(sides), plan, nodes);
  return nodes;
}

}  // namespace quadrille
