#pragma once
/// Fills polygons with grids that meet in as few irregular nodes as the sides allow; not part of the public
/// interface.

#include <array>
#include <functional>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Quads inside an outline.
struct PolygonFilling {
  std::vector<Vector3> places;            ///< places of the nodes: the outline's, then those inside
  std::vector<std::array<int, 4>> quads;  ///< indices into places, counter-clockwise like the outline
  int irregular = 0;                      ///< nodes inside without four quads
};

/// Limits on a filling.
struct FillingLimits {
  int most_irregular = 2;  ///< nodes inside without four quads
  int least_quads = 1, most_quads = 1'000'000;
};

/// Fills a polygon of two to six corners so that one quad lies at each corner and two at every other node of
/// the outline. Where the sides allow it, the filling is a single grid (four corners) or grids that meet in
/// one irregular node (three or five corners). Otherwise an even number of corners gets grids around two
/// irregular nodes: with five and three quads for four corners, three each for two, five each for six.
///
/// \param outline places of the nodes, counter-clockwise
/// \param corners indices into `outline`, ascending
/// \param accept is called with up to four fillings, one after the other, until it returns true. Fillings
/// whose rows suit the distances best come first. Inner nodes are placed by transfinite interpolation and
/// some Laplacian sweeps.
///
/// \return whether `accept` returned true.
///
/// Time: quadratic in the longest side, linear in the quads. Based on: Takayama, Panozzo & Sorkine-Hornung,
/// Pattern-based quadrangulation for N-sided patches (2014), for which patterns there are.
bool fill_polygon(const std::vector<Vector3>& outline, const std::vector<int>& corners,
                  const FillingLimits& limits, const std::function<bool(const PolygonFilling&)>& accept);

}  // namespace quadrille
