#include "geometry/cad/sewing.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Iterator.hxx>
#include <vector>

namespace quadrille {

namespace {

/// The same solids and shells, in the same order, of other faces. \param faces of the shape.
TopoDS_Shape with_faces(const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces,
                        const std::vector<TopoDS_Shape>& others) {
  if (shape.ShapeType() == TopAbs_FACE) {
    const int number = faces.FindIndex(shape);
    const bool turned = faces(number).Orientation() != shape.Orientation();
    return turned ? others[number - 1].Reversed() : others[number - 1];
  }
  if (shape.ShapeType() > TopAbs_FACE) return shape;
  TopoDS_Shape result = shape.EmptyCopied();
  result.Location(TopLoc_Location());  // which the parts have, with the orientation
  result.Orientation(TopAbs_FORWARD);
  const BRep_Builder builder;
  for (TopoDS_Iterator part(shape); part.More(); part.Next())
    builder.Add(result, with_faces(part.Value(), faces, others));
  return result;
}

}  // namespace

TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, int& joined) {
  TopTools_IndexedMapOfShape faces, edges_before, edges_after;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_before);
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // The sewn shells order faces as they come: the model with new faces keeps its order, and its solids.
  std::vector<TopoDS_Shape> sewn;
  for (int i = 1; i <= faces.Extent(); ++i)
    sewn.push_back(sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i)));
  const TopoDS_Shape result = with_faces(shape, faces, sewn);
  TopExp::MapShapes(result, TopAbs_EDGE, edges_after);
  joined = edges_before.Extent() - edges_after.Extent();
  return result;
}

}  // namespace quadrille
