#pragma once
/// How triangles are paired.

#include <cstdint>

namespace quadrille {

/// What the exchange of pairs is after.
enum class Objective {
  regular,  ///< points with four quads first: what clean-up and smoothing make the most of
  shape  ///< the greatest mean q as the points stand, irregular points only next: three to eight times slower
};

struct RecombineOptions {
  bool paper_mode =
      false;  ///< the algorithm of the 2018 paper as it stands: colour, swap, remove; no improvement
  std::uint64_t seed = 1;  ///< of the random choices (paper mode)
  bool pair_rest =
      true;              ///< paper mode: pair what the colour leaves; false: leave it at the boundary, as the
                         ///< paper does before it collapses those triangles (collapse_boundary_triangles())
  bool exchange = true;  ///< exchange along alternating cycles and paths where angles or valence gain
  Objective objective = Objective::regular;  ///< of the exchange
};

}  // namespace quadrille
