#pragma once
/// Lengths, areas and widths of edges and faces, and points of edges. Internal.

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>

namespace quadrille {

double length_of(const TopoDS_Edge& edge);

/// The point of an edge at a share of its parameters.
gp_Pnt point_at(const TopoDS_Edge& edge, double share);

double area_of(const TopoDS_Face& face);

/// The shorter side of the rectangle with that area and perimeter.
double width_of(double area, double perimeter);

/// The same for a face; the perimeter includes its holes, so that the width of a ring is that of its band.
double width_of(const TopoDS_Face& face);

}  // namespace quadrille
