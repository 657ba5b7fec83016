#pragma once
/// Surfaces in the middle between two others. Internal.

#include <BRepAdaptor_Surface.hxx>
#include <Geom_Surface.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax3.hxx>
#include <optional>
#include <vector>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// Whether two faces lie on one surface (plane, cylinder, cone, sphere or torus; others: the same object),
/// with the material on the same side of it. \param size size of the solid; tolerances are relative to it.
bool on_one_surface(const SkinFace& a, const SkinFace& b, double size);

/// The surface of the points that are equally far from both faces' surfaces. Exact for two planes, coaxial
/// cylinders, parallel coaxial cones, concentric spheres, and tori about one circle. Null for other pairs.
Handle(Geom_Surface) middle_surface(const SkinFace& a, const SkinFace& b, double size);

/// The local axes of a plane, cylinder, cone, sphere or torus; none of other surfaces.
std::optional<gp_Ax3> frame_of(const BRepAdaptor_Surface& surface);

/// The axis around which u of the first face turns, if all faces lie on surfaces of revolution around it.
std::optional<gp_Ax1> common_axis(const Skin& skin, const std::vector<int>& faces);

/// A surface that is nearly the middle.
struct NearMiddle {
  Handle(Geom_Surface) surface;
  double off = 0;  ///< largest distance found from the true middle
};

/// The mean of two cylinders with parallel axes, or of two spheres, that nearly share their axis or center,
/// such as the two sides of a bend in a wall with draft. Its error is of second order in the distance of the
/// axes or centers. Null if the error exceeds the tolerance, and for all other pairs.
NearMiddle near_middle_surface(const SkinFace& a, const SkinFace& b, double tolerance);

}  // namespace quadrille
