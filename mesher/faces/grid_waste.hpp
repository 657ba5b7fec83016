#pragma once
/// When a grid has far more quads than the sizes request, so that another mesh replaces it: for edges that
/// users make fine (decision 75). Internal.

namespace quadrille {

/// A grid with `wasteful` times the quads that the sizes request is replaced by a mesh with fewer than
/// `fewer` of its quads.
struct GridWaste {
  static constexpr double wasteful = 1.75, fewer = 0.8;
};

/// Whether there are more than `most` times the quads that the sizes request, plus half of the boundary
/// segments. Rows that are fine for one edge also run through areas where larger quads are wanted.
inline bool is_wasteful(double quads, double wanted, double border, double most) {
  return quads > most * wanted + 0.5 * border;
}

/// How many quads a face gets, a grid or others, before either is made. \param wanted number that the sizes
/// request \param border segments on its boundary
inline double expected_with_grid(double in_grid, double others, double wanted, double border) {
  const bool makes_room = is_wasteful(in_grid, wanted, border, GridWaste::wasteful);
  return makes_room && others < GridWaste::fewer * in_grid ? others : in_grid;
}

}  // namespace quadrille
