#pragma once
/// Faces as outlines of grids: which edges run along which. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

struct SideEdge {
  int edge;      ///< from 0
  bool forward;  ///< the side runs along the edge's parameter
};

/// Consecutive edges.
using Side = std::vector<SideEdge>;

/// Two sides that run along each other, in the same direction.
struct FacingPair {
  Side first, second;
};

/// What the counts round a face have to keep.
struct FaceSides {
  enum class Outline {
    other,
    four,     ///< one loop with four corners
    odd,      ///< one loop with three or five corners
    stepped,  ///< one loop of right-angled corners both ways, as an L, a T or a comb
    ring,     ///< two loops without corners
    holed     ///< one loop with four corners, and holes without
  };
  Outline outline = Outline::other;
  /// As many segments on both sides of each. Sides of a stepped outline that run along each other are pairs
  /// together, in the order in which they lie.
  std::vector<FacingPair> facing;
  std::vector<int> rest;  ///< edges (from 0) whose counts have an even sum
  int outer = 0;          ///< the wire with the corners
  /// (four, odd, stepped, holed) the coedges of that wire that the sides start with
  std::vector<int> starts;
  /// (stepped) quarters of a turn from the direction of the first side to that of each, from 0 to 3: sides of
  /// 0 and 2 run against each other, and so do those of 1 and 3
  std::vector<int> directions;
};

/// The outlines of the faces used. A corner is where the boundary turns by about a right angle, to the left
/// or, in stepped outlines, to the right; a side may be several edges. Opposite sides whose vertices stand
/// opposite each other are several pairs, so that each part keeps its own count. \param wanted (edges) number
/// of segments
std::vector<FaceSides> find_face_sides(const CadShape& shape, const std::vector<char>& used,
                                       const TinyFeatures& tiny, const std::vector<double>& wanted);

}  // namespace quadrille
