#include "geometry/cad/sewing.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <vector>

#include "geometry/cad/face_exchange.hpp"

namespace quadrille {

TopoDS_Shape sew(const TopoDS_Shape& shape, double tolerance, int& joined) {
  TopTools_IndexedMapOfShape faces, edges_before, edges_after;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_before);
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // Sewn shells have their faces in another order. Exchanging the faces keeps the model's order and solids.
  std::vector<TopoDS_Shape> sewn;
  for (int i = 1; i <= faces.Extent(); ++i)
    sewn.push_back(sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i)));
  const TopoDS_Shape result = with_faces(shape, faces, sewn);
  TopExp::MapShapes(result, TopAbs_EDGE, edges_after);
  joined = edges_before.Extent() - edges_after.Extent();
  return result;
}

}  // namespace quadrille
