#pragma once
/// The box around a model. Internal.

#include <Bnd_Box.hxx>

#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

/// The box around the faces, edges and vertices of a shape whose tables are filled; zero if there are none.
/// Each side is OpenCASCADE's, widened by tolerances, unless that lies beyond the geometry, as control points
/// do: then it is where the trimmed faces end, to about 1e-7 of their size. Takes a few microseconds for each
/// face and edge, and about a millisecond for each face whose own box is too wide.
Eigen::AlignedBox3d bounding_box(const CadShape& shape);

/// OpenCASCADE's own box around a face, an edge or more: quick, but often too wide. Void if it is nowhere.
Bnd_Box box_of(const TopoDS_Shape& part);

}  // namespace quadrille
