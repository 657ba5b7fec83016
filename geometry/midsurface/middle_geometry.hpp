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

}  // namespace quadrille
