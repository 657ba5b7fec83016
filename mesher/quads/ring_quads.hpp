#pragma once
/// Quads of the rings round holes, joined to those of the rest of a face. Internal.

#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"
#include "mesher/quads/subdivision.hpp"

namespace quadrille {

/// Puts the rings between the holes and the quads of the face inside of them. The nodes of the holes' loops
/// become fixed points, those of the lines round them free ones.
/// \param quads of rings.inside, in the final mesh; out: of the whole face
void add_ring_quads(FaceQuads& quads, const HoleRings& rings, const FaceSurface& surface);

}  // namespace quadrille
