/// Joins edges by BRepBuilderAPI_Sewing and finds coincident faces by inner points.

#include "geometry/cad/sewing.hpp"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <map>
#include <optional>

#include "geometry/cad/face_exchange.hpp"

namespace quadrille {

namespace {

using Faces = std::vector<TopoDS_Shape>;

/// The edges that bound a face, by number, ascending: no seams, no poles.
std::vector<int> rim_of(const TopoDS_Shape& face, const TopTools_IndexedMapOfShape& edges) {
  std::map<int, int> uses;
  for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
    if (!BRep_Tool::Degenerated(TopoDS::Edge(edge.Current()))) ++uses[edges.FindIndex(edge.Current())];
  std::vector<int> rim;
  for (const auto& [edge, times] : uses)
    if (times == 1) rim.push_back(edge);
  return rim;
}

/// A point inside a face: of a grid over its parameters, the one nearest the middle.
std::optional<gp_Pnt> inner_point(const TopoDS_Face& face) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  constexpr std::array<double, 9> shares{0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9};
  for (const double s : shares)
    for (const double t : shares) {
      const gp_Pnt2d uv(u0 + s * (u1 - u0), v0 + t * (v1 - v0));
      if (inside.Perform(uv) == TopAbs_IN) return surface->Value(uv.X(), uv.Y());
    }
  return std::nullopt;
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
  const std::optional<gp_Pnt> point = inner_point(face);
  if (!point) return false;
  GeomAPI_ProjectPointOnSurf foot(*point, BRep_Tool::Surface(other));
  if (foot.NbPoints() == 0 || foot.LowerDistance() > tolerance) return false;
  double u = 0, v = 0;
  foot.LowerDistanceParameters(u, v);
  return BRepTopAdaptor_FClass2d(other, Precision::PConfusion()).Perform(gp_Pnt2d(u, v)) != TopAbs_OUT;
}

Sewn sew(const TopoDS_Shape& shape, double tolerance) {
  TopTools_IndexedMapOfShape faces, edges_before, edges_of_sewn, edges_after;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges_before);
  BRepBuilderAPI_Sewing sewing(tolerance);
  sewing.SetNonManifoldMode(Standard_True);
  for (int i = 1; i <= faces.Extent(); ++i) sewing.Add(faces(i));
  sewing.Perform();
  // Sewn shells have their faces in another order. Exchanging the faces keeps the model's order and solids.
  Faces sewn;
  for (int i = 1; i <= faces.Extent(); ++i) {
    sewn.push_back(sewing.IsModified(faces(i)) ? sewing.Modified(faces(i)) : TopoDS_Shape(faces(i)));
    TopExp::MapShapes(sewn.back(), TopAbs_EDGE, edges_of_sewn);
  }
  Sewn result;
  const bool all_are_faces = std::all_of(sewn.begin(), sewn.end(), [](const TopoDS_Shape& face) {
    return !face.IsNull() && face.ShapeType() == TopAbs_FACE;
  });
  if (all_are_faces) {
    if (edges_of_sewn.Extent() < edges_before.Extent())
      result.orientation = orient_alike(sewn, faces_in_solids(shape, faces));
    result.coincident = coincident_faces(sewn, edges_of_sewn, tolerance);
  }
  result.shape = with_faces(shape, faces, sewn);
  TopExp::MapShapes(result.shape, TopAbs_EDGE, edges_after);
  result.joined = edges_before.Extent() - edges_after.Extent();
  return result;
}

}  // namespace quadrille
