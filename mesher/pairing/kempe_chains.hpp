#pragma once
/// Exchanges the removed color with another one along chains of edges of both, where that gains. Internal.

#include <vector>

#include "mesher/pairing/costed_coloring.hpp"

namespace quadrille {

/// For each free triangle, exchanges along the alternating path from it that lowers the sum of the costs
/// most, if there is one. Another triangle nearby is then free instead. Needs the costs. Time: a search over
/// a thousand triangles for each.
void move_free(CostedColoring& coloring, const ExecutionContext& context = {});

/// Exchanges the removed color with another one along closed chains where that lowers the cost. The cost is
/// the sum of pair_cost() over the pairs plus a charge at each point for the deviation from the ideal number
/// of quads (4 inside; on the boundary one for every 90 degrees). Searches chains around each triangle until
/// nothing gains. All other edges are blank, so a chain chooses the edges of its second color where it gains
/// most. Takes a coloring with the removed color alone. Needs the costs.
void exchange_chains(CostedColoring& coloring, const std::vector<Vector3>& points, ExecutionContext& context);

}  // namespace quadrille
