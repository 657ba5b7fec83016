#include "mesher/edges/edge_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/facing_sides.hpp"
#include "mesher/edges/gap_nodes.hpp"
#include "mesher/edges/hole_blocks.hpp"
#include "mesher/edges/narrow_faces.hpp"
#include "mesher/edges/strip_counts.hpp"

namespace quadrille {

namespace {

/// Least number of segments (of the mesh that is recombined) for the edge's shape and an open face loop.
int least_segments(bool closed, double turning, bool shares_both_ends, bool inner, int stride) {
  // Holes and pins need more segments than fillets to keep their area.
  const double turning_a_segment = turning > 2.5 ? 1.3 : 1.8;
  int least = std::max(1, static_cast<int>(std::ceil(turning / turning_a_segment - 0.01)));
  if (shares_both_ends && turning > 1e-3) least = std::max(least, 2);
  if (inner) least = std::max(least, 2);  // the face is cut open between the edge's ends
  if (closed) least = std::max(least, stride == 2 ? 3 : 4);
  return least;
}

/// Edges that share both end vertices with another edge: with one segment each, the two would coincide.
std::vector<char> find_shared_ends(const CadShape& shape, const TinyFeatures& tiny) {
  std::map<std::pair<int, int>, int> count;
  const auto key = [&](const CadEdge& e) -> std::pair<int, int> {
    return std::minmax({tiny.end(e.first_vertex), tiny.end(e.last_vertex)});
  };
  std::vector<char> shared(shape.edges.size(), 0);
  const auto is_open = [&](std::size_t i) {
    return !shape.edges[i].degenerate && !tiny.closed(shape.edges[i]) && tiny.edges[i] == static_cast<int>(i);
  };
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (is_open(i)) ++count[key(shape.edges[i])];
  }
  for (std::size_t i = 0; i < shared.size(); ++i) {
    shared[i] = is_open(i) && count[key(shape.edges[i])] > 1;
  }
  return shared;
}

/// Edges that lie inside a face (cracks).
std::vector<char> find_inner_edges(const CadShape& shape) {
  std::vector<char> inner(shape.edges.size(), 0);
  for (const CadFace& face : shape.faces) {
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) inner[coedge.edge - 1] |= coedge.internal;
    }
  }
  return inner;
}

/// The edges that have nodes: those of the faces used, and those that lend their nodes to them.
std::vector<char> find_used_edges(const CadShape& shape, const std::vector<char>& used,
                                  const TinyFeatures& tiny) {
  std::vector<char> result(shape.edges.size(), 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
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
  EdgeSampler(const CadShape& shape, const SizingField& field, int stride, const std::vector<char>& used,
              const SamplingPlan& plan, ExecutionContext& context)
      : shape_(shape),
        field_(field),
        used_(used),
        plan_(plan),
        context_(context),
        n_(static_cast<int>(shape.edges.size())),
        used_edges_(find_used_edges(shape, used, plan.tiny)) {
    result_.stride = stride;
    result_.subdivided = plan.subdivided;
    if (stride == 2) std::fill(result_.subdivided.begin(), result_.subdivided.end(), 1);
    result_.vertex_nodes.assign(shape.vertices.size(), -1);
    result_.edges.resize(n_);
  }

  BoundaryNodes run() {
    tabulate_edges();
    const std::vector<FaceSides> found = find_face_sides(shape_, used_, plan_.tiny, wishes_.wanted);
    result_.sides = found;
    EdgeCounts chosen = choose_counts(wishes_, plan_.tiny, result_.sides);
    const bool refined = refine_along_strips(shape_, result_.sides, chosen, tables_, wishes_);
    if (fit_holes_to_grids(shape_, result_.sides, chosen, tables_, wishes_) || refined) {
      result_.sides = found;
      chosen = choose_counts(wishes_, plan_.tiny, result_.sides);
    }
    counts_ = chosen.counts;
    result_.odd_faces = chosen.odd_faces;
    shares_ = space_chords(shape_, result_.sides, chosen.chords, tables_, counts_, prescribed_shares());
    keep_spacing(chosen.chords);
    place_vertices();
    context_.check();
    SparseCheck check(context_, 64);
    for (int i = 0; i < n_; ++i) {
      if (counts_[i] > 0) place_nodes(i, check);
    }
    align_narrow_faces(shape_, used_, find_split_strips(shape_, used_, wishes_.wanted), result_);
    align_gaps(shape_, used_, plan_.unaligned, result_);
    borrow_nodes();
    return std::move(result_);
  }

 private:
  void tabulate_edges() {
    const std::vector<char> shared_ends = find_shared_ends(shape_, plan_.tiny);
    const std::vector<char> inner = find_inner_edges(shape_);
    tables_.resize(n_);
    wishes_.stride = result_.stride;
    wishes_.least.assign(n_, 0);
    wishes_.least_of_grids.assign(n_, 0);
    wishes_.wanted.assign(n_, 0);
    wishes_.fixed.assign(n_, 0);
    wishes_.even.assign(n_, 0);
    double segments = 0;
    for (int i = 0; i < n_; ++i) {
      if (i % 256 == 0) context_.report(Stage::sample, 0.5 * i / n_);
      context_.check();
      const CadEdge& edge = shape_.edges[i];
      if (edge.degenerate || edge.length <= 0 || !used_edges_[i] || plan_.tiny.collapsed_edges[i]) continue;
      SizingField::Sampler sampler(field_, edge);
      tables_[i] = tabulate(edge, sampler);
      const bool even = result_.stride == 1 && edge.is_used(plan_.subdivided);
      const int stride = result_.edges[i].stride = even ? 2 : result_.stride;
      bool is_finer = false;
      for (const EdgeStretch& part : plan_.finer) {
        if (part.edge != i + 1) continue;
        tables_[i].make_finer(part.from, part.to, part.segments * stride);
        is_finer = true;
      }
      double& wanted = wishes_.wanted[i];
      wanted = tables_[i].total() / result_.stride;
      // An edge has at least one segment, which the factor multiplies.
      if (plan_.factor[i] > 1) wanted = std::max(wanted, 1.0) * plan_.factor[i];
      if (along_chord(i)) wanted *= chord_of(edge) / edge.length;
      segments += result_.stride * wanted;
      hold_segments(segments, sampler.budget(), edge);
      const double turning = plan_.bare[i] ? 0 : tables_[i].turning;
      wishes_.least[i] =
          least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], result_.stride);
      // What a face needs to be meshed at all does not give way to the wishes of opposite edges.
      if (is_finer) wishes_.least[i] = std::max(wishes_.least[i], static_cast<int>(wanted));
      // Between grids, one segment may do for a straight edge. Curves keep their shape there as elsewhere.
      wishes_.least_of_grids[i] = turning > 1e-3 || is_finer ? result_.stride * wishes_.least[i] : 1;
      if (is_prescribed(i)) {
        fix_count(i, shared_ends[i], inner[i]);
      } else if (even) {
        wishes_.even[i] = 1;
        wishes_.least[i] = std::max(
            wishes_.least[i] + wishes_.least[i] % 2,
            stride * least_segments(plan_.tiny.closed(edge), turning, shared_ends[i], inner[i], stride));
      }
    }
  }

  bool is_prescribed(int edge) const {
    return !plan_.prescribed.empty() && plan_.prescribed[edge].has_value();
  }

  /// Users may prescribe too few segments to keep the edge's shape, but a loop must stay open.
  void fix_count(int i, bool shares_both_ends, bool inner) {
    const int segments = plan_.prescribed[i]->segments;
    const bool closed = plan_.tiny.closed(shape_.edges[i]);
    constexpr double hardly = 0.01;
    const double turning = std::min(tables_[i].turning, hardly);
    const int least = least_segments(closed, turning, shares_both_ends, inner, result_.stride);
    const bool needs_stride = closed || shares_both_ends || inner;
    if (segments < (needs_stride ? result_.stride * least : 1))
      throw usage_error("segments", fmt::format("`segments` gives {} to Edge{}, which needs {} or more",
                                                segments, shape_.edges[i].number, result_.stride * least));
    wishes_.fixed[i] = segments;
    wishes_.wanted[i] = 1.0 * segments / result_.stride;
    wishes_.least[i] = std::max(1, std::min(wishes_.least[i], segments / result_.stride));
    wishes_.least_of_grids[i] = std::min(wishes_.least_of_grids[i], segments);
  }

  std::vector<std::vector<double>> prescribed_shares() const {
    std::vector<std::vector<double>> shares(n_);
    for (int i = 0; i < n_; ++i) {
      if (is_prescribed(i)) shares[i] = plan_.prescribed[i]->shares;
    }
    return shares;
  }

  /// Marks the edges of chords whose count (divided) or spacing (kept) users prescribe.
  void keep_spacing(const Chords& chords) {
    std::vector<char> divided(n_, 0), kept(n_, 0);
    for (int i = 0; i < n_; ++i) {
      if (!is_prescribed(i)) continue;
      divided[chords.of(i)] = 1;
      if (!plan_.prescribed[i]->shares.empty()) kept[chords.of(i)] = 1;
    }
    for (int i = 0; i < n_; ++i) {
      result_.edges[i].divided = divided[chords.of(i)] != 0;
      result_.edges[i].kept = kept[chords.of(i)] != 0;
    }
  }

  bool along_chord(int edge) const { return plan_.bare[edge] && !plan_.tiny.closed(shape_.edges[edge]); }

  int add_point(const Vector3& point) {
    result_.points.push_back(point);
    return static_cast<int>(result_.points.size()) - 1;
  }

  /// The node of a vertex; a new one at `fallback` where the edge has no vertex.
  int vertex_node(int vertex, const Vector3& fallback) {
    if (vertex == 0) return add_point(fallback);
    const int end = plan_.tiny.end(vertex);
    int& node = result_.vertex_nodes[end - 1];
    if (node < 0) node = add_point(shape_.vertices[end - 1]);
    return result_.vertex_nodes[vertex - 1] = node;
  }

  /// Vertices come first, so that their numbers do not depend on the counts.
  void place_vertices() {
    for (int i = 0; i < n_; ++i) {
      const CadEdge& edge = shape_.edges[i];
      if (!used_edges_[i]) continue;
      if (edge.first_vertex > 0) vertex_node(edge.first_vertex, Vector3::Zero());
      if (edge.last_vertex > 0) vertex_node(edge.last_vertex, Vector3::Zero());
    }
    for (std::size_t face = 0; face < shape_.faces.size(); ++face) {
      if (!used_[face]) continue;
      for (const InnerVertex& point : shape_.faces[face].inner_vertices)
        vertex_node(point.vertex, Vector3::Zero());
    }
  }

  void place_nodes(int i, SparseCheck& check) {
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
    for (int i = 0; i < n_; ++i) {
      if (counts_[i] == 0 || plan_.tiny.edges[i] == i) continue;
      auto& edge = result_.edges[i];
      edge.nodes = result_.edges[plan_.tiny.edges[i]].nodes;
      edge.borrowed = true;
      if (plan_.tiny.reversed_edges[i]) std::reverse(edge.nodes.begin(), edge.nodes.end());
    }
  }

  const CadShape& shape_;
  const SizingField& field_;
  const std::vector<char>& used_;
  const SamplingPlan& plan_;
  ExecutionContext& context_;
  int n_;
  std::vector<char> used_edges_;
  std::vector<CountTable> tables_;
  CountWishes wishes_;
  std::vector<int> counts_;                  // segments of the final mesh
  std::vector<std::vector<double>> shares_;  // (edges) places of nodes over length; empty = by own sizes
  BoundaryNodes result_;
};

}  // namespace

SamplingPlan::SamplingPlan(const CadShape& shape)
    : factor(shape.edges.size(), 1),
      bare(shape.edges.size(), 0),
      unaligned(shape.faces.size(), 0),
      subdivided(shape.faces.size(), 0),
      tiny(find_tiny_features(shape, std::vector<char>(shape.faces.size(), 1),
                              std::vector<char>(shape.edges.size(), 0), 0)) {}

BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride,
                           const std::vector<char>& used, const SamplingPlan& plan,
                           ExecutionContext& context) {
  return EdgeSampler(shape, field, stride, used, plan, context).run();
}

}  // namespace quadrille
