/// Tests surfaces with GeomLib_IsPlanarSurface and puts the faces on the plane that is found.

#include "geometry/midsurface/plain_faces.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>
#include <vector>

#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

/// Whether the plane's normal points to the same side as the surface's at the middle of its parameters.
bool same_side(const BRepAdaptor_Surface& surface, const gp_Pln& plane) {
  const double u = 0.5 * (surface.FirstUParameter() + surface.LastUParameter());
  const double v = 0.5 * (surface.FirstVParameter() + surface.LastVParameter());
  gp_Pnt at;
  gp_Vec du, dv;
  surface.D1(u, v, at, du, dv);
  return du.Crossed(dv).Dot(gp_Vec(plane.Axis().Direction())) > 0;
}

/// The face on a plane if its surface is flat; otherwise the face itself.
TopoDS_Face plain_face(const TopoDS_Face& face, double near) {
  const BRepAdaptor_Surface surface(face);
  if (surface.GetType() == GeomAbs_Plane) return face;
  const GeomLib_IsPlanarSurface flat(BRep_Tool::Surface(face), near);
  if (!flat.IsPlanar()) return face;
  const BRep_Builder builder;
  TopoDS_Face result;
  gp_Pln plane = flat.Plan();
  if (!same_side(surface, plane)) plane.SetAxis(plane.Axis().Reversed());
  builder.MakeFace(result, new Geom_Plane(plane), BRep_Tool::Tolerance(face));
  for (TopoDS_Iterator wire(face.Oriented(TopAbs_FORWARD)); wire.More(); wire.Next())
    builder.Add(result, wire.Value());
  return BRepCheck_Analyzer(result).IsValid() ? TopoDS::Face(result.Oriented(face.Orientation())) : face;
}

}  // namespace

TopoDS_Shape with_plain_faces(const TopoDS_Shape& shape) {
  const double near = std::max(1e-7 * std::sqrt(box_of(shape).SquareExtent()), Precision::Confusion());
  std::vector<TopoDS_Shape> plain = list_of(shape, TopAbs_FACE);
  for (TopoDS_Shape& face : plain) face = plain_face(TopoDS::Face(face), near);
  return with_faces(shape, map_of(shape, TopAbs_FACE), plain);
}

}  // namespace quadrille
