#pragma once
/// How triangles are paired.

#include <cstdint>

namespace quadrille {

/// How edges get their colors.
enum class Method {
  quality,  ///< the removed color first, to the edges whose quads are best
  paper     ///< as in the 2018 paper: three colors in the order of the mesh, some steps random
};

/// What the exchange along chains is after.
enum class Objective {
  regular,  ///< points with four quads first: what clean-up and smoothing make the most of
  shape  ///< the greatest mean q as the points stand, irregular points only next: three to eight times slower
};

/// Whether colors are exchanged along chains where angles or valence gain (quality only).
enum class Exchange { where_it_gains, never };

/// What becomes of triangles without an edge of the removed color (paper only: with `quality` they are
/// paired).
enum class Leftovers {
  pair,
  leave  ///< at the boundary, as the paper does before it collapses them (collapse_boundary_triangles())
};

/// How recombine() works.
struct RecombineOptions {
  Method method = Method::quality;  ///< how colors are given
  std::uint64_t seed = 1;           ///< of the random choices of the paper's method; `quality` makes none
  Objective objective = Objective::regular;      ///< of the exchange
  Exchange exchange = Exchange::where_it_gains;  ///< whether there is one
  Leftovers leftovers = Leftovers::pair;         ///< what becomes of them
};

}  // namespace quadrille
