#pragma once
/// Every way to fill a small polygon with quads; not part of the public interface.

#include <array>
#include <cstdint>
#include <vector>

#include <boost/container/static_vector.hpp>

namespace quadrille {

/// One way to fill a polygon with quads.
struct PatchTemplate {
  static constexpr int max_sides = 10, max_interior = 2, max_quads = max_sides / 2 - 1 + max_interior;
  static constexpr int max_uses = 5;  ///< quads at one node of the polygon

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

/// What the nodes of a filling cost.
struct FillingCosts {
  /// By node of the polygon, then by the number of quads that the filling has there, from 1.
  std::array<std::array<double, PatchTemplate::max_uses + 1>, PatchTemplate::max_sides> uses;
  /// By the number of nodes inside, added to their valence costs: `resize` for any change of that number,
  /// `drift` for keeping the density.
  std::array<double, PatchTemplate::max_interior + 1> resize, drift;
  double limit;  ///< fillings that cost more are left out
};

/// Fillings, the cheapest first. Fillings of equal cost are in the order of patch_templates().
using CheapestFillings = boost::container::static_vector<const PatchTemplate*, 4>;

/// The fillings that cost least, at most four. The search tree branches by the uses at one node of the
/// polygon after the other; branches that already cost too much are skipped.
CheapestFillings cheapest_fillings(int sides, const FillingCosts& costs);

}  // namespace quadrille
