#pragma once
/// What CAD files leave out and meshing needs. Internal.

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// The shape with a parametric curve for every edge on every face, made where it was missing. Faces, edges
/// and vertices keep their order. Where nothing is missing the shape itself comes back, else a copy; what was
/// done is added to `problems`, one sentence each.
TopoDS_Shape with_parametric_curves(const TopoDS_Shape& shape, std::vector<std::string>& problems);

/// A face without wires gets the bounds of its surface for a wire; others, and those that a surface without
/// end leaves unbounded, come back as they are.
TopoDS_Face with_natural_bounds(const TopoDS_Face& face);

/// The face with parametric curves made anew by projection of its edges (ShapeFix_Wire), on a copy; the
/// coedges stay as they are otherwise. Throws Error (failure) where that cannot be done.
CadFace with_new_curves(const CadFace& face);

}  // namespace quadrille
