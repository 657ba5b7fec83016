#pragma once
/// Lengths, areas and widths of edges and faces. Internal.

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

namespace quadrille {

/// Of an edge.
double length_of(const TopoDS_Edge& edge);

double area_of(const TopoDS_Face& face);

/// The shorter side of the rectangle of that area and perimeter.
double width_of(double area, double perimeter);

/// The same of a face with all its borders: of a ring, how wide it is.
double width_of(const TopoDS_Face& face);

}  // namespace quadrille
