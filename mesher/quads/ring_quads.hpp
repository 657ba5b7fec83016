#pragma once
/// Quads of the rings round holes, joined to those of the rest of a face. Internal.

#include "mesher/faces/hole_rings.hpp"
#include "mesher/quads/subdivision.hpp"

namespace quadrille {

/// Puts the rings back between the holes and the quads of the face inside of them. The outermost rings' nodes
/// are no longer fixed. \param boundary of the whole face \param segments those of the triangulation inside;
/// out: of the whole face, renumbered
void add_ring_quads(FaceQuads& quads, std::vector<FaceBoundary::Segment>& segments, const HoleRings& rings,
                    const FaceBoundary& boundary, const FaceSurface& surface);

}  // namespace quadrille
