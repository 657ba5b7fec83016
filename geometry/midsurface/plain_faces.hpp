#pragma once
/// Planes that come as B-splines. Internal.

#include <TopoDS_Shape.hxx>

namespace quadrille {

/// The shape, in which each face whose surface is flat within a ten-millionth of the shape's size lies on a
/// plane. Lofts and many exporters write flat faces as B-splines.
TopoDS_Shape with_plain_faces(const TopoDS_Shape& shape);

}  // namespace quadrille
