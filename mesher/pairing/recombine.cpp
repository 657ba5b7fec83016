/// Triangles into quads: a matching of the triangles, improved by exchange.
/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018): the colouring,
/// and exchange along alternating paths; the cost of an exchange is ours.

#include "mesher/pairing/recombine.hpp"

#include <algorithm>

#include "mesher/mesh/renumbering.hpp"
#include "mesher/mesh/side_twins.hpp"
#include "mesher/pairing/augmenting_paths.hpp"
#include "mesher/pairing/edge_coloring.hpp"
#include "mesher/pairing/matching.hpp"
#include "mesher/pairing/triangle_graph.hpp"

namespace quadrille {

namespace {

/// The quad of the two triangles at a side, counter-clockwise from the first corner of the side.
std::array<int, 4> quad_across(const TriangleGraph& graph, Side s) {
  return {graph.corner_at(s), graph.apex_of(graph.twin_of(s)), graph.end_of(s), graph.apex_of(s)};
}

QuadMesh collect(const TriangleGraph& graph, const TriangleMesh& mesh) {
  QuadMesh result;
  result.points = mesh.points;
  const bool tagged = !mesh.tags.empty();
  result.quads.reserve(graph.triangles.size() / 2);
  if (tagged) result.quad_tags.reserve(graph.triangles.size() / 2);
  for (int t = 0; t < graph.size(); ++t) {
    const GraphTriangle& triangle = graph.triangles[t];
    if (triangle.mate < 0) {
      result.triangles.push_back({triangle.corner[0], triangle.corner[1], triangle.corner[2]});
      if (tagged) result.triangle_tags.push_back(mesh.tags[t]);
    } else if (graph.mate_of(t) > t) {
      result.quads.push_back(quad_across(graph, make_side(t, triangle.mate)));
      if (tagged) result.quad_tags.push_back(mesh.tags[t]);
    }
  }
  return result;
}

/// Pairs by quality: greedily, by augmentation, by walks, by exchange along paths and cycles.
void pair_by_cost(TriangleGraph& graph, const TriangleMesh& mesh, const RecombineOptions& options,
                  ExecutionContext& context) {
  graph.objective = options.objective;
  graph.compute_costs(mesh.points, context);
  pair_greedily(graph, context);
  if (augment(graph, reach_of_paths, context) > 0 && walk(graph, mesh.points, context) > 0)
    move_free(graph, context);
  context.check();
  if (options.exchange) exchange(graph, mesh.points, context);
}

/// The pairs that a colour makes, as a graph for augment_pairs(): which side each triangle is paired across.
class ColorPairs {
 public:
  ColorPairs(const EdgeColoring& coloring, int color) : coloring_(coloring), mate_(coloring.size()) {
    for (int t = 0; t < size(); ++t) {
      const Side side = coloring.side_of(t, color);
      mate_[t] = static_cast<std::uint8_t>(side >= 0 && coloring.twin(side) >= 0 ? index_of(side) : none);
    }
  }

  int size() const { return coloring_.size(); }
  Side twin_of(Side side) const { return coloring_.twin(side); }
  bool free(int t) const { return mate_[t] == none; }
  int mate_of(int t) const { return free(t) ? -1 : triangle_of(twin_of(diagonal_of(t))); }
  /// The side of a triangle that is not free across which it is paired.
  Side diagonal_of(int t) const { return make_side(t, mate_[t]); }
  void pair(Side side) {
    const Side twin = twin_of(side);
    mate_[triangle_of(side)] = static_cast<std::uint8_t>(index_of(side));
    mate_[triangle_of(twin)] = static_cast<std::uint8_t>(index_of(twin));
  }

 private:
  static constexpr std::uint8_t none = 3;
  const EdgeColoring& coloring_;
  std::vector<std::uint8_t> mate_;
};

QuadMesh collect(const ColorPairs& pairs, const TriangleMesh& mesh) {
  QuadMesh result;
  result.points = mesh.points;
  const bool tagged = !mesh.tags.empty();
  result.quads.reserve(mesh.triangles.size() / 2);
  if (tagged) result.quad_tags.reserve(mesh.triangles.size() / 2);
  for (int t = 0; t < pairs.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    if (pairs.free(t)) {
      result.triangles.push_back(corner);
      if (tagged) result.triangle_tags.push_back(mesh.tags[t]);
      continue;
    }
    const Side side = pairs.diagonal_of(t), twin = pairs.twin_of(side);
    if (twin < side) continue;
    const int i = index_of(side);
    result.quads.push_back({corner[i], mesh.triangles[triangle_of(twin)][previous_index(index_of(twin))],
                            corner[next_index(i)], corner[previous_index(i)]});
    if (tagged) result.quad_tags.push_back(mesh.tags[t]);
  }
  return result;
}

/// Pairs as the paper does: at the edges of one colour. The triangles that this leaves at the boundary are
/// not collapsed but paired too, if asked for.
QuadMesh pair_by_color(const TriangleMesh& mesh, const RecombineOptions& options, ExecutionContext& context) {
  EdgeColoring coloring(mesh);
  Random random(options.seed);
  color_greedily(coloring, random);
  context.check();
  const int blanks = remove_blanks(coloring, random);
  context.check();
  const int color = least_boundary_color(coloring);
  clear_boundary(coloring, color, random);
  ColorPairs pairs(coloring, color);
  if (!options.pair_rest) return collect(pairs, mesh);
  // The colour has left triangles at the boundary alone: the partner of one is one of the next along it.
  std::vector<int> free;
  for (Side side : coloring.boundary()) {
    if (coloring.color(side) == color) free.push_back(triangle_of(side));
  }
  for (int t = 0; blanks > 0 && t < coloring.size(); ++t) {
    if (coloring.side_of(t, color) < 0) free.push_back(t);
  }
  if (augment_pairs(pairs, free, StraightToNext(mesh, free), reach_of_paths, context) == 0)
    return collect(pairs, mesh);
  // Those that no path joins walk, for which diagonals are turned.
  TriangleGraph graph(mesh, coloring);
  for (int t = 0; t < pairs.size(); ++t) {
    if (!pairs.free(t)) graph.triangles[t].mate = index_of(pairs.diagonal_of(t));
  }
  walk(graph, mesh.points, context);
  return collect(graph, mesh);
}

QuadMesh recombine_in_order(const TriangleMesh& mesh, const RecombineOptions& options,
                            ExecutionContext& context) {
  if (options.paper_mode) return pair_by_color(mesh, options, context);
  TriangleGraph graph(mesh, context);
  pair_by_cost(graph, mesh, options, context);
  context.check();
  return collect(graph, mesh);
}

}  // namespace

QuadMesh recombine(const TriangleMesh& mesh, const RecombineOptions& options, ExecutionContext& context) {
  if (!is_scattered(mesh)) return recombine_in_order(mesh, options, context);
  check_indices(mesh);
  try {
    RenumberedMesh ordered = order_by_place(mesh, context);
    QuadMesh result = recombine_in_order(ordered.mesh, options, context);
    ordered.mesh = {};
    for (auto& quad : result.quads) {
      for (int& v : quad) v = ordered.old_point[v];
    }
    for (auto& triangle : result.triangles) {
      for (int& v : triangle) v = ordered.old_point[v];
    }
    result.points = mesh.points;
    return result;
  } catch (const Error& error) {
    // What is wrong with a triangulation is told in its own numbers.
    if (error.kind() == Error::Kind::failure) TriangleGraph{mesh};
    throw;
  }
}

}  // namespace quadrille
