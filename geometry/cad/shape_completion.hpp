#pragma once
/// Adds what meshing needs but CAD files leave out. Internal.

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// The shape with a curve in space for every edge, and a parametric one on every face; missing ones are made
/// from each other where possible. Faces, edges and vertices keep their order. If nothing is missing, returns
/// the shape itself, otherwise a copy. Each change adds a sentence to `problems`.
TopoDS_Shape with_all_curves(const TopoDS_Shape& shape, std::vector<std::string>& problems);

/// The face without wires that bound nothing: on a surface without a border (a sphere, a torus), those whose
/// edges all occur once in either direction, such as a great circle there and back. Their edges keep their
/// numbers, but no face uses them any more. Slits in a face that other wires bound stay. If there are no such
/// wires, returns the face itself.
TopoDS_Face without_idle_wires(const TopoDS_Face& face);

/// For a face without wires: the face bounded by the natural bounds of its surface. Faces that have wires,
/// and those on infinite surfaces, are returned unchanged.
TopoDS_Face with_natural_bounds(const TopoDS_Face& face);

/// A copy of the face whose parametric curves are recomputed by projecting its edges (ShapeFix_Wire).
/// Otherwise the coedges stay the same. Throws Error (failure) when an edge cannot be projected.
CadFace with_new_curves(const CadFace& face);

}  // namespace quadrille
