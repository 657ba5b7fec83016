#pragma once
/// Chains of free-form walls whose sides continue into each other smoothly or nearly so. Internal.

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// The two sides of a wall in a chain. The first faces of a chain lie side by side, and so do the second
/// ones.
struct MatchedSides {
  std::array<int, 2> faces{};  ///< indices into Skin::faces()
  /// For the ends (low u, high u, low v, high v) of the first face's parameters, the first face of the wall
  /// into which this one continues there, as index; -1 = none.
  std::array<int, 4> beside{-1, -1, -1, -1};
  std::vector<std::size_t> next;  ///< indices of these walls in the list
};

/// Finds the chains by walking from wall to wall across edges that both sides have in common with the sides
/// of the next wall and at which they turn by less than 20 degrees: there middles that are extended past each
/// other are hardly to be intersected. On the first side such an edge must be a whole end of the face's
/// parameters. \param pairs two faces each that face each other and no other face more than that, as indices
/// into skin.faces(). \return the pairs that are in a chain of two or more. Quadratic in the pairs.
std::vector<MatchedSides> matched_sides(const Skin& skin, std::vector<std::array<int, 2>> pairs);

}  // namespace quadrille
