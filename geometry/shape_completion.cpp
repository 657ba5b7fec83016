#include "geometry/shape_completion.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeFix_Wire.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>

#include <fmt/format.h>

namespace quadrille {

namespace {

bool lacks_curves(const TopoDS_Face& face) {
  if (BRep_Tool::Surface(face).IsNull()) return false;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    double first = 0, last = 0;
    if (BRep_Tool::CurveOnSurface(TopoDS::Edge(it.Current()), face, first, last).IsNull()) return true;
  }
  return false;
}

void add_curves(const TopoDS_Face& face) {
  for (TopExp_Explorer it(face, TopAbs_WIRE); it.More(); it.Next()) {
    ShapeFix_Wire fix(TopoDS::Wire(it.Current()), face, BRep_Tool::Tolerance(face));
    fix.FixEdgeCurves();  // those of the edges, in place
  }
}

}  // namespace

TopoDS_Shape with_parametric_curves(const TopoDS_Shape& shape, std::vector<std::string>& problems) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<int> incomplete;
  for (int i = 1; i <= faces.Extent(); ++i) {
    if (lacks_curves(TopoDS::Face(faces(i)))) incomplete.push_back(i);
  }
  if (incomplete.empty()) return shape;
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, Standard_False).Shape();
  TopTools_IndexedMapOfShape copied;
  TopExp::MapShapes(copy, TopAbs_FACE, copied);
  for (const int i : incomplete) {
    try {
      add_curves(TopoDS::Face(copied(i)));
      problems.push_back(fmt::format("Face{} lacked parametric curves: they were made by projection", i));
    } catch (const Standard_Failure& problem) {
      problems.push_back(fmt::format("Face{} lacks parametric curves, and they cannot be made ({})", i,
                                     problem.GetMessageString()));
    }
  }
  return copy;
}

TopoDS_Face with_natural_bounds(const TopoDS_Face& face) {
  if (TopExp_Explorer(face, TopAbs_WIRE).More()) return face;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  if (surface.IsNull()) return face;
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface->Bounds(u0, u1, v0, v1);
  for (const double bound : {u0, u1, v0, v1}) {
    if (Precision::IsInfinite(bound)) return face;
  }
  BRepBuilderAPI_MakeFace maker(surface, BRep_Tool::Tolerance(face));
  if (!maker.IsDone()) return face;
  return TopoDS::Face(maker.Face().Oriented(face.Orientation()));
}

}  // namespace quadrille
