#pragma once
/// Nodes that face each other across narrow faces. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/facing_sides.hpp"

namespace quadrille {

/// Moves the nodes on one side of each narrow face so that they face those on the other side. Where a face is
/// far narrower than a segment, a shift by part of a segment shears the quads between beyond use, and lets
/// the rows of a wedge cross towards its tip.
void align_narrow_faces(const CadShape& shape, const FaceFlags& used, const std::vector<SplitStrip>& strips,
                        BoundaryNodes& nodes);

}  // namespace quadrille
