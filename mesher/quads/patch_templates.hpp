#pragma once
/// Every way to fill a small polygon with quads; not part of the public interface.

#include <array>
#include <cstdint>
#include <vector>

namespace quadrille {

/// One way to fill a polygon with quads.
struct PatchTemplate {
  static constexpr int max_sides = 10, max_interior = 2, max_quads = max_sides / 2 - 1 + max_interior;

  int interior = 0;  ///< nodes inside
  int quads = 0;
  double interior_cost = 0;  ///< sum over the nodes inside of (valence - 4)^2
  std::array<std::array<std::int8_t, 4>, max_quads>
      corners{};                              ///< polygon nodes from 0, then the nodes inside
  std::array<std::int8_t, max_sides> uses{};  ///< quads at each node of the polygon
};

/// The fillings of a polygon of 4, 6, 8 or 10 sides with at most max_interior nodes inside, each of valence 3
/// to 5. Computed once; thread-safe.
const std::vector<PatchTemplate>& patch_templates(int sides);

}  // namespace quadrille
