#pragma once
/// Gaps between solids that are to be one part. Internal.

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>
#include <deque>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// Material between solids.
struct GapFillers {
  std::vector<TopoDS_Shape> solids;
  TopTools_DataMapOfShapeInteger numbers;  ///< of each of their faces: the model's face that it carries on
};

/// What closes the gaps between solids that come near each other, so that a fuse makes one of them: flat
/// faces run on to the faces of other solids that they face, along the walls that end there, and a quarter of
/// the thickness into them, as far as the two face each other. A gap is closed where it is not wider than the
/// thinner of the two walls. Solids that touch need nothing. Gaps between curved faces stay. Time: a ray for
/// each of some 24 points of a face that has another solid near it.
GapFillers fill_gaps(const std::deque<Skin>& solids);

}  // namespace quadrille
