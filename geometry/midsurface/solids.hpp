#pragma once
/// The solids of a model, each with the skin that walls are looked for in. Internal.

#include <TopoDS_Shape.hxx>
#include <deque>

#include "geometry/midsurface/skin.hpp"

namespace quadrille {

/// The solids of the shape, with the material inside and triangles to sample from; their faces have the
/// shape's numbers. \param join make one solid of those that touch or overlap: of a face that is cut, each
/// part has its number, and of faces inside the material nothing is left. Throws Error (failure) where
/// OpenCASCADE cannot fuse them.
std::deque<Skin> skins_of(const TopoDS_Shape& shape, bool join);

}  // namespace quadrille
