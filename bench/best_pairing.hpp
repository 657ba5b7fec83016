#pragma once
/// The best possible pairing of triangles: the limit of what pairing can reach before nodes move.

#include <vector>

namespace quadrille::bench {

/// Two triangles with a side in common, and the q of their quad.
struct PossiblePair {
  int one, two;
  double q;
};

/// Indices of the pairs of the pairing with the greatest sum of q; with `perfect`, only among pairings that
/// leave no triangle. q is rounded to a millionth for each pair. Empty if there is no such pairing.
std::vector<int> best_pairing(int triangle_count, const std::vector<PossiblePair>& pairs, bool perfect);

}  // namespace quadrille::bench
