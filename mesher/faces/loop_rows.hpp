#pragma once
/// Rows of quads of given heights along a closed loop. Internal.

#include <optional>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"

namespace quadrille {

/// Places rows along a loop. A node sends out a ray normal to the loop, along which nodes lie at the heights;
/// in a corner it is so long that the rows beside it keep theirs. Where the loop turns away from the face by
/// more than 72 degrees, as at a trailing edge, the corner sends out two or three rays, each normal to a side
/// or between them, with blocks of as many quads each way as there are rows. \param side 1 = the face lies on
/// the left of the loop, -1 = on the right \return nothing if a row would leave the domain or have a poor
/// quad
std::optional<HoleRings::Hole> place_rows(const std::vector<HoleRings::Node>& loop,
                                          const std::vector<double>& heights, double side,
                                          const FaceSurface& surface, const TrimmedDomain& domain);

}  // namespace quadrille
