#include "geometry/cad/sewing.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Compound.hxx>

namespace quadrille {

TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, int& joined) {
  TopTools_IndexedMapOfShape faces, edges_before, edges_after;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_before);
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // The sewn shells order faces as they come: a compound of the faces has the order of the model.
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopoDS_Shape face =
        sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i));
    builder.Add(result, face);
  }
  TopExp::MapShapes(result, TopAbs_EDGE, edges_after);
  joined = edges_before.Extent() - edges_after.Extent();
  return result;
}

}  // namespace quadrille
