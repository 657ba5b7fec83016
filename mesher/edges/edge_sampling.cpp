/// Chooses the counts of all edges, and places nodes along the curves.

#include "mesher/edges/edge_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/edges/edge_counts.hpp"
#include "mesher/edges/edge_targets.hpp"
#include "mesher/edges/face_plan.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/hole_blocks.hpp"
#include "mesher/edges/strip_counts.hpp"

namespace quadrille {

namespace {

/// Faces with rows along chains, and faces at the edges on which rows end, are not treated as grids, which
/// would pass the short segments on to edges far away: their sides need not face each other.
void free_sides_beside_chains(const CadShape& shape, const FaceFlags& used, const RowLines& rows,
                              FaceOutlines& sides) {
  FaceFlags freed(shape.faces.size());
  for (const FaceId face : freed.ids()) freed[face] = has_chain(rows.of_faces, face);
  for (const auto& [edge, heads] : rows.heads)
    for (const FaceId face : shape.edges[edge].faces) freed[face] = 1;
  for (const FaceId face : freed.ids()) {
    if (!freed[face] || !used[face]) continue;
    sides[face] = {};
    for (const CadWire& wire : shape.faces[face].wires)
      for (const Coedge& coedge : wire.coedges) sides[face].rest.push_back(coedge.edge);
  }
}

/// The places of an edge's nodes: its heads, and between them by the sizes; none if the heads have no room.
std::vector<double> shares_with_heads(const CountTable& table, int segments, const EdgeHeads& heads) {
  const int between = segments - heads.segments();
  if (between < 1) return {};
  const auto [from, to] = counts_between(table, heads);
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

EdgeShares prescribed_shares(const SamplingPlan& plan, const EdgeTables& tables,
                             const IdVector<EdgeId, int>& counts) {
  EdgeShares shares(counts.size());
  for (const EdgeId i : counts.ids()) {
    if (plan.prescribes(i) && counts[i] > 0) shares[i] = plan.prescribed[i]->shares_of(counts[i]);
  }
  for (const auto& [edge, heads] : plan.rows.heads)
    if (counts[edge] > 0) shares[edge] = shares_with_heads(tables[edge], counts[edge], heads);
  return shares;
}

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
  spacing.shares = space_chords(shape, sides, chords, demand.tables, counts,
                                prescribed_shares(plan, demand.tables, counts));
  spacing.divided.resize(counts.size());
  spacing.kept.resize(counts.size());
  for (const EdgeId i : counts.ids()) {
    const EdgeId chord = chords.of(i);
    if (plan.rows.heads.contains(i)) spacing.kept[chord] = 1;
    if (!plan.prescribes(i)) continue;
    spacing.divided[chord] = 1;
    if (!plan.prescribed[i]->shares.empty()) spacing.kept[chord] = 1;
  }
  return result;
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
    for (const MatchedEdge& copy : plan_.matched)
      result_.edges[copy.from].matched = result_.edges[copy.to].matched = result_.edges[copy.to].copied =
          true;
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
    for (const EdgeId i : shape_.edges.ids()) {
      const CadEdge& edge = shape_.edges[i];
      if (!demand_.used[i]) continue;
      if (edge.first_vertex.exists()) vertex_node(edge.first_vertex, Vector3::Zero());
      if (edge.last_vertex.exists()) vertex_node(edge.last_vertex, Vector3::Zero());
    }
    for (const FaceId face : shape_.faces.ids()) {
      if (!used[face]) continue;
      for (const InnerVertex& point : shape_.faces[face].inner_vertices)
        vertex_node(point.vertex, Vector3::Zero());
    }
  }

  void place_nodes(EdgeId i, SparseCheck& check) {
    const CadEdge& edge = shape_.edges[i];
    const EdgeCurve curve(edge);
    BoundaryNodes::Edge& nodes = result_.edges[i];
    nodes.stride = plan_.stride_of(edge, result_.stride);
    const CountTable& table = demand_.tables[i];
    const std::vector<double>& shares = division_.spacing.shares[i];
    const int segments = division_.counts.counts[i];
    for (int k = 0; k <= segments; ++k) {
      check();
      double t = plan_.along_chord(i, edge) ? parameter_near_chord(edge, curve, k, segments, nodes.parameters)
                 : shares.empty()           ? table.parameter_at(table.total() * k / segments)
                                            : table.parameter_at_length(table.length() * shares[k]);
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

  const CadShape& shape_;
  const SamplingPlan& plan_;
  const EdgeDemand& demand_;
  const Division& division_;
  BoundaryNodes result_;
};

/// The parameter of a point on a curve, searched from another one by Newton's method.
double parameter_at(const EdgeCurve& curve, const CadEdge& edge, double t, const Vector3& point) {
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

/// Moves the nodes of matched edges to the images of their partners' nodes.
void copy_nodes(const CadShape& shape, const std::vector<MatchedEdge>& matched, BoundaryNodes& nodes) {
  for (const MatchedEdge& copy : matched) {
    const BoundaryNodes::Edge& from = nodes.edges[copy.from];
    BoundaryNodes::Edge& to = nodes.edges[copy.to];
    if (from.segments() != to.segments())
      throw failure("match",
                    fmt::format("`match` cannot give Edge{} the nodes of Edge{}, since one of them is "
                                "left out: use `keep_features`, or a smaller `merge_tiny`",
                                shape.edges[copy.to].number, shape.edges[copy.from].number));
    const EdgeCurve curve(shape.edges[copy.to]);
    for (int k = 1; k < to.segments(); ++k) {
      const Vector3& source = nodes.points[from.nodes[copy.reversed ? from.segments() - k : k]];
      Vector3& point = nodes.points[to.nodes[k]];
      point = copy.motion(source);
      to.parameters[k] = parameter_at(curve, shape.edges[copy.to], to.parameters[k], point);
    }
  }
}

/// Gives edges that share the nodes of another edge those.
void borrow_nodes(const TinyFeatures& tiny, BoundaryNodes& nodes) {
  for (const EdgeId i : nodes.edges.ids()) {
    if (nodes.edges[i].parameters.empty() || tiny.edges[i] == i) continue;
    auto& edge = nodes.edges[i];
    edge.nodes = nodes.edges[tiny.edges[i]].nodes;
    edge.borrowed = {edge.segments(), 0};
    if (tiny.reversed_edges[i]) std::reverse(edge.nodes.begin(), edge.nodes.end());
  }
}

}  // namespace

SamplingPlan::SamplingPlan(const CadShape& shape)
    : factor(shape.edges.size(), 1),
      ignore_curvature(shape.edges.size()),
      subdivided(shape.faces.size()),
      tiny(find_tiny_features(shape, FaceFlags(shape.faces.size(), 1), EdgeFlags(shape.edges.size()), 0)) {}

BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride, const FaceFlags& used,
                           const SamplingPlan& plan, ExecutionContext& context, EdgeTables* known) {
  EdgeDemand demand = edge_demand(shape, field, stride, used, plan, context, known);
  FaceOutlines found = find_face_sides(shape, used, plan.tiny, demand.targets.wanted);
  free_sides_beside_chains(shape, used, plan.rows, found);
  FaceOutlines sides = found;
  Division division = divide_edges(shape, plan, demand, sides);
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    const bool refined = refine_along_strips(shape, sides, division.counts, division.spacing, field.aspect(),
                                             field.size_min(), demand.tables, demand.targets);
    if (!(round == 0 && fit_holes_to_grids(shape, sides, division.counts, demand.tables, demand.targets)) &&
        !refined)
      break;
    sides = found;
    division = divide_edges(shape, plan, demand, sides);
  }
  BoundaryNodes nodes = NodePlacer(shape, plan, demand, division).run(used, context);
  copy_nodes(shape, plan.matched, nodes);
  end_faces_at_tips(shape, plan.tips, plan.tiny, nodes);
  copy_nodes(shape, plan.matched, nodes);
  borrow_nodes(plan.tiny, nodes);
  nodes.plans = plan_faces(shape, std::move(sides), plan, nodes);
  return nodes;
}

}  // namespace quadrille
