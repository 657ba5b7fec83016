#pragma once
/// Nodes that face each other across narrow faces. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/facing_sides.hpp"

namespace quadrille {

/// Moves the nodes of one side of narrow faces to face those of the other: what shifts them by less than a
/// segment shears the quads between by more than a right angle where the face is far narrower than that, and
/// makes the sides of a wedge cross towards its tip.
void align_narrow_faces(const CadShape& shape, const std::vector<char>& used,
                        const std::vector<SplitStrip>& strips, BoundaryNodes& nodes);

}  // namespace quadrille
