/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018): coloring,
/// exchange along chains of two colors, removal of a color.

#include "mesher/pairing/recombine.hpp"

#include <utility>

#include "mesher/mesh/side_twins.hpp"
#include "mesher/pairing/augmenting_paths.hpp"
#include "mesher/pairing/costed_coloring.hpp"

namespace quadrille {

namespace {

/// Removes the color: makes a quad of each pair and keeps the free triangles.
/// \param corners returns the corners of a triangle, given its number.
template <class Corners>
QuadMesh remove_color(const EdgeColoring& coloring, const TriangleMesh& mesh, Corners&& corners) {
  QuadMesh result;
  result.points = mesh.points;
  const bool tagged = !mesh.tags.empty();
  result.quads.reserve(mesh.triangles.size() / 2);
  if (tagged) result.quad_tags.reserve(mesh.triangles.size() / 2);
  for (int t = 0; t < coloring.size(); ++t) {
    const std::array<int, 3>& own = corners(t);
    if (coloring.free(t)) {
      result.triangles.push_back(own);
      if (tagged) result.triangle_tags.push_back(mesh.tags[t]);
      continue;
    }
    const Side side = coloring.diagonal_of(t), twin = coloring.twin(side);
    if (twin < side) continue;
    const int i = index_of(side);
    result.quads.push_back({own[i], corners(triangle_of(twin))[previous_index(index_of(twin))],
                            own[next_index(i)], own[previous_index(i)]});
    if (tagged) result.quad_tags.push_back(mesh.tags[t]);
  }
  return result;
}

QuadMesh remove_color(const CostedColoring& coloring, const TriangleMesh& mesh) {
  return remove_color(coloring, mesh,
                      [&](int t) -> const std::array<int, 3>& { return coloring.corners(t); });
}

/// Assigns the removed color by cost, then exchanges it along paths.
CostedColoring color_by_quality(const TriangleMesh& mesh, ExecutionContext& context) {
  const StageTimer timer(context, Stage::color);
  CostedColoring coloring(mesh, context);
  coloring.compute_costs(mesh.points, context);
  color_by_cost(coloring, context);
  if (augment(coloring, free_triangles(coloring), {}, context) > 0)
    migrate_free_triangles(coloring, mesh.points, context);
  context.check();
  return coloring;
}

/// Assigns three colors as in the paper. The one that occurs least on the boundary becomes the removed one.
/// Edges on the boundary that keep it become blank, which leaves their triangles free. \param free out: the
/// free triangles, one after the other along the boundary.
EdgeColoring color_as_in_paper(const TriangleMesh& mesh, std::uint64_t seed, std::vector<int>& free,
                               ExecutionContext& context) {
  const StageTimer timer(context, Stage::color);
  EdgeColoring coloring(mesh, context);
  Random random(seed);
  color_greedily(coloring, random);
  context.check();
  const int blanks = remove_blanks(coloring, random);
  context.check();
  const std::vector<Side> boundary = coloring.boundary();
  const int least = least_boundary_color(coloring, boundary);
  clear_boundary(coloring, boundary, least, random);
  coloring.swap_colors(least, EdgeColoring::removed);
  for (Side side : boundary) {
    if (coloring.color(side) != EdgeColoring::removed) continue;
    coloring.set_color(side, EdgeColoring::blank);
    free.push_back(triangle_of(side));
  }
  if (blanks > 0) free = free_triangles(coloring);
  return coloring;
}

/// If asked for, triangles that the color leaves are paired too (the paper collapses them).
QuadMesh recombine_as_in_paper(const TriangleMesh& mesh, const RecombineOptions& options,
                               ExecutionContext& context) {
  std::vector<int> free;
  EdgeColoring coloring = color_as_in_paper(mesh, options.seed, free, context);
  const StageTimer timer(context, Stage::recombine);
  if (options.leftovers == Leftovers::pair && augment(coloring, free, {.heading = &mesh}, context) > 0) {
    // Triangles that no path joins walk to each other by edge flips.
    CostedColoring flipped(mesh, std::move(coloring));
    flipped.compute_costs(mesh.points, context);
    migrate_free_triangles(flipped, mesh.points, context);
    return remove_color(flipped, mesh);
  }
  return remove_color(coloring, mesh, [&](int t) -> const std::array<int, 3>& { return mesh.triangles[t]; });
}

}  // namespace

QuadMesh recombine(const TriangleMesh& mesh, const RecombineOptions& options, ExecutionContext& context) {
  if (options.method == Method::paper) return recombine_as_in_paper(mesh, options, context);
  const CostedColoring coloring = color_by_quality(mesh, context);
  const StageTimer timer(context, Stage::recombine);
  return remove_color(coloring, mesh);
}

}  // namespace quadrille
