#pragma once
/// Ranges of surface parameters that contain faces. Internal.

#include <Geom_Surface.hxx>
#include <array>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// An interval of a surface parameter.
struct ParameterRange {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

/// Points on the edges of faces, including the ends. \param faces indices into skin.faces().
std::vector<gp_Pnt> points_on_edges(const Skin& skin, const std::vector<int>& faces);

/// The ranges of u and v that contain the projections of the points onto a surface, each widened by a margin
/// at both ends. In a periodic direction the whole period, unless the points leave a wide gap. \param points
/// at least one. \param margins for u and v, in units of the parameters.
std::array<ParameterRange, 2> range_of(const Handle(Geom_Surface) & surface,
                                       const std::vector<gp_Pnt>& points,
                                       const std::array<double, 2>& margins);

}  // namespace quadrille
