#pragma once
/// Coplanar faces that are joined where the edges between them would force small or poor quads. Internal.

#include "geometry/cad/ids.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/simplified_model.hpp"

namespace quadrille {

/// Makes one face of six or more coplanar faces, facets of a program rather than a partition that somebody
/// drew, divided by edges that do harm: the edge is shorter than the least size, or one of the two faces is
/// narrower than the global size or has a corner below 40 degrees at an end of the edge, or the outline would
/// touch itself there. What was joined before counts as one face, so that a face stays once the parts beside
/// it are wide enough. The first face has the outline of all and keeps its number; the others are gone, and
/// the edges between them belong to no face. Faces and edges that the sizes name stay, and so do edges at
/// other than two faces, and faces whose common outline would touch itself. O(n log n) in edges.
void join_coplanar_faces(SimplifiedModel& model, const FaceFlags& used, const SizingOptions& sizing,
                         const SizeLimits& limits);

}  // namespace quadrille
