/// Completes the curves of edges, drops wires that bound nothing, and bounds closed surfaces.

#include "geometry/cad/shape_completion.hpp"

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ShapeFix_Wire.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_MapOfOrientedShape.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

/// Whether edges of the face have curves in space, and parametric curves on it.
struct Completeness {
  bool in_space = true, on_face = true;
};

/// Whether an edge that the file marks as degenerate, a single point, joins two places.
bool is_marked_wrongly(const TopoDS_Edge& edge) {
  if (!BRep_Tool::Degenerated(edge)) return false;
  TopoDS_Vertex first, last;
  TopExp::Vertices(edge, first, last);
  if (first.IsNull() || last.IsNull() || first.IsSame(last)) return false;
  const double reach =
      std::max({BRep_Tool::Tolerance(first), BRep_Tool::Tolerance(last), BRep_Tool::Tolerance(edge)});
  return BRep_Tool::Pnt(first).Distance(BRep_Tool::Pnt(last)) > 2 * reach;
}

Completeness curves_of(const TopoDS_Face& face) {
  Completeness found;
  const bool has_surface = !BRep_Tool::Surface(face).IsNull();
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    double first = 0, last = 0;
    TopLoc_Location place;
    if ((!BRep_Tool::Degenerated(edge) || is_marked_wrongly(edge)) &&
        BRep_Tool::Curve(edge, place, first, last).IsNull())
      found.in_space = false;
    if (has_surface && BRep_Tool::CurveOnSurface(edge, face, first, last).IsNull()) found.on_face = false;
  }
  return found;
}

void add_spatial_curves(const TopoDS_Shape& face) {
  const BRep_Builder builder;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (is_marked_wrongly(edge)) builder.Degenerated(edge, Standard_False);
  }
  BRepLib::BuildCurves3d(face);
}

void add_parametric_curves(const TopoDS_Face& face) {
  for (TopExp_Explorer it(face, TopAbs_WIRE); it.More(); it.Next()) {
    ShapeFix_Wire fix(TopoDS::Wire(it.Current()), face, BRep_Tool::Tolerance(face));
    fix.FixEdgeCurves();  // changes the edges in place
  }
}

/// Whether each edge of a wire occurs once in either direction on the same parametric curve. A seam has two
/// of them.
bool runs_there_and_back(const TopoDS_Wire& wire, const TopoDS_Face& face) {
  TopTools_MapOfOrientedShape pending;
  std::vector<TopoDS_Edge> edges;
  for (TopoDS_Iterator it(wire); it.More(); it.Next()) {
    const TopoDS_Shape& edge = it.Value();
    const TopAbs_Orientation turn = edge.Orientation();
    if (edge.ShapeType() != TopAbs_EDGE || (turn != TopAbs_FORWARD && turn != TopAbs_REVERSED)) return false;
    if (BRep_Tool::Degenerated(TopoDS::Edge(edge))) return false;
    if (pending.Remove(edge.Reversed())) continue;
    if (!pending.Add(edge)) return false;
    edges.push_back(TopoDS::Edge(edge));
  }
  if (edges.empty() || !pending.IsEmpty()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](const TopoDS_Edge& edge) {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) there = BRep_Tool::CurveOnSurface(edge, face, first, last);
    const Handle(Geom2d_Curve) back =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Reversed()), face, first, last);
    if (there.IsNull() || back.IsNull() || Precision::IsInfinite(last - first)) return false;
    for (const double share : {0.0, 0.3, 0.5, 0.7, 1.0}) {
      const double t = first + share * (last - first);
      if (!there->Value(t).IsEqual(back->Value(t), Precision::PConfusion())) return false;
    }
    return true;
  });
}

/// Whether a vertex of a wire is on one of its edges only.
bool has_loose_end(const TopoDS_Shape& wire) {
  TopTools_MapOfShape odd;
  for (const TopoDS_Shape& edge : list_of(wire, TopAbs_EDGE)) {
    for (TopExp_Explorer it(edge, TopAbs_VERTEX); it.More(); it.Next()) {
      const TopoDS_Shape vertex = it.Current().Oriented(TopAbs_FORWARD);
      if (!odd.Add(vertex)) odd.Remove(vertex);
    }
  }
  return !odd.IsEmpty();
}

/// Whether a surface meets itself or ends in a point wherever its parameters end, as spheres and tori do.
bool has_no_border(const Handle(Geom_Surface) & surface) {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  surface->Bounds(u0, u1, v0, v1);
  for (const double bound : {u0, u1, v0, v1}) {
    if (Precision::IsInfinite(bound)) return false;
  }
  ShapeAnalysis_Surface analysis(surface);
  const auto is_point = [&](double u, double v, double other_u, double other_v) {
    return analysis.IsDegenerated(gp_Pnt2d(u, v), gp_Pnt2d(other_u, other_v), Precision::Confusion(), 1);
  };
  return (surface->IsUClosed() || (is_point(u0, v0, u0, v1) && is_point(u1, v0, u1, v1))) &&
         (surface->IsVClosed() || (is_point(u0, v0, u1, v0) && is_point(u0, v1, u1, v1)));
}

}  // namespace

TopoDS_Shape with_all_curves(const TopoDS_Shape& shape, std::vector<std::string>& problems) {
  const TopTools_IndexedMapOfShape faces = map_of(shape, TopAbs_FACE);
  std::vector<std::pair<int, Completeness>> incomplete;
  for (int i = 1; i <= faces.Extent(); ++i) {
    const Completeness found = curves_of(TopoDS::Face(faces(i)));
    if (!found.in_space || !found.on_face) incomplete.emplace_back(i, found);
  }
  if (incomplete.empty()) return shape;
  const TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, Standard_False).Shape();
  const TopTools_IndexedMapOfShape copied = map_of(copy, TopAbs_FACE);
  const auto complete = [&](int face, const char* kind, const char* how, const auto& make) {
    try {
      make(TopoDS::Face(copied(face)));
      problems.push_back(fmt::format("Face{} lacked {} curves: they were made {}", face, kind, how));
    } catch (const Standard_Failure& problem) {
      problems.push_back(fmt::format("Face{} lacks {} curves, and they cannot be made ({})", face, kind,
                                     problem.GetMessageString()));
    }
  };
  // First those in space, which all faces at an edge share.
  for (const auto& [number, found] : incomplete)
    if (!found.in_space) complete(number, "spatial", "from its parametric ones", add_spatial_curves);
  for (const auto& [number, found] : incomplete)
    if (!found.on_face) complete(number, "parametric", "by projection", add_parametric_curves);
  return copy;
}

CadFace with_new_curves(const CadFace& face) {
  CadFace result = face;
  const BRep_Builder builder;
  try {
    result.face = TopoDS::Face(BRepBuilderAPI_Copy(face.face, Standard_False).Shape());
    // The copy has its edges in the original order.
    const TopTools_IndexedMapOfShape edges = map_of(face.face, TopAbs_EDGE),
                                     copies = map_of(result.face, TopAbs_EDGE);
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
    add_parametric_curves(result.face);
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

TopoDS_Face without_idle_wires(const TopoDS_Face& face) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  int wires = 0;
  TopTools_MapOfShape idle;
  std::vector<TopoDS_Shape> open;
  for (TopoDS_Iterator it(forward); it.More(); it.Next()) {
    if (it.Value().ShapeType() != TopAbs_WIRE) continue;
    ++wires;
    if (!runs_there_and_back(TopoDS::Wire(it.Value()), forward)) continue;
    idle.Add(it.Value());
    if (has_loose_end(it.Value())) open.push_back(it.Value());
  }
  if (idle.IsEmpty() || !has_no_border(BRep_Tool::Surface(forward))) return face;
  if (idle.Extent() < wires) {
    for (const TopoDS_Shape& slit : open) idle.Remove(slit);  // in a face that the other wires bound
  }
  if (idle.IsEmpty()) return face;
  const BRep_Builder builder;
  TopoDS_Face result = TopoDS::Face(forward.EmptyCopied());
  for (TopoDS_Iterator it(forward); it.More(); it.Next()) {
    if (!idle.Contains(it.Value())) builder.Add(result, it.Value());
  }
  return TopoDS::Face(result.Oriented(face.Orientation()));
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
