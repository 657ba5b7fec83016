#pragma once
/// Perfect matchings of the triangles of a mesh: pairs that become quads. Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/pairing/triangle_graph.hpp"

namespace quadrille {

/// Pairs triangles that have but one free neighbour (ears first) with it, then along the sides in order of
/// cost. Needs the costs. Time: linear (the order is a bucket sort).
void pair_greedily(TriangleGraph& graph, const ExecutionContext& context = {});

/// How many triangles a search for a partner looks at.
constexpr int reach_of_paths = 100'000;

/// Pairs more triangles by exchange along alternating paths: a free triangle, a pair, ..., a pair, a free
/// triangle. The nearest partner is taken, searched for over at most `reach` triangles. \return the number of
/// triangles still free: 0 if there is a way to pair all within reach.
int augment(TriangleGraph& graph, int reach = reach_of_paths, const ExecutionContext& context = {});

/// Lets the remaining free triangles walk: a triangle and a quad beside it are a pentagon, which can be cut
/// into a quad and a triangle on the far side. Two that meet become a quad. Diagonals of pairs are flipped
/// where the way needs it. Afterwards no connected piece has more than one free triangle. \return the number
/// of triangles still free.
int walk(TriangleGraph& graph, const std::vector<Vector3>& points, const ExecutionContext& context = {});

/// Leaves each remaining free triangle free, or instead of it another one of its neighbourhood: exchanges
/// pairs along the alternating path from it that lowers the sum of their costs most. Needs the costs. Time:
/// that of a search over a thousand triangles for each.
void move_free(TriangleGraph& graph, const ExecutionContext& context = {});

/// Exchanges pairs along alternating cycles as long as that lowers the cost:
/// the sum over the quads of pair_cost() and over the points of a charge for the deviation from the ideal
/// number of quads there (4 inside; on the boundary one for every 90 degrees). The graph's objective weighs
/// the two, and decides how far cycles are searched for. \return the number of cycles exchanged.
int exchange(TriangleGraph& graph, const std::vector<Vector3>& points, ExecutionContext& context);

}  // namespace quadrille
