#pragma once
/// The best that any pairing of triangles can do: what there is to be reached before nodes move.

#include <vector>

namespace quadrille::bench {

/// Two triangles with a side in common, and the q of their quad.
struct PossiblePair {
  int one, two;
  double q;
};

/// The pairs, by index, whose q have the greatest sum of all pairings; `perfect`: of those that leave no
/// triangle. Exact to a millionth of a pair. Empty where there is no such pairing.
std::vector<int> best_pairing(int triangle_count, const std::vector<PossiblePair>& pairs, bool perfect);

}  // namespace quadrille::bench
