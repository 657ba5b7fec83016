#pragma once
/// Nodes that face each other across gaps inside faces. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// A gap that one row of quads crosses is at most this wide, in lengths of the segments on its sides.
constexpr double widest_gap = 0.7;

/// Where two parts of a face's boundary come nearer to each other than widest_gap segments, as between two
/// holes, moves the nodes of one to where they face those of the other, the nearest pairs first: a row of
/// quads between shifted nodes is sheared beyond use. Nodes of faces that are grids stay, and those of edges
/// whose spacing is asked for. \param unaligned (faces) 1 = not in that face. O(n log n) in the segments of a
/// face, where few come close.
void align_gaps(const CadShape& shape, const std::vector<char>& used, const std::vector<char>& unaligned,
                BoundaryNodes& nodes);

}  // namespace quadrille
