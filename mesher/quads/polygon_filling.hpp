#pragma once
/// Polygons filled by grids that meet in as few irregular nodes as their sides allow; not part of the public
/// interface.

#include <array>
#include <functional>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Quads inside an outline.
struct PolygonFilling {
  std::vector<Vector3> places;            ///< of the nodes: those of the outline, then those inside
  std::vector<std::array<int, 4>> quads;  ///< by node, counter-clockwise as the outline is
  int irregular = 0;                      ///< nodes inside without four quads
};

/// What a filling may hold.
struct FillingLimits {
  int most_irregular = 2;  ///< nodes inside without four quads
  int least_quads = 1, most_quads = 1'000'000;
};

/// Fills a polygon of two to six corners so that one quad lies at each corner and two at all other nodes of
/// the outline. Grids that meet in one node, or a single one, where the sides allow it; where those do not,
/// and the corners are even in number, grids round two irregular nodes: five and three quads for four
/// corners, three each for two, five each for six.
///
/// \param outline places of the nodes, counter-clockwise
/// \param corners indices into `outline`, ascending
/// \param accept is called with one filling after the other, four at most, those first whose rows suit the
/// distances, until it returns true. Inner nodes lie as transfinite interpolation and some Laplacian sweeps
/// put them.
///
/// \return whether it did.
///
/// Time: quadratic in the longest side, linear in the quads. Based on: Takayama, Panozzo & Sorkine-Hornung,
/// Pattern-based quadrangulation for N-sided patches (2014), for which patterns there are.
bool fill_polygon(const std::vector<Vector3>& outline, const std::vector<int>& corners,
                  const FillingLimits& limits, const std::function<bool(const PolygonFilling&)>& accept);

}  // namespace quadrille
