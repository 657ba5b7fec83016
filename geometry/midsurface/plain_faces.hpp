#pragma once
/// Planes, cylinders and the like that come as B-splines. Internal.

#include <TopoDS_Shape.hxx>

namespace quadrille {

/// The shape with faces on planes, cylinders, cones, spheres and tori in place of those whose surfaces are
/// these within a ten-millionth of the shape's size, however they are written: lofts and many exports have
/// B-splines only. Changes the edges of the shape.
TopoDS_Shape with_plain_faces(const TopoDS_Shape& shape);

}  // namespace quadrille
