/// Builds shapes vertex by vertex, with places that their curves contradict.

#include "tests/models/swallowed_edges.hpp"

#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pln.hxx>
#include <initializer_list>

namespace quadrille {

namespace {

constexpr double tolerance = 1e-7, side = 12;
const BRep_Builder builder;

TopoDS_Vertex vertex(const gp_Pnt& at, double reach = tolerance) {
  TopoDS_Vertex result;
  builder.MakeVertex(result, at, reach);
  return result;
}

TopoDS_Edge edge(const Handle(Geom_Curve) & curve, double first, double last, const TopoDS_Vertex& from,
                 const TopoDS_Vertex& to) {
  TopoDS_Edge result;
  builder.MakeEdge(result, curve, tolerance);
  builder.Add(result, from.Oriented(TopAbs_FORWARD));
  builder.Add(result, to.Oriented(TopAbs_REVERSED));
  builder.Range(result, first, last);
  return result;
}

/// A line between two places, whatever the vertices say.
TopoDS_Edge line(const gp_Pnt& a, const gp_Pnt& b, const TopoDS_Vertex& from, const TopoDS_Vertex& to) {
  return edge(new Geom_Line(a, gp_Vec(a, b)), 0, a.Distance(b), from, to);
}

TopoDS_Face face(const gp_Pln& plane, std::initializer_list<TopoDS_Shape> edges) {
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const TopoDS_Shape& part : edges) builder.Add(wire, part);
  TopoDS_Face result;
  builder.MakeFace(result, new Geom_Plane(plane), tolerance);
  builder.Add(result, wire);
  return result;
}

}  // namespace

TopoDS_Shape square_with_far_vertex() {
  TColgp_Array1OfPnt poles(1, 5);
  poles(1) = poles(5) = gp_Pnt(0, 0, 0);
  poles(2) = gp_Pnt(side, 0, 0);
  poles(3) = gp_Pnt(side, side, 0);
  poles(4) = gp_Pnt(0, side, 0);
  TColStd_Array1OfReal knots(1, 5);
  TColStd_Array1OfInteger multiplicities(1, 5);
  multiplicities.Init(1);
  multiplicities(1) = multiplicities(5) = 2;
  for (int i = 1; i <= 5; ++i) knots(i) = i - 1;
  const TopoDS_Vertex far = vertex(poles(3), 1.5 * side);
  return face(gp_Pln(gp::XOY()),
              {edge(new Geom_BSplineCurve(poles, knots, multiplicities, 1), 0, 4, far, far)});
}

TopoDS_Shape square_with_thrown_vertex() {
  const gp_Pnt a(0, 0, 0), b(side, 0, 0), c(side, side, 0), d(0, side, 0);
  const TopoDS_Vertex at_a = vertex(a), at_b = vertex(b), at_c = vertex({2147483647, 0, 0}), at_d = vertex(d);
  return face(gp_Pln(gp::XOY()), {line(a, b, at_a, at_b), line(b, c, at_b, at_c), line(c, d, at_c, at_d),
                                  line(d, a, at_d, at_a)});
}

TopoDS_Shape square_with_collapsed_edge() {
  const gp_Pnt a(0, 0, 0), b(side, 0, 0), c(side, side, 0), d(0, side, 0);
  const TopoDS_Vertex at_a = vertex(a, 1.01), at_b = vertex(b), at_c = vertex(c), at_d = vertex(d);
  return face(gp_Pln(gp::XOY()), {line(a, {1, 0, 0}, at_a, at_a), line(a, b, at_a, at_b),
                                  line(b, c, at_b, at_c), line(c, d, at_c, at_d), line(d, a, at_d, at_a)});
}

TopoDS_Shape tetrahedron_with_collapsed_piece() {
  const gp_Pnt o(0, 0, 0), cut(1, 0, 0), x(side, 0, 0), y(0, side, 0), z(0, 0, side);
  const TopoDS_Vertex at_o = vertex({0.5, 0, 0}, 0.51), at_x = vertex(x), at_y = vertex(y), at_z = vertex(z);
  const TopoDS_Edge piece = line(o, cut, at_o, at_o), ox = line(cut, x, at_o, at_x),
                    oy = line(o, y, at_o, at_y), oz = line(o, z, at_o, at_z), xy = line(x, y, at_x, at_y),
                    yz = line(y, z, at_y, at_z), zx = line(z, x, at_z, at_x);
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face(gp_Pln(o, {0, 0, -1}), {oy, xy.Reversed(), ox.Reversed()}));
  builder.Add(shell, face(gp_Pln(o, {-1, 0, 0}), {oz, yz.Reversed(), oy.Reversed()}));
  builder.Add(shell, face(gp_Pln(o, {0, -1, 0}), {piece, ox, zx.Reversed(), oz.Reversed()}));
  builder.Add(shell, face(gp_Pln(x, {1, 1, 1}), {xy, yz, zx}));
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

}  // namespace quadrille
