/// Builds shapes with the flaws of real files: short edges, gaps, slivers, odd parametric curves.

#include "tests/models/trouble_models.hpp"

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <ShapeFix_ShapeTolerance.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_CompSolid.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_GTrsf.hxx>
#include <gp_Mat.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>

#include "tests/models/swallowed_edges.hpp"

namespace quadrille {

TopoDS_Shape compound(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  for (const TopoDS_Shape& part : parts) builder.Add(result, part);
  return result;
}

namespace {

constexpr double pi = M_PI;

TopoDS_Wire polygon(const std::vector<gp_Pnt>& points) {
  BRepBuilderAPI_MakePolygon maker;
  for (const gp_Pnt& p : points) maker.Add(p);
  maker.Close();
  return maker.Wire();
}

TopoDS_Face plane_face(const std::vector<gp_Pnt>& points) {
  return BRepBuilderAPI_MakeFace(polygon(points), Standard_True).Face();
}

TopoDS_Face rectangle(double x0, double y0, double x1, double y1) {
  return plane_face({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
}

TopoDS_Wire circle(double x, double y, double radius) {
  const gp_Circ c(gp_Ax2(gp_Pnt(x, y, 0), gp::DZ()), radius);
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(c).Edge()).Wire();
}

/// The side of a cylinder of radius 10 and height 30, seam at x = 10.
TopoDS_Face cylinder_side() {
  const TopoDS_Shape solid = BRepPrimAPI_MakeCylinder(10, 30).Shape();
  for (TopExp_Explorer it(solid, TopAbs_FACE); it.More(); it.Next()) {
    TopoDS_Face face = TopoDS::Face(it.Current());
    if (!Handle(Geom_CylindricalSurface)::DownCast(BRep_Tool::Surface(face)).IsNull()) return face;
  }
  return {};
}

TopoDS_Shape sewn(const std::vector<TopoDS_Shape>& faces, bool non_manifold = false) {
  BRepBuilderAPI_Sewing sewing(1e-6);
  sewing.SetNonManifoldMode(non_manifold);
  for (const TopoDS_Shape& face : faces) sewing.Add(face);
  sewing.Perform();
  return sewing.SewedShape();
}

/// A hole in the side of a cylinder whose edge meets the seam in one vertex.
TopoDS_Shape hole_touching_seam() {
  const BRep_Builder builder;
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp::XOY(), 10);
  TopoDS_Vertex low, touch, high;
  builder.MakeVertex(low, {10, 0, 0}, 1e-7);
  builder.MakeVertex(touch, {10, 0, 15}, 1e-7);
  builder.MakeVertex(high, {10, 0, 30}, 1e-7);
  const TopLoc_Location place;
  const auto seam = [&](const TopoDS_Vertex& a, const TopoDS_Vertex& b, double from, double to) {
    TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(new Geom_Line({10, 0, 0}, gp::DZ()), a, b, from, to).Edge();
    builder.UpdateEdge(edge, new Geom2d_Line({2 * pi, 0}, {0, 1}), new Geom2d_Line({0, 0}, {0, 1}), surface,
                       place, 1e-7);
    return edge;
  };
  const auto rim = [&](const TopoDS_Vertex& v, double z) {
    TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2({0, 0, z}, gp::DZ()), 10), v, v).Edge();
    builder.UpdateEdge(edge, new Geom2d_Line({0, z}, {1, 0}), surface, place, 1e-7);
    return edge;
  };
  const TopoDS_Edge bottom = rim(low, 0), top = rim(high, 30);
  const TopoDS_Edge first = seam(low, touch, 0, 15), second = seam(touch, high, 15, 30);
  TopoDS_Wire outer, inner;
  builder.MakeWire(outer);
  for (const TopoDS_Shape& edge : {TopoDS_Shape(bottom), TopoDS_Shape(first), TopoDS_Shape(second),
                                   top.Reversed(), second.Reversed(), first.Reversed()}) {
    builder.Add(outer, edge);
  }
  // A circle in the parameter plane, from the point on the seam.
  TopoDS_Edge hole = BRepBuilderAPI_MakeEdge(new Geom2d_Circle(gp_Ax2d({0.4, 15}, {-1, 0}), 0.4), surface,
                                             touch, touch, 0, 2 * pi)
                         .Edge();
  BRepLib::BuildCurves3d(hole);
  builder.MakeWire(inner);
  builder.Add(inner, hole.Reversed());
  TopoDS_Face face;
  builder.MakeFace(face, surface, 1e-7);
  builder.Add(face, outer);
  builder.Add(face, inner);
  return face;
}

TopoDS_Shape hole_across_seam() {
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2({5, 0, 15}, gp::DX()), 4, 20).Shape();
  return BRepAlgoAPI_Cut(cylinder_side(), drill).Shape();
}

TopoDS_Shape strip() {
  return sewn({rectangle(0, 0, 100, 50), rectangle(0, 50, 100, 50.02), rectangle(0, 50.02, 100, 100)});
}

/// A square with one side broken into 10, 2e-6 and the rest: the short edge is below its vertices' tolerance.
TopoDS_Shape short_edge() {
  const TopoDS_Face face =
      plane_face({{0, 0, 0}, {10, 0, 0}, {10 + 2e-6, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}});
  ShapeFix_ShapeTolerance().SetTolerance(face, 1e-5, TopAbs_VERTEX);
  return face;
}

/// A box whose vertices lie off the ends of their edges, within their tolerance.
TopoDS_Shape loose_box() {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(20, 30, 40).Shape();
  const BRep_Builder builder;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(box, TopAbs_VERTEX, vertices);
  for (int i = 1; i <= vertices.Extent(); ++i) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(i));
    const gp_Pnt p = BRep_Tool::Pnt(vertex);
    builder.UpdateVertex(vertex, p.Translated({0.05 * std::cos(i), 0.05 * std::sin(i), 0.03}), 0.1);
  }
  ShapeFix_ShapeTolerance().SetTolerance(box, 0.1);
  return box;
}

TopoDS_Face annulus(double outer, double inner) {
  BRepBuilderAPI_MakeFace maker(gp_Pln(gp::XOY()), circle(0, 0, outer));
  maker.Add(TopoDS::Wire(circle(0, 0, inner).Reversed()));
  return maker.Face();
}

/// A disc with a hole that comes within 0.05 of its rim, far from the vertices of both.
TopoDS_Face eccentric_hole() {
  BRepBuilderAPI_MakeFace maker(gp_Pln(gp::XOY()), circle(0, 0, 10));
  maker.Add(TopoDS::Wire(circle(1.95 * std::cos(2.0), 1.95 * std::sin(2.0), 8).Reversed()));
  return maker.Face();
}

/// The part of a disc between two arcs that share their ends.
TopoDS_Shape crescent() {
  const gp_Pnt a(-10, 0, 0), b(10, 0, 0);
  const auto arc = [&](double height) {
    const double radius = (100 + height * height) / (2 * height);
    const gp_Circ c(gp_Ax2(gp_Pnt(0, height - radius, 0), gp::DZ()), radius);
    return BRepBuilderAPI_MakeEdge(c, b, a).Edge();
  };
  BRepBuilderAPI_MakeWire wire(arc(9));
  wire.Add(TopoDS::Edge(arc(8.6).Reversed()));
  return BRepBuilderAPI_MakeFace(wire.Wire(), Standard_True).Face();
}

/// A quarter of a cylinder of radius 10 and height 30, on a cylindrical surface.
/// Half a disc with a rim round it that tapers to a tip of half a degree.
TopoDS_Shape wedge() {
  const gp_Pnt tip(10, 0, 0), inner_end(-10, 0, 0), outer_end(-10.1, 0, 0), center(-0.05, 0.1, 0);
  const TopoDS_Edge inner = BRepBuilderAPI_MakeEdge(gp_Circ(gp::XOY(), 10), tip, inner_end).Edge();
  const gp_Circ rim(gp_Ax2(center, gp::DZ()), center.Distance(tip));
  const TopoDS_Edge outer = BRepBuilderAPI_MakeEdge(rim, tip, outer_end).Edge();
  const TopoDS_Edge base = BRepBuilderAPI_MakeEdge(outer_end, inner_end).Edge(),
                    chord = BRepBuilderAPI_MakeEdge(inner_end, tip).Edge();
  const gp_Pln plane(gp::XOY());
  return sewn({BRepBuilderAPI_MakeFace(plane, BRepBuilderAPI_MakeWire(inner, chord).Wire()).Face(),
               BRepBuilderAPI_MakeFace(plane, BRepBuilderAPI_MakeWire(outer, base, inner).Wire()).Face()});
}

/// Half a disc with a rim round it, 0.0003 wide at its ends, whose inner side is two edges and the outer one.
TopoDS_Shape split_rim() {
  const double end = 0.03;
  const gp_Circ inner(gp::XOY(), 1.25), outer(gp_Ax2({0.02, 0, 0}, gp::DZ()), 1.25);
  const auto on = [&](const gp_Circ& circle, double sign) {
    const double x = end - circle.Location().X();
    return gp_Pnt(end, sign * std::sqrt(circle.Radius() * circle.Radius() - x * x), 0);
  };
  const gp_Pnt middle(1.25, 0, 0);
  const TopoDS_Edge first = BRepBuilderAPI_MakeEdge(inner, on(inner, -1), middle).Edge(),
                    second = BRepBuilderAPI_MakeEdge(inner, middle, on(inner, 1)).Edge(),
                    whole = BRepBuilderAPI_MakeEdge(outer, on(outer, -1), on(outer, 1)).Edge();
  const auto line = [](const gp_Pnt& a, const gp_Pnt& b) { return BRepBuilderAPI_MakeEdge(a, b).Edge(); };
  BRepBuilderAPI_MakeWire disc(first, second, line(on(inner, 1), on(inner, -1)));
  BRepBuilderAPI_MakeWire rim(whole, line(on(outer, 1), on(inner, 1)), second, first);
  rim.Add(line(on(inner, -1), on(outer, -1)));
  const gp_Pln plane(gp::XOY());
  return sewn({BRepBuilderAPI_MakeFace(plane, disc.Wire()).Face(),
               BRepBuilderAPI_MakeFace(plane, rim.Wire()).Face()});
}

TopoDS_Face quarter_cylinder() {
  return BRepBuilderAPI_MakeFace(new Geom_CylindricalSurface(gp::XOY(), 10), 0.3, 0.3 + pi / 2, 0.0, 30.0,
                                 1e-7)
      .Face();
}

/// Replaces the parametric curves of a face, each by what `change` makes of it.
template <class Change>
TopoDS_Shape with_parametric_curves(const TopoDS_Face& face, Change change) {
  const BRep_Builder builder;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    builder.UpdateEdge(edge, change(curve, first, last), face, 1e-3);
  }
  return face;
}

TopoDS_Shape missing_curves() {
  return with_parametric_curves(
      quarter_cylinder(), [](const Handle(Geom2d_Curve)&, double, double) { return Handle(Geom2d_Curve)(); });
}

/// Parametric curves that run the other way than their edges, and elsewhere.
TopoDS_Shape wrong_curves() {
  return with_parametric_curves(
      quarter_cylinder(), [](const Handle(Geom2d_Curve) & curve, double first, double last) {
        const gp_Pnt2d from = curve->Value(last), to = curve->Value(first);
        const gp_Vec2d along = gp_Vec2d(from, to) / (last - first);
        const gp_Pnt2d start(from.X() * 0.8, 30 - from.Y());
        return Handle(Geom2d_Curve)(new Geom2d_Line(start.Translated(-first * along), gp_Dir2d(along)));
      });
}

/// The same curves run through at another speed: the point at a parameter is far from the edge's.
TopoDS_Shape other_parameters() {
  const TopoDS_Shape shape = with_parametric_curves(
      quarter_cylinder(), [](const Handle(Geom2d_Curve) & curve, double first, double last) {
        TColgp_Array1OfPnt2d poles(1, 3);
        poles(1) = curve->Value(first);
        poles(3) = curve->Value(last);
        poles(2) = gp_Pnt2d(0.8 * poles(1).XY() + 0.2 * poles(3).XY());
        TColStd_Array1OfReal knots(1, 2);
        knots(1) = first;
        knots(2) = last;
        TColStd_Array1OfInteger multiplicities(1, 2);
        multiplicities.Init(3);
        return Handle(Geom2d_Curve)(new Geom2d_BSplineCurve(poles, knots, multiplicities, 2));
      });
  const BRep_Builder builder;
  for (TopExp_Explorer it(shape, TopAbs_EDGE); it.More(); it.Next()) {
    builder.SameParameter(TopoDS::Edge(it.Current()), Standard_False);
  }
  return shape;
}

/// Each parametric curve moved by a little of its own: consecutive ones do not meet.
TopoDS_Shape open_wire() {
  int k = 0;
  return with_parametric_curves(quarter_cylinder(), [&](const Handle(Geom2d_Curve) & curve, double, double) {
    Handle(Geom2d_Curve) moved = Handle(Geom2d_Curve)::DownCast(curve->Copy());
    ++k;
    moved->Translate(gp_Vec2d(0.004 * std::cos(k), 0.04 * std::sin(k)));
    return moved;
  });
}

/// A plate whose hole is its first wire, both wires the wrong way round.
TopoDS_Shape inner_first() {
  TopoDS_Face face;
  const BRep_Builder builder;
  builder.MakeFace(face, new Geom_Plane(gp_Pln(gp::XOY())), 1e-7);
  builder.Add(face, circle(10, 10, 4));
  builder.Add(face, polygon({{0, 0, 0}, {0, 20, 0}, {30, 20, 0}, {30, 0, 0}}));
  return face;
}

Handle(Geom_BSplineSurface)
    spline_surface(int n, int degree, const std::function<gp_Pnt(double, double)>& at, bool creased = false) {
  TColgp_Array2OfPnt poles(1, n, 1, n);
  for (int i = 1; i <= n; ++i) {
    for (int j = 1; j <= n; ++j) poles(i, j) = at((i - 1.0) / (n - 1), (j - 1.0) / (n - 1));
  }
  const int inner = creased ? (n - 1) / degree - 1 : n - degree - 1;
  TColStd_Array1OfReal knots(1, inner + 2);
  TColStd_Array1OfInteger multiplicities(1, inner + 2);
  for (int i = 1; i <= inner + 2; ++i) {
    knots(i) = i - 1;
    multiplicities(i) = i == 1 || i == inner + 2 ? degree + 1 : creased ? degree : 1;
  }
  return new Geom_BSplineSurface(poles, knots, knots, multiplicities, multiplicities, degree, degree);
}

TopoDS_Face natural_face(const Handle(Geom_Surface) & surface) {
  return BRepBuilderAPI_MakeFace(surface, 1e-6).Face();
}

/// Parameter speeds from 1 to 1000.
TopoDS_Shape uneven_patch() {
  return natural_face(spline_surface(6, 3, [](double s, double t) {
    const double x = std::pow(s, 6), y = 1 - std::pow(1 - t, 6);
    return gp_Pnt(40 * x, 30 * y, 5 * x * y);
  }));
}

/// One side of the parameter plane is a point; the file may or may not have an edge there.
TopoDS_Shape collapsed_patch() {
  return natural_face(spline_surface(4, 3, [](double s, double t) {
    const double angle = s * pi / 2, r = 20 * t;
    return gp_Pnt(r * std::cos(angle), r * std::sin(angle), 4 * t * t);
  }));
}

TopoDS_Shape creased_patch() {
  return natural_face(spline_surface(
      7, 3, [](double s, double t) { return gp_Pnt(30 * s, 30 * t, 8 * (1 - std::abs(2 * s - 1))); }, true));
}

/// A sphere stretched into a B-spline with two poles.
TopoDS_Shape ellipsoid() {
  gp_GTrsf stretch;
  stretch.SetVectorialPart(gp_Mat(1, 0, 0, 0, 2, 0, 0, 0, 0.5));
  return BRepBuilderAPI_GTransform(BRepPrimAPI_MakeSphere(10).Shape(), stretch).Shape();
}

TopoDS_Shape offset_patch() {
  const auto base = spline_surface(
      4, 3, [](double s, double t) { return gp_Pnt(30 * s, 30 * t, 6 * std::sin(2 * s) * std::cos(3 * t)); });
  return natural_face(new Geom_OffsetSurface(base, 2));
}

/// `n` rectangles like the pages of a book.
TopoDS_Shape book(int n) {
  std::vector<TopoDS_Shape> pages;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n, x = 20 * std::cos(angle), y = 20 * std::sin(angle);
    pages.push_back(plane_face({{0, 0, 0}, {x, y, 0}, {x, y, 30}, {0, 0, 30}}));
  }
  BRepAlgoAPI_BuilderAlgo fuse;
  TopTools_ListOfShape arguments;
  for (const TopoDS_Shape& page : pages) arguments.Append(page);
  fuse.SetArguments(arguments);
  fuse.Build();
  return fuse.Shape();
}

TopoDS_Shape with_inner_edge(const gp_Pnt& a, const gp_Pnt& b) {
  TopoDS_Face face = rectangle(0, 0, 40, 30);
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(a, b).Edge();
  TopoDS_Wire wire;
  const BRep_Builder builder;
  builder.MakeWire(wire);
  builder.Add(wire, edge.Oriented(TopAbs_INTERNAL));
  builder.Add(face, wire);
  return face;
}

/// A square whose wire runs along a slit, there and back.
TopoDS_Shape slit() {
  const BRep_Builder builder;
  const gp_Pnt corners[] = {{0, 0, 0}, {20, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}, {20, 15, 0}};
  std::vector<TopoDS_Vertex> v(6);
  for (int i = 0; i < 6; ++i) builder.MakeVertex(v[i], corners[i], 1e-7);
  const auto edge = [&](int a, int b) { return BRepBuilderAPI_MakeEdge(v[a], v[b]).Edge(); };
  const TopoDS_Edge cut = edge(1, 5);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (const TopoDS_Shape& e :
       {TopoDS_Shape(edge(0, 1)), TopoDS_Shape(cut), cut.Reversed(), TopoDS_Shape(edge(1, 2)),
        TopoDS_Shape(edge(2, 3)), TopoDS_Shape(edge(3, 4)), TopoDS_Shape(edge(4, 0))}) {
    builder.Add(wire, e);
  }
  TopoDS_Face face;
  builder.MakeFace(face, new Geom_Plane(gp_Pln(gp::XOY())), 1e-7);
  builder.Add(face, wire);
  return face;
}

TopoDS_Shape with_inner_vertex() {
  TopoDS_Face face = rectangle(0, 0, 40, 30);
  const BRep_Builder builder;
  TopoDS_Vertex vertex;
  builder.MakeVertex(vertex, {13, 11, 0}, 1e-7);
  builder.Add(face, vertex.Oriented(TopAbs_INTERNAL));
  return face;
}

TopoDS_Shape hollow_box() {
  const TopoDS_Shape inside = BRepPrimAPI_MakeBox(gp_Pnt(5, 5, 5), 10, 10, 10).Shape();
  const TopoDS_Shape hollow = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(20, 20, 20).Shape(), inside).Shape();
  return compound({hollow, BRepPrimAPI_MakeBox(gp_Pnt(30, 0, 0), 10, 10, 10).Shape()});
}

TopoDS_Shape shared_solids() {
  BRepAlgoAPI_BuilderAlgo fuse;
  TopTools_ListOfShape arguments;
  for (int i = 0; i < 3; ++i) arguments.Append(BRepPrimAPI_MakeBox(gp_Pnt(10 * i, 0, 0), 10, 20, 20).Shape());
  fuse.SetArguments(arguments);
  fuse.Build();
  TopoDS_CompSolid result;
  const BRep_Builder builder;
  builder.MakeCompSolid(result);
  for (TopExp_Explorer it(fuse.Shape(), TopAbs_SOLID); it.More(); it.Next())
    builder.Add(result, it.Current());
  return result;
}

TopoDS_Shape assembly() {
  const TopoDS_Shape part = BRepPrimAPI_MakeCylinder(5, 12).Shape();
  gp_Trsf placed, turned, scaled;
  placed.SetTranslation({20, 0, 0});
  turned.SetRotation(gp_Ax1({0, 30, 0}, gp_Dir(1, 1, 0)), 0.7);
  scaled.SetScale({-20, 0, 0}, 1.5);
  return compound({part, part.Moved(TopLoc_Location(placed)), part.Moved(TopLoc_Location(turned)),
                   BRepBuilderAPI_Transform(part, scaled, Standard_True).Shape()});
}

/// A part and its mirror image by a placement alone, as some files have it.
TopoDS_Shape mirrored() {
  const TopoDS_Shape part = BRepPrimAPI_MakeCone(6, 3, 10).Shape();
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2({10, 0, 0}, gp::DX()));
  TopoDS_Shape image = part;
  image.Location(TopLoc_Location(mirror), Standard_False);
  return compound({part, image});
}

TopoDS_Shape transformed(double scale, const gp_Vec& shift) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(20, 20, 20).Shape();
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2({10, 10, -5}, gp::DZ()), 5, 30).Shape();
  gp_Trsf trsf, move;
  trsf.SetScale(gp::Origin(), scale);
  move.SetTranslation(shift);
  return BRepBuilderAPI_Transform(BRepAlgoAPI_Cut(box, drill).Shape(), move * trsf, Standard_True).Shape();
}
constexpr double drilled_area = 6 * 400 - 2 * pi * 25 + 2 * pi * 5 * 20;

/// A face that is a whole surface, without any wire.
TopoDS_Shape bare_face(const Handle(Geom_Surface) & surface) {
  TopoDS_Face face;
  const BRep_Builder builder;
  builder.MakeFace(face, surface, 1e-7);
  builder.NaturalRestriction(face, Standard_True);
  return face;
}

/// A wire that runs along an edge there and back; the edge is a straight line in the parameters of the face's
/// surface.
TopoDS_Wire there_and_back(const TopoDS_Face& face, const Handle(Geom2d_Line) & line, double length) {
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(line, BRep_Tool::Surface(face), 0, length);
  BRepLib::BuildCurves3d(edge);
  TopoDS_Wire wire;
  const BRep_Builder builder;
  builder.MakeWire(wire);
  builder.Add(wire, edge);
  builder.Add(wire, edge.Reversed());
  return wire;
}

/// A closed surface bounded by one of its parameter curves, there and back.
TopoDS_Shape bounded_by_nothing(const Handle(Geom_Surface) & surface, const Handle(Geom2d_Line) & line) {
  TopoDS_Face face;
  const BRep_Builder builder;
  builder.MakeFace(face, surface, 1e-7);
  builder.Add(face, there_and_back(face, line, 2 * pi));
  return face;
}

/// A whole sphere and, as another wire, its equator there and back.
TopoDS_Shape sphere_with_equator() {
  TopoDS_Face face = TopoDS::Face(TopExp_Explorer(BRepPrimAPI_MakeSphere(10).Shape(), TopAbs_FACE).Current());
  face.Free(Standard_True);
  BRep_Builder().Add(face, there_and_back(face, new Geom2d_Line({1, 0}, {1, 0}), 2 * pi));
  return face;
}

/// The side of a cylinder with a hole whose parametric curve lies a period away.
TopoDS_Shape hole_a_period_away() {
  TopoDS_Face face = cylinder_side();
  face.Free(Standard_True);
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  TopoDS_Edge hole =
      BRepBuilderAPI_MakeEdge(new Geom2d_Circle(gp_Ax2d({3 + 2 * pi, 15}, {1, 0}), 1.5), surface, 0, 2 * pi)
          .Edge();
  BRepLib::BuildCurves3d(hole);
  TopoDS_Wire wire;
  const BRep_Builder builder;
  builder.MakeWire(wire);
  builder.Add(wire, hole.Reversed());
  builder.Add(face, wire);
  return face;
}

/// The side of a cylinder whose upper rim has its parametric curve a period away from the rest of the wire.
TopoDS_Shape turned_rim() {
  TopoDS_Face face = cylinder_side();
  const BRep_Builder builder;
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (BRep_Tool::IsClosed(edge, face) || curve->Value(first).Y() < 15) continue;
    builder.UpdateEdge(edge, Handle(Geom2d_Curve)::DownCast(curve->Translated({-2 * pi, 0})), face, 1e-7);
  }
  return face;
}

/// A closed edge along a curve in the parameter plane.
TopoDS_Edge closed_edge(const Handle(Geom2d_Curve) & curve, const Handle(Geom_Surface) & surface) {
  const gp_Pnt2d start = curve->Value(0);
  const TopoDS_Vertex vertex = BRepBuilderAPI_MakeVertex(surface->Value(start.X(), start.Y())).Vertex();
  TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(curve, surface, vertex, vertex, 0, 2 * pi).Edge();
  BRepLib::BuildCurves3d(edge);
  return edge;
}

/// A face of wires of one edge each.
TopoDS_Face face_within(const Handle(Geom_Surface) & surface, const std::vector<TopoDS_Shape>& edges) {
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, surface, 1e-7);
  for (const TopoDS_Shape& edge : edges) {
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    builder.Add(wire, edge);
    builder.Add(face, wire);
  }
  return face;
}

/// A cylinder whose side has no seam, as systems without seams write it; its rims start at different angles.
TopoDS_Shape cylinder_without_seam() {
  const Handle(Geom_Surface) side = new Geom_CylindricalSurface(gp::XOY(), 10);
  const TopoDS_Edge low = closed_edge(new Geom2d_Line({0, 0}, {1, 0}), side),
                    high = closed_edge(new Geom2d_Line({1, 30}, {1, 0}), side);
  const TopoDS_Face bottom =
      BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), BRepBuilderAPI_MakeWire(low).Wire()).Face();
  const TopoDS_Face top =
      BRepBuilderAPI_MakeFace(gp_Pln({0, 0, 30}, gp::DZ()), BRepBuilderAPI_MakeWire(high).Wire()).Face();
  return compound({face_within(side, {low, high.Reversed()}), bottom.Reversed(), top});
}

/// A sphere with a hole and no other wire.
TopoDS_Shape holed_sphere() {
  const Handle(Geom_Surface) sphere = new Geom_SphericalSurface(gp::XOY(), 10);
  return face_within(sphere,
                     {closed_edge(new Geom2d_Circle(gp_Ax2d({2, 0.2}, {1, 0}), 0.5), sphere).Reversed()});
}

/// The side of a cone up to its apex, bounded by a circle alone.
TopoDS_Shape cone_without_apex() {
  const Handle(Geom_Surface) cone = new Geom_ConicalSurface(gp_Ax3({0, 0, 20}, -gp::DZ()), pi / 6, 0);
  return face_within(cone, {closed_edge(new Geom2d_Line({0, 10}, {1, 0}), cone)});
}

/// The part of a cylinder between z = 0 and z = 20 whose wire is closed by edges that are said to be
/// degenerate, as translators do where its parametric curves lie two periods apart.
TopoDS_Shape false_poles() {
  const BRep_Builder builder;
  const Handle(Geom_CylindricalSurface) surface = new Geom_CylindricalSurface(gp::XOY(), 10);
  const TopLoc_Location place;
  TopoDS_Vertex low, high;
  builder.MakeVertex(low, {10, 0, 0}, 1e-7);
  builder.MakeVertex(high, {10, 0, 20}, 1e-7);
  const auto rim = [&](const TopoDS_Vertex& v, double z, double from) {
    TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2({0, 0, z}, gp::DZ()), 10), v, v).Edge();
    builder.UpdateEdge(edge, new Geom2d_Line({from, z}, {1, 0}), surface, place, 1e-7);
    return edge;
  };
  const auto pole = [&](const TopoDS_Vertex& v, double z, double from) {
    TopoDS_Edge edge;
    builder.MakeEdge(edge);
    builder.UpdateEdge(edge, new Geom2d_Line({from, z}, {1, 0}), surface, place, 1e-7);
    builder.Range(edge, 0, 2 * pi);
    builder.Degenerated(edge, Standard_True);
    builder.Add(edge, v.Oriented(TopAbs_FORWARD));
    builder.Add(edge, v.Oriented(TopAbs_REVERSED));
    return edge;
  };
  TopoDS_Edge seam = BRepBuilderAPI_MakeEdge(new Geom_Line({10, 0, 0}, gp::DZ()), low, high, 0, 20).Edge();
  builder.UpdateEdge(seam, new Geom2d_Line({2 * pi, 0}, {0, 1}), new Geom2d_Line({-2 * pi, 0}, {0, 1}),
                     surface, place, 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  const TopoDS_Edge bottom = rim(low, 0, 0), top = rim(high, 20, -2 * pi);
  for (const TopoDS_Shape& edge :
       {TopoDS_Shape(pole(low, 0, -2 * pi)), TopoDS_Shape(bottom), TopoDS_Shape(seam),
        pole(high, 20, 0).Reversed(), top.Reversed(), seam.Reversed()}) {
    builder.Add(wire, edge);
  }
  TopoDS_Face face;
  builder.MakeFace(face, surface, 1e-7);
  builder.Add(face, wire);
  return face;
}

/// A sheet rolled up, its layers 0.2 apart, with a hole through them all.
TopoDS_Shape rolled_sheet() {
  constexpr int count = 105;
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 0.3 * i, radius = 8 + 0.2 * angle / (2 * pi);
    points->SetValue(i + 1, {radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  GeomAPI_Interpolate spiral(points, Standard_False, 1e-7);
  spiral.Perform();
  const TopoDS_Shape sheet =
      BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeEdge(spiral.Curve()).Edge(), gp_Vec(0, 0, 20)).Shape();
  const gp_Ax2 drill({0, 0, 10}, gp_Dir(1, 0.2, 0));
  return BRepAlgoAPI_Cut(sheet, BRepPrimAPI_MakeCylinder(drill, 3, 40).Shape()).Shape();
}

/// A plate with a hole of its shape that leaves a frame far narrower than the size.
TopoDS_Shape narrow_frame() {
  BRepBuilderAPI_MakeFace maker(gp_Pln(gp::XOY()), polygon({{0, 0, 0}, {40, 0, 0}, {40, 20, 0}, {0, 20, 0}}));
  maker.Add(TopoDS::Wire(
      polygon({{0.05, 0.05, 0}, {39.95, 0.05, 0}, {39.95, 19.95, 0}, {0.05, 19.95, 0}}).Reversed()));
  return maker.Face();
}

/// A flat band of width 0.05 along most of a circle of radius 20.
TopoDS_Shape narrow_band() {
  const auto at = [](double radius, double angle) {
    return gp_Pnt(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  const double start = 0.3, end = 2 * pi - 0.3;
  const gp_Circ outer(gp::XOY(), 20), inner(gp::XOY(), 19.95);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(outer, start, end).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(at(20, end), at(19.95, end)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(inner, start, end).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(at(19.95, start), at(20, start)).Edge());
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Face();
}

/// A block beside a pin that has only as many elements round it as a pin must have.
TopoDS_Shape thin_pin() {
  return compound({BRepPrimAPI_MakeBox(40, 30, 20).Shape(),
                   BRepPrimAPI_MakeCylinder(gp_Ax2({-5, 15, 0}, gp::DZ()), 0.15, 8).Shape()});
}

/// A plate whose hole touches the outer wire along an edge shorter than the tolerance.
TopoDS_Shape hole_at_short_edge() {
  const double gap = 2e-6;
  const BRep_Builder builder;
  BRepBuilderAPI_MakeFace maker(
      gp_Pln(gp::XOY()),
      polygon({{-20, 0, 0}, {0, 0, 0}, {gap, 0, 0}, {20, 0, 0}, {20, 40, 0}, {-20, 40, 0}}));
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(maker.Face(), TopAbs_VERTEX, vertices);
  TopoDS_Vertex a, b;
  for (int i = 1; i <= vertices.Extent(); ++i) {
    const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(i));
    const gp_Pnt p = BRep_Tool::Pnt(vertex);
    if (p.Y() == 0 && std::abs(p.X()) < 1e-5) (p.X() > gap / 2 ? b : a) = vertex;
  }
  // Round from b, and back over the gap from a to b by an edge of its own.
  const gp_Circ hole(gp_Ax2({gap / 2, 10, 0}, gp::DZ(), {0, -1, 0}), 10);
  const double turn = std::asin(gap / 20);
  const TopoDS_Edge round = BRepBuilderAPI_MakeEdge(new Geom_Circle(hole), b, a, turn, 2 * pi - turn).Edge();
  const TopoDS_Edge back = BRepBuilderAPI_MakeEdge(new Geom_Line({0, 0, 0}, gp::DX()), a, b, 0, gap).Edge();
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, round);
  builder.Add(wire, back);
  maker.Add(TopoDS::Wire(wire.Reversed()));
  ShapeFix_ShapeTolerance().SetTolerance(maker.Face(), 1e-5, TopAbs_VERTEX);
  return maker.Face();
}

/// A square, one of whose sides is broken into pieces, the middle one a curve with a loop in it.
TopoDS_Shape looped_edge() {
  TColgp_Array1OfPnt poles(1, 6);
  poles(1) = {10, 0, 0};
  poles(2) = {10.35, 0, 0};
  poles(3) = {10.3, 0.25, 0};
  poles(4) = {9.8, 0.2, 0};
  poles(5) = {9.85, -0.05, 0};
  poles(6) = {10.2, 0, 0};
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = 0;
  knots(2) = 1;
  TColStd_Array1OfInteger multiplicities(1, 2);
  multiplicities.Init(6);
  const Handle(Geom_BSplineCurve) loop = new Geom_BSplineCurve(poles, knots, multiplicities, 5);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0)).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(loop).Edge());
  const std::vector<gp_Pnt> corners{{10.2, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    wire.Add(BRepBuilderAPI_MakeEdge(corners[i], corners[i + 1]).Edge());
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Face();
}

TopoDS_Shape touching_hole() {
  BRepBuilderAPI_MakeFace maker(gp_Pln(gp::XOY()), circle(0, 0, 20));
  // Tangent from inside: a cusp of no angle on either side.
  const BRep_Builder builder;
  const TopoDS_Vertex vertex =
      TopExp::FirstVertex(TopoDS::Edge(TopExp_Explorer(maker.Face(), TopAbs_EDGE).Current()));
  const TopoDS_Edge hole =
      BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2({12, 0, 0}, gp::DZ()), 8), vertex, vertex).Edge();
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  builder.Add(wire, hole.Reversed());
  maker.Add(wire);
  return maker.Face();
}

std::vector<TroubleModel> all_models() {
  const double touching_hole_in_cylinder = 10 * pi * 0.4 * 0.4;
  return {
      {"seam_and_poles", "a sphere", [] { return BRepPrimAPI_MakeSphere(10).Shape(); }, true, 400 * pi},
      {"hole_across_seam", "a hole that cuts the seam", hole_across_seam, false, 600 * pi - 51.32},
      {"hole_touching_seam", "a hole with a vertex on the seam", hole_touching_seam, false,
       600 * pi - touching_hole_in_cylinder},
      {"hole_touching_rim", "a hole tangent to the outer wire", touching_hole, false, pi * (400 - 64)},
      {"apex", "a cone's apex", [] { return BRepPrimAPI_MakeCone(10, 0, 20).Shape(); }, true,
       100 * pi + 10 * pi * std::hypot(10, 20)},
      {"full_torus", "a face with no edges but seams", [] { return BRepPrimAPI_MakeTorus(20, 6).Shape(); },
       true, 4 * pi * pi * 120},
      {"spindle_torus", "a torus that meets its axis in two poles",
       [] {
         const double v = std::acos(-0.6);
         return BRepBuilderAPI_MakeFace(new Geom_ToroidalSurface(gp::XOY(), 6, 10), 0, 2 * pi, -v, v, 1e-7)
             .Face();
       },
       false, 2 * pi * 10 * (6 * 2 * std::acos(-0.6) + 10 * 2 * 0.8)},
      {"lemon", "the part of a torus beyond its axis",
       [] {
         const double v = std::acos(-0.6);
         return BRepBuilderAPI_MakeFace(new Geom_ToroidalSurface(gp::XOY(), 6, 10), 0, 2 * pi, v, 2 * pi - v,
                                        1e-7)
             .Face();
       },
       false, 2 * pi * 10 * (10 * 2 * 0.8 - 6 * (2 * pi - 2 * std::acos(-0.6)))},
      {"horn_torus", "a torus whose radii are equal",
       [] {
         return BRepBuilderAPI_MakeFace(new Geom_ToroidalSurface(gp::XOY(), 10, 10), 0, 2 * pi, -2.5, 2.5,
                                        1e-7)
             .Face();
       },
       false, 2 * pi * 10 * (10 * 5 + 10 * 2 * std::sin(2.5))},
      {"horn_slice", "a face that ends in a tip, where a torus touches its axis",
       [] {
         return BRepBuilderAPI_MakeFace(new Geom_ToroidalSurface(gp::XOY(), 10, 10), 0, 0.2, -pi, 2.5, 1e-7)
             .Face();
       },
       false, 20 * (pi + 2.5 + std::sin(2.5))},
      {"disc", "one closed edge", [] { return BRepBuilderAPI_MakeFace(circle(0, 0, 10)).Face(); }, false,
       100 * pi},
      {"sliver", "a face of width size / 100", strip, false, 10000},
      {"short_edge", "an edge shorter than its tolerance", short_edge, false, 400},
      {"loose_tolerance", "vertices off their edges, tolerance 0.1", loose_box, true, 2 * (600 + 800 + 1200)},
      {"far_vertex", "a closed curve whose vertex is not on it", square_with_far_vertex, false, 144},
      {"thrown_vertex", "a vertex that a damaged number has thrown away", square_with_thrown_vertex, false,
       144},
      {"collapsed_edge", "a dangling edge that its vertex holds", square_with_collapsed_edge, false, 144, 4},
      {"collapsed_piece", "an edge that its vertex holds, and a wire without it",
       tetrahedron_with_collapsed_piece, true, 216 + 72 * std::sqrt(3.0)},
      {"thin_annulus", "wires that cross when sampled coarsely", [] { return annulus(10, 9.9); }, false,
       pi * (100 - 9.9 * 9.9)},
      {"eccentric_hole", "a hole that comes within size / 10 of the rim", eccentric_hole, false, 36 * pi},
      {"crescent", "two arcs that share their ends", crescent, false, 0},
      {"wedge", "a rim that tapers to a tip of half a degree", wedge, false,
       101.0125 * std::acos(-0.1 / std::sqrt(101.0125)) + 0.1 * 10.05},
      {"split_rim", "a rim far narrower than an element, one side of it in two edges", split_rim, false, 0},
      {"missing_curves", "no parametric curves", missing_curves, false, 150 * pi},
      {"wrong_curves", "parametric curves far from their edges", wrong_curves, false, 150 * pi},
      {"other_parameters", "parametric curves at other speeds", other_parameters, false, 150 * pi},
      {"open_wire", "a wire open in the parameter plane", open_wire, false, 150 * pi},
      {"inner_first", "inner wire first, wires reversed", inner_first, false, 600 - 16 * pi},
      {"creased_patch", "a C0 B-spline", creased_patch, false, 0},
      {"collapsed_patch", "a B-spline with poles in one point", collapsed_patch, false, 0},
      {"uneven_patch", "parameter speeds of 1:1000", uneven_patch, false, 0},
      {"ellipsoid", "a B-spline with two poles", ellipsoid, true, 0, 2},
      {"offset_patch", "an offset surface", offset_patch, false, 0},
      {"rational_sphere", "a rational sphere",
       [] { return BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeSphere(10).Shape()).Shape(); }, true,
       400 * pi},
      {"rational_torus", "a rational torus",
       [] { return BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeTorus(20, 6).Shape()).Shape(); }, true,
       480 * pi * pi},
      {"book_of_3", "an edge of three faces", [] { return book(3); }, false, 1800},
      {"book_of_6", "an edge of six faces", [] { return book(6); }, false, 3600},
      {"crack", "an edge inside a face",
       [] {
         return with_inner_edge({10, 10, 0}, {30, 17, 0});
       },
       false, 1200},
      {"short_crack", "an edge inside a face, shorter than the size",
       [] {
         return with_inner_edge({19, 15, 0}, {20, 15.2, 0});
       },
       false, 1200},
      {"slit", "a wire that runs along an edge there and back", slit, false, 1200},
      {"inner_vertex", "a vertex inside a face", with_inner_vertex, false, 1200},
      {"several_shells", "a hollow solid beside another", hollow_box, true, 2400 + 600 + 600},
      {"compsolid", "solids that share faces", shared_solids, true, 2 * 600 * 2 + 4 * 400},
      {"assembly", "placed, turned and scaled instances", assembly, true, (3 + 2.25) * (50 * pi + 120 * pi)},
      {"mirrored", "a mirror image by its placement", mirrored, true,
       2 * pi * (36 + 9 + 9 * std::hypot(3, 10))},
      {"micrometres", "a part of 0.02 mm", [] { return transformed(1e-3, {}); }, true, 1e-6 * drilled_area},
      {"kilometres", "a part of 20 km", [] { return transformed(1e6, {}); }, true, 1e12 * drilled_area},
      {"far_away", "a part 10 km from the origin",
       [] {
         return transformed(1, {1e7, -1e7, 1e7});
       },
       true, drilled_area},
      {"bare_sphere", "a face without any wire",
       [] { return bare_face(new Geom_SphericalSurface(gp::XOY(), 10)); }, true, 400 * pi, 2},
      {"bare_torus", "a torus without any wire",
       [] { return bare_face(new Geom_ToroidalSurface(gp::XOY(), 20, 6)); }, true, 480 * pi * pi, 1},
      {"sphere_of_a_circle", "a sphere bounded by its equator, there and back",
       [] {
         return bounded_by_nothing(new Geom_SphericalSurface(gp::XOY(), 10), new Geom2d_Line({0, 0}, {1, 0}));
       },
       true, 400 * pi, 2},
      {"torus_of_a_circle", "a torus bounded by a circle round its tube, there and back",
       [] {
         return bounded_by_nothing(new Geom_ToroidalSurface(gp::XOY(), 20, 6),
                                   new Geom2d_Line({0, 0}, {0, 1}));
       },
       true, 480 * pi * pi, 1},
      {"sphere_and_circle", "a sphere with its equator, there and back, as another wire", sphere_with_equator,
       true, 400 * pi, 2},
      {"hole_a_period_away", "a hole whose parametric curve lies a period away", hole_a_period_away, false,
       600 * pi - 10 * pi * 2.25},
      {"turned_rim", "an edge whose parametric curve lies a period away", turned_rim, false, 600 * pi},
      {"no_seam", "a side of a cylinder without a seam", cylinder_without_seam, true, 800 * pi, 3},
      {"no_bounds", "a sphere with a hole for its only wire", holed_sphere, false,
       400 * pi - 100 * std::cos(0.2) * pi * std::cyl_bessel_j(1, 0.5), 3},
      {"no_apex", "a cone bounded by a circle alone", cone_without_apex, false, 50 * pi, 2},
      {"false_poles", "edges said to be degenerate that are not", false_poles, false, 400 * pi},
      {"narrow_frame", "a frame of width size / 20", narrow_frame, false, 800 - 39.9 * 19.9},
      {"narrow_band", "a band along a circle, of width size / 30", narrow_band, false,
       (pi - 0.3) * (400 - 19.95 * 19.95)},
      {"rolled_sheet", "a face whose layers lie closer than its elements are long", rolled_sheet, false, 0},
      {"thin_pin", "a cylinder thinner than the elements", thin_pin, true,
       2 * (1200 + 800 + 600) + 2 * pi * 0.15 * (8 + 0.15)},
      {"hole_at_short_edge", "wires that touch along an edge shorter than its tolerance", hole_at_short_edge,
       false, 1600 - 100 * pi, 6},
      {"touching_faces", "faces 0.005 apart that share no edge",
       [] {
         return compound({rectangle(0, 0, 10, 20), rectangle(10.005, 0, 20, 20)});
       },
       false, 399.9},
      {"looped_edge", "a short edge with a loop in it", looped_edge, false, 400, 6},
  };
}

}  // namespace

TopoDS_Shape rod_in_sleeve(double length) {
  const gp_Ax2 low(gp_Pnt(0, 0, 0), gp::DZ()), foot(gp_Pnt(0, 0, 5 - length / 2), gp::DZ());
  const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(low, 3, 10).Shape();
  return compound({BRepPrimAPI_MakeCylinder(foot, 3, length).Shape(),
                   BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(low, 6, 10).Shape(), hole).Shape()});
}

TopoDS_Shape tiny_cusp() {
  const double length = 0.01, height = 4e-5;
  const gp_Pnt start(0, 0, 0), top(0, height, 0), end(length, 0, 0), below(0.5 * length, -height, 0);
  const auto line = [](const gp_Pnt& a, const gp_Pnt& b) { return BRepBuilderAPI_MakeEdge(a, b).Edge(); };
  const TopoDS_Edge curve = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(top, below, end).Value()).Edge(),
                    side = line(start, top);
  BRepBuilderAPI_MakeWire square(line({-10, 0, 0}, start));
  square.Add(side);
  square.Add(curve);
  const std::vector<gp_Pnt> corners{end, {10, 0, 0}, {10, 20, 0}, {-10, 20, 0}, {-10, 0, 0}};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) square.Add(line(corners[i], corners[i + 1]));
  BRepBuilderAPI_MakeWire sliver(line(start, end));
  sliver.Add(TopoDS::Edge(curve.Reversed()));
  sliver.Add(TopoDS::Edge(side.Reversed()));
  const gp_Pln plane(gp::XOY());
  return sewn({BRepBuilderAPI_MakeFace(plane, square.Wire()).Face(),
               BRepBuilderAPI_MakeFace(plane, sliver.Wire()).Face()});
}

const std::vector<TroubleModel>& trouble_models() {
  static const std::vector<TroubleModel> models = all_models();
  return models;
}

}  // namespace quadrille
