#pragma once
/// How triangles are paired.

#include <cstdint>

namespace quadrille {

/// How edges get their colors.
enum class Method {
  quality,  ///< the removed color first, to the edges whose quads are best
  paper     ///< as in the 2018 paper: three colors in the order of the mesh, some steps random
};

/// What becomes of triangles without an edge of the removed color (paper only: `quality` pairs them).
enum class Leftovers {
  pair,
  leave  ///< at the boundary, as the paper does before it collapses them (collapse_boundary_triangles())
};

/// How recombine() works.
struct RecombineOptions {
  Method method = Method::quality;  ///< how colors are given
  std::uint64_t seed = 1;           ///< for the random choices of the paper's method; `quality` makes none
  Leftovers leftovers = Leftovers::pair;  ///< what becomes of unpaired triangles
};

}  // namespace quadrille
