/// Follows prescribed divisions from edge to opposite edge.

#include "mesher/edges/chords.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace quadrille {

namespace {

/// The edge opposite another one across a four-sided face or ring; none if there is no single such edge.
EdgeId opposite(const FaceSides& sides, EdgeId edge) {
  if (!sides.is_filled()) return {};
  for (const FacingPair& pair : sides.facing) {
    if (pair.has_sum()) continue;
    if (pair.first[0].edge == edge) return pair.second[0].edge;
    if (pair.second[0].edge == edge) return pair.first[0].edge;
  }
  return {};
}

/// All edges connected to an edge through opposite(); begins with none if some face has no opposite edge.
std::set<EdgeId> chord_of(const CadShape& shape, const FaceOutlines& sides, EdgeId edge) {
  std::set<EdgeId> chord{edge};
  std::vector<EdgeId> open{edge};
  while (!open.empty()) {
    const EdgeId here = open.back();
    open.pop_back();
    for (const FaceId face : shape.edges[here].faces) {
      const EdgeId next = opposite(sides[face], here);
      if (chord.insert(next).second && next.exists()) open.push_back(next);
    }
  }
  return chord;
}

}  // namespace

EdgeFlags find_grid_rows(const CadShape& shape, const FaceOutlines& sides, const PrescribedEdges& prescribed,
                         const SizingOptions& options, double size) {
  // The number of segments that an edge has in any case; 0 = none.
  const auto fixed_number = [&](EdgeId edge) {
    return prescribed[edge] && prescribed[edge]->is_fixed() ? prescribed[edge]->segments : 0;
  };
  EdgeFlags divided(prescribed.size());
  for (const EdgeId edge : prescribed.ids()) {
    if (!prescribed[edge]) continue;
    const std::set<EdgeId> chord = chord_of(shape, sides, edge);
    if (!chord.begin()->exists()) continue;
    int segments = prescribed[edge]->segments;
    for (const EdgeId member : chord)
      if (!prescribed[edge]->is_fixed() && fixed_number(member) > 0) segments = fixed_number(member);
    divided[edge] = std::ranges::all_of(chord, [&](EdgeId member) {
      if (const int number = fixed_number(member)) return number == segments;
      const double own = std::min(size, value_or(options.edge_sizes, shape.edges[member].number, size));
      const double wanted = std::max(1.0, shape.edges[member].length / own);
      return segments <= largest_fixed_ratio * wanted && wanted <= largest_fixed_ratio * segments;
    });
  }
  return divided;
}

}  // namespace quadrille
