#pragma once
/// The middle between surfaces that have no exact middle surface, as a B-spline. Internal.

#include <Geom_BSplineSurface.hxx>
#include <array>
#include <optional>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

struct FittedMiddle {
  Handle(Geom_BSplineSurface) surface;
  double off = 0;  ///< largest distance found from the points as far from one side as from the other
};

/// Interpolates points as far from one side as from the other, found over a grid on the first side, which is
/// made finer until the surface between them is off by less than the tolerance; then runs on straight past
/// its bounds. \param sides indices into Skin::faces(), those of the first side on one surface. \param
/// tolerance and \param margin lengths. \return nothing where the sides do not face each other over the
/// whole grid. Time: that of some five projections a point, at most 129 * 129 points.
std::optional<FittedMiddle> fit_middle(const Skin& skin, const std::array<std::vector<int>, 2>& sides,
                                       double tolerance, double margin);

}  // namespace quadrille
