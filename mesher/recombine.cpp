/// Triangles into quads: a matching of the triangles, improved by exchange.
/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018): the colouring,
/// and exchange along alternating paths; the cost of an exchange is ours.

#include "mesher/recombine.hpp"

#include <algorithm>

#include "mesher/edge_coloring.hpp"
#include "mesher/matching.hpp"
#include "mesher/renumbering.hpp"
#include "mesher/side_twins.hpp"
#include "mesher/triangle_graph.hpp"

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

/// Pairs by quality: greedily, by augmentation, by walks, by exchange.
void pair_by_cost(TriangleGraph& graph, const TriangleMesh& mesh, const RecombineOptions& options,
                  ExecutionContext& context) {
  graph.objective = options.objective;
  graph.compute_costs(mesh.points);
  context.check();
  pair_greedily(graph);
  if (augment(graph) > 0) walk(graph, mesh.points);
  context.check();
  if (options.exchange) exchange(graph, mesh.points, context);
}

/// Pairs as the paper does: at the edges of one colour. The triangles that this leaves at the boundary are
/// not collapsed but paired too.
TriangleGraph pair_by_color(const TriangleMesh& mesh, std::uint64_t seed, ExecutionContext& context) {
  EdgeColoring coloring(mesh);
  Random random(seed);
  color_greedily(coloring, random);
  context.check();
  remove_blanks(coloring, random);
  context.check();
  const int color = least_boundary_color(coloring);
  clear_boundary(coloring, color, random);
  TriangleGraph graph(mesh, coloring);
  for (int t = 0; t < coloring.size(); ++t) {
    const Side side = coloring.side_of(t, color);
    if (side >= 0 && coloring.twin(side) >= 0) graph.triangles[t].mate = index_of(side);
  }
  return graph;
}

QuadMesh recombine_in_order(const TriangleMesh& mesh, const RecombineOptions& options,
                            ExecutionContext& context) {
  if (options.paper_mode) {
    TriangleGraph graph = pair_by_color(mesh, options.seed, context);
    if (options.pair_rest && augment(graph) > 0) walk(graph, mesh.points);
    return collect(graph, mesh);
  }
  TriangleGraph graph(mesh);
  pair_by_cost(graph, mesh, options, context);
  return collect(graph, mesh);
}

}  // namespace

QuadMesh recombine(const TriangleMesh& mesh, const RecombineOptions& options, ExecutionContext& context) {
  check_indices(mesh);
  if (!is_scattered(mesh)) return recombine_in_order(mesh, options, context);
  try {
    RenumberedMesh ordered = order_by_place(mesh);
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
