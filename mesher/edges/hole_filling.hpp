#pragma once
/// Small holes, pockets and bosses that are left out: the faces around them are meshed as if they were not
/// there. Internal.

#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/simplified_model.hpp"

namespace quadrille {

/// Fills each hole that is a loop of its own inside one face, or one at each of its two ends, if no point of
/// the loop is farther than `diameter` from another and no point of the hole farther from its axis. A boss is
/// removed in the same way if it is no higher than that. What the sizes name stays: edges, vertices and faces
/// with sizes, segments, or kept. The model itself where there is nothing to fill. Complexity: linear in
/// edges, for each hole inside a hole again.
SimplifiedModel fill_holes(const CadModel& model, const FaceFlags& used, const SizingOptions& sizing,
                           double diameter);

}  // namespace quadrille
