#pragma once
/// Planes that come as B-splines. Internal.

#include <TopoDS_Shape.hxx>

namespace quadrille {

/// The shape with faces on planes in place of those whose surfaces are planes within a ten-millionth of the
/// shape's size, however they are written: lofts and many exports have B-splines only.
TopoDS_Shape with_plain_faces(const TopoDS_Shape& shape);

}  // namespace quadrille
