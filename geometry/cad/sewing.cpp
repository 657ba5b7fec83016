/// Joins edges by BRepBuilderAPI_Sewing and finds coincident faces by inner points.

#include "geometry/cad/sewing.hpp"

#include <BOPTools_AlgoTools3D.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <IntTools_Context.hxx>
#include <algorithm>
#include <map>

#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

using Faces = std::vector<TopoDS_Shape>;

/// The edges that bound a face, by number, ascending: no seams, no poles.
std::vector<int> rim_of(const TopoDS_Shape& face, const TopTools_IndexedMapOfShape& edges) {
  std::map<int, int> uses;
  for (const TopoDS_Edge& edge : edges_of(face)) ++uses[edges.FindIndex(edge)];
  std::vector<int> rim;
  for (const auto& [edge, times] : uses)
    if (times == 1) rim.push_back(edge);
  return rim;
}

std::vector<std::array<int, 2>> coincident_faces(const Faces& faces, const TopTools_IndexedMapOfShape& edges,
                                                 double tolerance) {
  std::map<std::vector<int>, std::vector<int>> by_rim;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<int> rim = rim_of(faces[i], edges);
    if (!rim.empty()) by_rim[std::move(rim)].push_back(static_cast<int>(i));
  }
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [rim, group] : by_rim)
    for (std::size_t i = 0; i < group.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (lies_on(TopoDS::Face(faces[group[j]]), TopoDS::Face(faces[group[i]]), tolerance))
          pairs.push_back({group[j] + 1, group[i] + 1});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

bool lies_on(const TopoDS_Face& face, const TopoDS_Face& other, double tolerance) {
  const Handle(IntTools_Context) context = new IntTools_Context;
  gp_Pnt point;
  gp_Pnt2d uv;
  return BOPTools_AlgoTools3D::PointInFace(face, point, uv, context) == 0 &&
         context->IsValidPointForFace(point, other, tolerance);
}

Sewn sew(const TopoDS_Shape& shape, double tolerance) {
  const TopTools_IndexedMapOfShape faces = map_of(shape, TopAbs_FACE);
  const int edges_before = map_of(shape, TopAbs_EDGE).Extent();
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // Sewn shells have their faces in another order. Exchanging the faces keeps the model's order and solids.
  Faces sewn;
  for (int i = 1; i <= faces.Extent(); ++i)
    sewn.push_back(sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i)));
  Sewn result;
  const bool all_are_faces = std::all_of(sewn.begin(), sewn.end(), [](const TopoDS_Shape& face) {
    return !face.IsNull() && face.ShapeType() == TopAbs_FACE;
  });
  if (all_are_faces) {
    const TopTools_IndexedMapOfShape edges_of_sewn = map_of(sewn, TopAbs_EDGE);
    if (edges_of_sewn.Extent() < edges_before)
      result.orientation = orient_alike(sewn, faces_in_solids(shape, faces));
    result.coincident = coincident_faces(sewn, edges_of_sewn, tolerance);
  }
  result.shape = with_faces(shape, faces, sewn);
  result.joined = edges_before - map_of(result.shape, TopAbs_EDGE).Extent();
  return result;
}

}  // namespace quadrille
