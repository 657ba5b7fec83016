#pragma once
/// Rows of quads of given heights along a loop or a part of one. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/base/trimmed_domain.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/faces/hole_rings.hpp"

namespace quadrille {

/// The nodes beside which rows are placed: a loop, or a chain between two nodes of one.
struct RowPath {
  std::vector<HoleRings::Node> nodes;
  bool closed = true;
  /// (chain) how many nodes before it and after it belong to the edges on which the rows end: one for each
  /// row, or none where the rows end freely.
  std::array<int, 2> heads{0, 0};
};

/// Places rows along a path. A node sends out a ray normal to the path, along which nodes lie at the heights;
/// in a corner it is so long that the rows beside it keep theirs. The rays beside a corner, or beside an edge
/// on which rows end, lean as that does, less and less over three times the distance by which it leans. Where
/// the path turns away from the face by more than 72 degrees, as at a trailing edge, the corner sends out two
/// or three rays, each normal to a side or between them, with blocks of as many quads each way as there are
/// rows. \param side 1 = the face lies on the left of the path, -1 = on the right \return nothing if a row
/// would leave the domain or have a poor quad
std::optional<HoleRings::Hole> place_rows(const RowPath& path, const std::vector<double>& heights,
                                          double side, const FaceSurface& surface,
                                          const TrimmedDomain& domain);

}  // namespace quadrille
