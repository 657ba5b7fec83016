#pragma once
/// Exchanges the faces of a shape. Internal.

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace quadrille {

/// The same solids and shells, in the same order, built of other faces. \param faces the faces of the shape.
/// \param others the replacement of each face, oriented as that face is.
TopoDS_Shape with_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces,
                        const std::vector<TopoDS_Shape>& others);

}  // namespace quadrille
