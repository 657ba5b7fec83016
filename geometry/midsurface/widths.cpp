/// Integrates with BRepGProp; a face's width is that of the rectangle with its area and perimeter.

#include "geometry/midsurface/widths.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <cmath>

#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

double length_of(const TopoDS_Edge& edge) {
  GProp_GProps properties;
  BRepGProp::LinearProperties(edge, properties);
  return properties.Mass();
}

gp_Pnt point_at(const TopoDS_Edge& edge, double share) {
  const BRepAdaptor_Curve curve(edge);
  return curve.Value((1 - share) * curve.FirstParameter() + share * curve.LastParameter());
}

double area_of(const TopoDS_Face& face) {
  GProp_GProps properties;
  // B-splines are integrated span by span, planes exactly. Adaptive integration is slow and no better there.
  const GeomAbs_SurfaceType type = BRepAdaptor_Surface(face, Standard_False).GetType();
  if (type == GeomAbs_Plane || type >= GeomAbs_BezierSurface)
    BRepGProp::SurfaceProperties(face, properties);
  else
    BRepGProp::SurfaceProperties(face, properties, 1e-6);
  return std::abs(properties.Mass());
}

double width_of(double area, double perimeter) {
  const double half = 0.25 * perimeter;
  return half * half > area ? half - std::sqrt(half * half - area) : std::sqrt(area);
}

double width_of(const TopoDS_Face& face) {
  double perimeter = 0;
  for (const TopoDS_Edge& edge : edges_of(face))
    if (!BRep_Tool::IsClosed(edge, face)) perimeter += length_of(edge);
  return width_of(area_of(face), perimeter);
}

}  // namespace quadrille
