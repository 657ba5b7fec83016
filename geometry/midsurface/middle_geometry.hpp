#pragma once
/// Surfaces in the middle of two others. Internal.

#include <Geom_Surface.hxx>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// Whether two faces lie on one surface (plane, cylinder, cone, sphere or torus; others: the same object)
/// with the material on the same side of it. \param size of the solid, which coincidence is measured by.
bool on_one_surface(const SkinFace& a, const SkinFace& b, double size);

/// The surface of the points that are as far from the surface of one face as from that of the other: exact
/// for two planes, coaxial cylinders, parallel coaxial cones, concentric spheres, tori about one circle. Null
/// where there is none of these kinds.
Handle(Geom_Surface) middle_surface(const SkinFace& a, const SkinFace& b, double size);

/// A surface that is nearly the middle, and how far it is off.
struct NearMiddle {
  Handle(Geom_Surface) surface;
  double off = 0;
};

/// Between two cylinders with parallel axes, or two spheres, that nearly share their axis or center, such as
/// the two sides of a bend in a wall with draft: the mean of the two, which is off by the square of what they
/// are apart. Null where it is off by more than the tolerance.
NearMiddle near_middle_surface(const SkinFace& a, const SkinFace& b, double tolerance);

}  // namespace quadrille
