#pragma once
/// Alternating paths between triangles that lack the removed color. Internal.
/// Based on: Edmonds, Paths, trees, and flowers (1965).

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/pairing/edge_coloring.hpp"

namespace quadrille {

/// The triangles without a partner, by number.
std::vector<int> free_triangles(const EdgeColoring& coloring);

struct PathOptions {
  int reach = 100'000;  ///< how many triangles a search looks at
  /// The coloring's mesh: a search heads for the next of the list first. None: for the nearest partner.
  const TriangleMesh* heading = nullptr;
};

/// Pairs free triangles by exchange along alternating paths (free triangle, pair, ..., pair, free triangle),
/// as long as there are any within reach. Edges that lose the removed color are blank then. \param free all
/// free triangles. \return how many of them are still free: 0 if there is a way to pair all within reach.
int augment(EdgeColoring& coloring, const std::vector<int>& free, const PathOptions& options = {},
            const ExecutionContext& context = {});

}  // namespace quadrille
