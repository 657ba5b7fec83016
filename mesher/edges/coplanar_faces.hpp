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
/// the edges between them belong to no face. Facets of a curved surface, narrower than half the size and with
/// less than 15 degrees from one to the next, are joined to planes about as wide as the size which they leave
/// by up to 0.06 times the size (SimplifiedModel::bulge), and so are the edges of their outlines
/// (join_edges_of_facets()). Faces and edges that the sizes name stay, and so do edges at
/// other than two faces, and faces whose common outline would touch itself. O(n log n) in edges.
/// \param joins_facets whether facets of curved surfaces are joined too
void join_coplanar_faces(SimplifiedModel& model, const FaceFlags& used, const SizingOptions& sizing,
                         const SizeLimits& limits, bool joins_facets);

}  // namespace quadrille
