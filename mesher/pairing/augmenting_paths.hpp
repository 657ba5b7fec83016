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
  int reach = 100'000;  ///< a search looks at no more triangles than this
  /// The coloring's mesh: a search first heads for the next free triangle listed; null: for the nearest one.
  const TriangleMesh* heading = nullptr;
};

/// Pairs free triangles by exchange along alternating paths (free triangle, pair, ..., pair, free triangle),
/// as long as there are any within reach. Edges that lose the removed color become blank. \param free all
/// free triangles. \return how many of them are still free: 0 if paths within reach can pair all of them.
int augment(EdgeColoring& coloring, const std::vector<int>& free, const PathOptions& options = {},
            const ExecutionContext& context = {});

}  // namespace quadrille
