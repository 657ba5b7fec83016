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

/// What closes the gaps between solids that come near each other, so that a fuse makes one of them: faces run
/// on to the faces of other solids that they face, and a quarter of the thickness into them, as far as the
/// two face each other. Flat faces run on along the walls that end there; so do bent ends of what runs
/// straight, such as a tube cut to fit round another; other bent faces along their normals, but for spheres
/// round a pole and free forms. A gap is closed where it is not wider than the thinner of the two walls.
/// Solids that touch need nothing. Time: a ray for each of some 24 points of a face that has another solid
/// near it.
GapFillers fill_gaps(const std::deque<Skin>& solids);

}  // namespace quadrille
