/// Rebuilds a shape from the top down, with locations and orientations passed on to its faces.

#include "geometry/cad/face_exchange.hpp"

#include <BRep_Builder.hxx>
#include <TopoDS_Iterator.hxx>

namespace quadrille {

TopoDS_Shape with_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces,
                        const std::vector<TopoDS_Shape>& others) {
  if (shape.ShapeType() == TopAbs_FACE) {
    const int number = faces.FindIndex(shape);
    const bool turned = faces(number).Orientation() != shape.Orientation();
    return turned ? others[number - 1].Reversed() : others[number - 1];
  }
  if (shape.ShapeType() > TopAbs_FACE) return shape;
  TopoDS_Shape result = shape.EmptyCopied();
  result.Location(TopLoc_Location());  // the iterated parts already contain location and orientation
  result.Orientation(TopAbs_FORWARD);
  const BRep_Builder builder;
  for (TopoDS_Iterator part(shape); part.More(); part.Next())
    builder.Add(result, with_faces(part.Value(), faces, others));
  return result;
}

}  // namespace quadrille
