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
    four,  ///< one loop with four corners
    odd,   ///< one loop with three or five corners
    ring,  ///< two loops without corners
    holed  ///< one loop with four corners, and holes without
  };
  Outline outline = Outline::other;
  std::vector<FacingPair> facing;  ///< as many segments on both sides of each
  std::vector<int> rest;           ///< edges (from 0) whose counts have an even sum
  int outer = 0;                   ///< the wire with the corners
  /// (four, odd, holed) the coedges of that wire that the sides start with
  std::vector<int> starts;
};

/// The outlines of the faces used. A corner is where the boundary turns by about a right angle; a side may be
/// several edges. Opposite sides whose vertices stand opposite each other are several pairs, so that each
/// part keeps its own count. \param wanted (edges) number of segments
std::vector<FaceSides> find_face_sides(const CadShape& shape, const std::vector<char>& used,
                                       const TinyFeatures& tiny, const std::vector<double>& wanted);

}  // namespace quadrille
