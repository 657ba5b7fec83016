#include "geometry/midsurface/plain_faces.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <ShapeCustom_Surface.hxx>
#include <ShapeFix_Wire.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>
#include <vector>

#include "geometry/cad/face_exchange.hpp"

namespace quadrille {

namespace {

/// The plane, cylinder, ... that a surface is; null where it is none.
Handle(Geom_Surface) plain_surface(const Handle(Geom_Surface) & surface, double near) {
  const GeomLib_IsPlanarSurface flat(surface, near);
  if (flat.IsPlanar()) return new Geom_Plane(flat.Plan());
  return ShapeCustom_Surface(surface).ConvertToAnalytical(near, Standard_False);
}

/// Whether the other surface has the same side up, at the middle of the face.
bool same_side(const TopoDS_Face& face, const TopoDS_Face& other) {
  const BRepAdaptor_Surface a(face), b(other);
  const double u = 0.5 * (a.FirstUParameter() + a.LastUParameter());
  const double v = 0.5 * (a.FirstVParameter() + a.LastVParameter());
  gp_Pnt at, there;
  gp_Vec du, dv, other_du, other_dv;
  a.D1(u, v, at, du, dv);
  const gp_Pnt2d uv = ShapeAnalysis_Surface(BRep_Tool::Surface(other)).ValueOfUV(at, Precision::Confusion());
  b.D1(uv.X(), uv.Y(), there, other_du, other_dv);
  return du.Crossed(dv).Dot(other_du.Crossed(other_dv)) > 0;
}

/// Gives the edges of a face their curves on its surface, if that is no plane, which needs none.
void add_curves(const TopoDS_Face& face, double near) {
  if (BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane) return;
  for (TopExp_Explorer it(face, TopAbs_WIRE); it.More(); it.Next()) {
    ShapeFix_Wire fix(TopoDS::Wire(it.Current()), face, near);
    fix.ModifyTopologyMode() = Standard_False;
    fix.FixEdgeCurves();
    fix.FixShifted();
  }
}

bool has_seam(const TopoDS_Face& face) {
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    if (BRep_Tool::IsClosed(TopoDS::Edge(it.Current()), face)) return true;
  }
  return false;
}

/// The face on the plane, cylinder, ... that its surface is; itself where that is none, or goes all round.
TopoDS_Face plain_face(const TopoDS_Face& face, double near) {
  const GeomAbs_SurfaceType type = BRepAdaptor_Surface(face, Standard_False).GetType();
  if (type < GeomAbs_BezierSurface || has_seam(face)) return face;
  const Handle(Geom_Surface) surface = plain_surface(BRep_Tool::Surface(face), near);
  if (surface.IsNull()) return face;
  const BRep_Builder builder;
  TopoDS_Face result;
  builder.MakeFace(result, surface, BRep_Tool::Tolerance(face));
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const bool same = same_side(forward, result);
  for (TopoDS_Iterator wire(forward); wire.More(); wire.Next())
    builder.Add(result, same ? wire.Value() : wire.Value().Reversed());
  add_curves(result, near);
  if (!BRepCheck_Analyzer(result).IsValid()) return face;
  const bool reversed = (face.Orientation() == TopAbs_REVERSED) == same;
  return TopoDS::Face(result.Oriented(reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
}

}  // namespace

TopoDS_Shape with_plain_faces(const TopoDS_Shape& shape) {
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  const double near = std::max(1e-7 * std::sqrt(box.SquareExtent()), Precision::Confusion());
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  std::vector<TopoDS_Shape> plain;
  for (int i = 1; i <= faces.Extent(); ++i) plain.push_back(plain_face(TopoDS::Face(faces(i)), near));
  return with_faces(shape, faces, plain);
}

}  // namespace quadrille
