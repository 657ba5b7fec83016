#pragma once
/// Chains of free-form walls whose sides go on into each other smoothly. Internal.

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// The two sides of a wall in a chain. The first faces of a chain lie side by side, and so do the second
/// ones.
struct MatchedSides {
  std::array<int, 2> faces{};     ///< indices into Skin::faces()
  std::array<bool, 4> shared{};   ///< the ends (low u, high u, low v, high v) of the first face's parameters
                                  ///< where the wall goes on into another one of the chain
  std::vector<std::size_t> next;  ///< indices of these walls in the list
};

/// Finds the chains by walking from wall to wall across smooth edges that both sides have in common with the
/// sides of the next wall. On the first side such an edge must be a whole end of the face's parameters.
/// \param pairs two faces each that face each other and no other face more than that, as indices into
/// skin.faces(). \return the pairs that are in a chain of two or more. Quadratic in the pairs.
std::vector<MatchedSides> matched_sides(const Skin& skin, const std::vector<std::array<int, 2>>& pairs);

}  // namespace quadrille
