#include "geometry/cad/shape_completion.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
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

#include "geometry/base/error.hpp"

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
    fix.FixEdgeCurves();  // changes the edges in place
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

CadFace with_new_curves(const CadFace& face) {
  CadFace result = face;
  const BRep_Builder builder;
  try {
    result.face = TopoDS::Face(BRepBuilderAPI_Copy(face.face, Standard_False).Shape());
    // The copy has its edges in the original order.
    TopTools_IndexedMapOfShape edges, copies;
    TopExp::MapShapes(face.face, TopAbs_EDGE, edges);
    TopExp::MapShapes(result.face, TopAbs_EDGE, copies);
    if (edges.Extent() != copies.Extent()) throw failure("", "the face cannot be copied");
    const Handle(Geom2d_Curve) none;
    for (int i = 1; i <= copies.Extent(); ++i) {
      const TopoDS_Edge& edge = TopoDS::Edge(copies(i));
      if (BRep_Tool::Degenerated(edge)) continue;
      if (BRep_Tool::IsClosed(edge, result.face)) {
        builder.UpdateEdge(edge, none, none, result.face, BRep_Tool::Tolerance(edge));
      } else {
        builder.UpdateEdge(edge, none, result.face, BRep_Tool::Tolerance(edge));
      }
    }
    add_curves(result.face);
    for (CadWire& wire : result.wires) {
      for (Coedge& coedge : wire.coedges) {
        const TopoDS_Edge copy =
            TopoDS::Edge(copies(edges.FindIndex(coedge.source)).Oriented(coedge.source.Orientation()));
        double first = 0, last = 0;
        coedge.parametric_curve = BRep_Tool::CurveOnSurface(copy, result.face, first, last);
        if (coedge.parametric_curve.IsNull()) throw failure("", "an edge cannot be projected");
      }
    }
    BRepTools::UVBounds(result.face, result.u_min, result.u_max, result.v_min, result.v_max);
  } catch (const Standard_Failure& problem) {
    throw failure("", problem.GetMessageString());
  }
  return result;
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
