#pragma once
/// Shapes made of other faces. Internal.

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <vector>

namespace quadrille {

/// The same solids and shells, in the same order, of other faces. \param faces of the shape. \param others
/// what stands for each of them, oriented as they are.
TopoDS_Shape with_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces,
                        const std::vector<TopoDS_Shape>& others);

}  // namespace quadrille
