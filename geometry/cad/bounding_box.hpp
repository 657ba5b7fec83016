#pragma once
/// The box around a model. Internal.

#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_shape.hpp"

namespace quadrille {

struct BoundingBox {
  Vector3 low{0, 0, 0}, high{0, 0, 0};
};

/// The box around the faces, edges and vertices of a shape whose tables are filled; zero if there are none.
/// Each side is OpenCASCADE's, widened by tolerances, unless that lies beyond the geometry, as control points
/// do: then it is where the trimmed faces end, to about 1e-7 of their size. Takes a few microseconds for each
/// face and edge, and about a millisecond for each face whose own box is too wide.
BoundingBox bounding_box(const CadShape& shape);

}  // namespace quadrille
