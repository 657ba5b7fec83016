#pragma once
/// The middle of two sides that have no exact middle surface, as a B-spline or a revolved one. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/midsurface/middle_geometry.hpp"

namespace quadrille {

/// Error of a fitted middle, in tolerances, up to which it is good enough if finer grids gain little.
constexpr double most_tolerances = 10;

/// Interpolates a grid of points that are equally far from both sides. The grid lies in the parameters of the
/// first side. It is refined until the surface between its points is within the tolerance, or within ten
/// times the tolerance if refinement gains little; at most to 128 spans per direction, where it may miss
/// both. Where all faces are surfaces of revolution around one axis, only a profile is fitted, which may end
/// at the axis, and turned around it. The surface is then extended straight past its bounds. \param sides
/// indices into Skin::faces(); the faces of the first side lie on one surface. \param tolerance a length.
/// \param margin length of the extension. \param beside for the ends (low u, high u, low v, high v) of the
/// first side's parameters, the face of the wall with which the middle shares that end, which is not
/// extended; -1 = none. \return nothing if
/// the sides do not face each other over the whole grid. Time: about five projections per point.
std::optional<NearMiddle> fit_middle(const Skin& skin, const std::array<std::vector<int>, 2>& sides,
                                     double tolerance, double margin,
                                     const std::array<int, 4>& beside = {-1, -1, -1, -1});

}  // namespace quadrille
