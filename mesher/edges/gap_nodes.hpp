#pragma once
/// Nodes that face each other across gaps inside faces. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"

namespace quadrille {

/// Largest width of a gap that a single row of quads spans, in lengths of the segments on its sides.
constexpr double widest_gap = 0.7;

/// Where two wires of a face are closer than widest_gap segments, as between two holes, moves the nodes of
/// one so that they face those of the other, the nearest pairs first: a row of quads between shifted nodes is
/// sheared beyond use. Skips faces that are grids, unless these have holes. Nodes on edges with a prescribed
/// spacing stay. \param unaligned 1 = skip the face. Time: O(n log n) in the segments of a face if
/// few of them are close.
void align_gaps(const CadShape& shape, const FaceFlags& used, const FaceOutlines& sides,
                const FaceFlags& unaligned, BoundaryNodes& nodes);

}  // namespace quadrille
