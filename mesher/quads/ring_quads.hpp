#pragma once
/// Joins the quads of the rings around holes to those of the rest of a face. Internal.

#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/quads/subdivision.hpp"

namespace quadrille {

/// Adds the rings between the holes and the other quads of the face. The nodes of the holes' loops become
/// fixed points, those of the lines around them free points.
/// \param quads in: the final quads of rings.inside; out: the quads of the whole face
void add_ring_quads(FaceQuads& quads, const HoleRings& rings, const FaceSurface& surface);

}  // namespace quadrille
