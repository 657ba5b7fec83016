#pragma once
/// Exchange of the removed color with another one along chains of edges of the two, where that gains.
/// Internal.

#include <vector>

#include "mesher/pairing/costed_coloring.hpp"

namespace quadrille {

/// Leaves each free triangle free, or instead of it another one of its neighborhood: exchanges along the
/// alternating path from it that lowers the sum of the costs most. Needs the costs. Time: that of a search
/// over a thousand triangles for each.
void move_free(CostedColoring& coloring, const ExecutionContext& context = {});

/// Exchanges the removed color with another one along closed chains, where that lowers the cost: the sum over
/// the pairs of pair_cost() and over the points of a charge for the deviation from the ideal number of quads
/// there (4 inside; on the boundary one for every 90 degrees). First along chains that are searched around
/// each triangle: the other edges being blank, a chain lays its second color as it goes, where it gains most,
/// until nothing gains; the objective decides how far. Then the coloring is completed, and each chain that it
/// has is exchanged if that gains. Takes a coloring with the removed color alone; odd cycles of the other two
/// keep one blank each. Needs the costs.
void exchange_chains(CostedColoring& coloring, const std::vector<Vector3>& points, ExecutionContext& context);

}  // namespace quadrille
