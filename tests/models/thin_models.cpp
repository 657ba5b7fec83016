/// Builds thin parts as OpenCASCADE solids: sheets, tubes, ribs, pockets, housings.

#include "tests/models/thin_models.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <gp_Vec.hxx>

#include "tests/models/trouble_models.hpp"

namespace quadrille {

namespace {

using Outline = std::vector<Corner2d>;

gp_Pnt at(const Corner2d& corner) {
  return {corner.x, corner.y, 0};
}

TopoDS_Wire rounded(const Outline& outline) {
  BRepBuilderAPI_MakeWire wire;
  const std::size_t n = outline.size();
  std::vector<gp_Pnt> into(n), middle(n), out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const gp_Pnt p = at(outline[i]);
    gp_Vec back(p, at(outline[(i + n - 1) % n])), ahead(p, at(outline[(i + 1) % n]));
    back.Normalize();
    ahead.Normalize();
    const double half = 0.5 * back.Angle(ahead), radius = outline[i].radius;
    into[i] = p.Translated(radius / std::tan(half) * back);
    out[i] = p.Translated(radius / std::tan(half) * ahead);
    const gp_Vec inward = (back + ahead).Normalized();
    middle[i] = p.Translated((radius / std::sin(half) - radius) * inward);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (outline[i].radius > 0)
      wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(into[i], middle[i], out[i]).Value()).Edge());
    const gp_Pnt& next = into[(i + 1) % n];
    if (out[i].Distance(next) > 1e-9) wire.Add(BRepBuilderAPI_MakeEdge(out[i], next).Edge());
  }
  return wire.Wire();
}

TopoDS_Shape box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape drill(double x, double y, double z, const gp_Dir& axis, double radius, double depth) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), axis), radius, depth).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& from, const std::vector<TopoDS_Shape>& tools) {
  TopoDS_Shape result = from;
  for (const TopoDS_Shape& tool : tools) result = BRepAlgoAPI_Cut(result, tool).Shape();
  return result;
}

/// One solid, without the edges where the parts met.
TopoDS_Shape fuse(const std::vector<TopoDS_Shape>& parts) {
  TopoDS_Shape result = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) result = BRepAlgoAPI_Fuse(result, parts[i]).Shape();
  ShapeUpgrade_UnifySameDomain unify(result);
  unify.Build();
  return TopExp_Explorer(unify.Shape(), TopAbs_SOLID).Current();
}

Outline rectangle(double x, double y, double dx, double dy, double radius = 0) {
  return {{x, y, radius}, {x + dx, y, radius}, {x + dx, y + dy, radius}, {x, y + dy, radius}};
}

constexpr double r = 3, t = 2, R = r + t;  // inner and outer radius of bends in sheets of 2 mm

TopoDS_Shape plate_with_holes() {
  return cut(box(0, 0, 0, 120, 70, 2), {drill(22, 20, -1, gp::DZ(), 9, 4), drill(60, 45, -1, gp::DZ(), 14, 4),
                                        drill(98, 18, -1, gp::DZ(), 6, 4), box(85, 46, -1, 20, 8, 4)});
}

TopoDS_Shape l_section() {
  const Outline outline{{0, 0, R}, {40, 0}, {40, t}, {t, t, r}, {t, 60}, {0, 60}};
  return cut(profile({outline}, 100), {drill(20, -1, 30, gp::DY(), 5, 4), box(-1, 30, 60, 4, 12, 20)});
}

TopoDS_Shape u_section() {
  const Outline outline{{0, 0, R},      {50, 0, R}, {50, 30}, {50 - t, 30},
                        {50 - t, t, r}, {t, t, r},  {t, 30},  {0, 30}};
  // A notch that runs through a bend.
  return cut(profile({outline}, 120), {drill(25, -1, 40, gp::DY(), 8, 4), box(-1, -1, 70, 20, 15, 20)});
}

TopoDS_Shape z_section() {
  const Outline outline{{0, 0},   {30, 0, R},      {30, 40 - t, r}, {60, 40 - t},
                        {60, 40}, {30 - t, 40, R}, {30 - t, t, r},  {0, t}};
  return cut(profile({outline}, 90), {drill(15, -1, 45, gp::DY(), 6, 4)});
}

TopoDS_Shape hat_section() {
  const Outline outline{{0, 0},  {20, 0, R},     {20, 30 - t, r}, {60, 30 - t, r}, {60, 0, R},     {80, 0},
                        {80, t}, {60 + t, t, r}, {60 + t, 30, R}, {20 - t, 30, R}, {20 - t, t, r}, {0, t}};
  return cut(profile({outline}, 120), {drill(40, 25, 60, gp::DY(), 9, 10), drill(8, -1, 20, gp::DY(), 3, 4)});
}

TopoDS_Shape square_tube() {
  return profile({rectangle(0, 0, 50, 50, 6), rectangle(3, 3, 44, 44, 3)}, 150);
}

TopoDS_Shape round_tube() {
  return cut(drill(0, 0, 0, gp::DZ(), 25, 120), {drill(0, 0, -1, gp::DZ(), 22, 122)});
}

Outline i_outline(double width, double height, double web, double flange, double fillet) {
  const double a = 0.5 * (width - web), b = a + web, top = height - flange;
  return {{0, 0},           {width, 0},       {width, flange},     {b, flange, fillet},
          {b, top, fillet}, {width, top},     {width, height},     {0, height},
          {0, top},         {a, top, fillet}, {a, flange, fillet}, {0, flange}};
}

TopoDS_Shape t_beam(double fillet) {
  return profile({{{0, 0}, {60, 0}, {60, 4}, {32, 4, fillet}, {32, 60}, {28, 60}, {28, 4, fillet}, {0, 4}}},
                 200);
}

TopoDS_Shape box_beam(double outer, double inner) {
  return profile({rectangle(0, 0, 60, 80, outer), rectangle(3, 4, 54, 72, inner)}, 200);
}

/// Two flat parts of 50 mm, measured in the middle, at 135 degrees, without a radius.
TopoDS_Shape folded_sheet() {
  const double c = std::sqrt(0.5), k = std::tan(M_PI / 8);  // the corner's sides end k away from its middle
  return profile({{{0, -1},
                   {50 + k, -1},
                   {50 + 50 * c + c, 50 * c - c},
                   {50 + 50 * c - c, 50 * c + c},
                   {50 - k, 1},
                   {0, 1}}},
                 80);
}

/// A tube with a smaller tube on its side, open inside.
TopoDS_Shape nozzle() {
  const TopoDS_Shape outer = fuse({drill(0, 0, 0, gp::DZ(), 30, 120), drill(0, 0, 60, gp::DX(), 15, 60)});
  return cut(outer, {drill(0, 0, -1, gp::DZ(), 27, 122), drill(0, 0, 60, gp::DX(), 13, 61)});
}

TopoDS_Shape sharp_l() {
  return profile({{{0, 0}, {40, 0}, {40, 3}, {2, 3}, {2, 60}, {0, 60}}}, 100);
}

/// A rib that ends on the plate, away from its rims.
TopoDS_Shape short_rib() {
  return fuse({box(0, 0, 0, 100, 60, 3), box(20, 29, 0, 50, 2, 20)});
}

/// A pocket from one side leaves 2 of 3 mm.
TopoDS_Shape stepped_sheet() {
  return cut(box(0, 0, 0, 100, 50, 3), {box(50, -1, 2, 51, 52, 2)});
}

/// The same where the step leans by 45 degrees, and where it is rounded at its foot and at its head.
TopoDS_Shape leaning_step() {
  return profile({{{0, 0}, {100, 0}, {100, 2}, {51, 2}, {50, 3}, {0, 3}}}, 50);
}
TopoDS_Shape rounded_step() {
  return profile({{{0, 0}, {100, 0}, {100, 2}, {51, 2, 0.4}, {50.5, 3, 0.4}, {0, 3}}}, 50);
}

/// A pocket as milled: with draft, and round corners.
TopoDS_Shape milled_pocket() {
  BRepOffsetAPI_ThruSections pocket(Standard_True, Standard_True);
  for (const double z : {2.0, 4.0}) {
    const double wider = 0.2 * (z - 2);
    gp_Trsf lift;
    lift.SetTranslation(gp_Vec(0, 0, z));
    pocket.AddWire(TopoDS::Wire(
        BRepBuilderAPI_Transform(
            rounded(rectangle(30 - wider, 20 - wider, 40 + 2 * wider, 20 + 2 * wider, 8 + wider)), lift)
            .Shape()));
  }
  pocket.Build();
  return cut(box(0, 0, 0, 100, 60, 4), {pocket.Shape()});
}

/// A pocket inside, half as deep as the sheet is thick.
TopoDS_Shape pocket_sheet() {
  return cut(box(0, 0, 0, 100, 60, 4), {box(30, 20, 2, 40, 20, 3)});
}

TopoDS_Shape tapering_web() {
  return profile({{{0, 0}, {100, 0}, {100, 2}, {0, 4}}}, 60);
}

/// A box whose sides lean in by so much a height of 1; they lean out where that is negative.
TopoDS_Shape drafted(double x, double y, double z, double dx, double dy, double dz, double in_x,
                     double in_y) {
  const gp_Ax2 frame(gp_Pnt(x, y + dy, z), gp::DY().Reversed(), gp::DX());
  const double cx = in_x * dz, cy = in_y * dz;
  return BRepPrimAPI_MakeWedge(frame, dx, dz, dy, cx, cy, dx - cx, dy - cy).Shape();
}

/// A plastic housing of 2 mm, open below, with draft on all walls, two ribs that cross and thicken toward the
/// lid, and a boss for a screw.
TopoDS_Shape housing() {
  const double draft = std::tan(2 * M_PI / 180);
  const auto tub = [&](double off, double low, double high) {
    const double in = off + draft * low;
    return drafted(in, in, low, 100 - 2 * in, 60 - 2 * in, high - low, draft, draft);
  };
  const auto rib = [&](double x, double y, double z, double dx, double dy) {
    const double out = -0.2 / 18.5;
    const TopoDS_Shape whole = drafted(x, y, z, dx, dy, 28.5 - z, dx < 2 ? out : 0, dy < 2 ? out : 0);
    return BRepAlgoAPI_Common(whole, tub(0.8, 0, 28.5)).Shape();
  };
  const TopoDS_Shape boss = BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(70, 15, 10), gp::DZ()), 4, 4.4, 18.5).Shape();
  const TopoDS_Shape walls = cut(tub(0, 0, 30), {tub(2, -1, 28)});
  return cut(fuse({walls, rib(39.4, 0.8, 10, 1.2, 58.4), rib(0.8, 29.4, 16, 98.4, 1.2), boss}),
             {drill(70, 15, 10, gp::DZ(), 2.5, 18)});
}

/// A box with rounded edges, but for those at its bottom.
TopoDS_Shape rounded_above(const TopoDS_Shape& box, double radius) {
  BRepFilletAPI_MakeFillet fillet(box);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(box, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(edges(i)));
    const double low =
        std::min(curve.Value(curve.FirstParameter()).Z(), curve.Value(curve.LastParameter()).Z());
    const double high =
        std::max(curve.Value(curve.FirstParameter()).Z(), curve.Value(curve.LastParameter()).Z());
    if (high > low + 1 || low > 1) fillet.Add(radius, TopoDS::Edge(edges(i)));
  }
  return fillet.Shape();
}

/// A housing with draft, all its edges rounded but at the rim: the radii of its bends and corners differ by
/// 2, its walls are 1.9988 thick, so that no two of them share their centers.
TopoDS_Shape rounded_housing() {
  const double draft = std::tan(2 * M_PI / 180);
  return cut(rounded_above(drafted(0, 0, 0, 100, 60, 30, draft, draft), 5),
             {rounded_above(drafted(2, 2, 0, 96, 56, 28, draft, draft), 3)});
}

/// The same with two ribs that cross, and a boss.
TopoDS_Shape rounded_housing_with_ribs() {
  const double draft = std::tan(2 * M_PI / 180);
  const TopoDS_Shape outside = rounded_above(drafted(0, 0, 0, 100, 60, 30, draft, draft), 5);
  const TopoDS_Shape boss = cut(drill(70, 15, 9.5, gp::DZ(), 4, 19), {drill(70, 15, 9.5, gp::DZ(), 2.5, 18)});
  return fuse({rounded_housing(), BRepAlgoAPI_Common(box(39.4, 0.3, 12, 1.2, 59.4, 17), outside).Shape(),
               BRepAlgoAPI_Common(box(0.3, 29.4, 16, 99.4, 1.2, 13), outside).Shape(), boss});
}

/// A solid from one rectangle with round corners to another above it, all of B-splines.
TopoDS_Shape lofted_box(const Outline& low, const Outline& high, double height) {
  BRepOffsetAPI_ThruSections loft(Standard_True, Standard_False);
  gp_Trsf lift;
  lift.SetTranslation(gp_Vec(0, 0, height));
  loft.AddWire(rounded(low));
  loft.AddWire(TopoDS::Wire(BRepBuilderAPI_Transform(rounded(high), lift).Shape()));
  loft.Build();
  return loft.Shape();
}

/// A housing of 2 mm with draft, made of lofts: its flat sides are B-splines too.
TopoDS_Shape lofted_housing() {
  return cut(lofted_box(rectangle(0, 0, 100, 60, 8), rectangle(1, 1, 98, 58, 7.5), 30),
             {lofted_box(rectangle(2, 2, 96, 56, 6), rectangle(3, 3, 94, 54, 5.5), 28)});
}

/// A cylinder with half-spheres as heads.
TopoDS_Shape tank() {
  const auto capsule = [](double radius) {
    return fuse({drill(0, 0, 0, gp::DZ(), radius, 80),
                 BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(0, 0, 0), gp::DZ()), radius).Shape(),
                 BRepPrimAPI_MakeSphere(gp_Ax2(gp_Pnt(0, 0, 80), gp::DZ()), radius).Shape()});
  };
  return cut(capsule(31), {capsule(29)});
}

/// An L whose outer radius is as large as the inner one: the sheet is thicker in the bend.
TopoDS_Shape loose_bend() {
  return cut(profile({{{0, 0, r}, {40, 0}, {40, t}, {t, t, r}, {t, 60}, {0, 60}}}, 100),
             {drill(20, -1, 30, gp::DY(), 5, 4)});
}

/// The same with a gusset across the bend.
TopoDS_Shape gusset_on_bend() {
  const TopoDS_Shape gusset = profile({{{1, 1}, {35, 1}, {35, 2}, {2, 50}, {1, 50}}}, 2);
  gp_Trsf place;
  place.SetTranslation(gp_Vec(0, 0, 49));
  return fuse({profile({{{0, 0, 4}, {40, 0}, {40, t}, {t, t, r}, {t, 60}, {0, 60}}}, 100),
               BRepBuilderAPI_Transform(gusset, place).Shape()});
}

/// A sheet that is set off by 20 mm at 45 degrees.
TopoDS_Shape joggle() {
  const double k = t * std::tan(M_PI / 8);
  return profile({{{0, 0},
                   {40, 0, R},
                   {60, 20, r},
                   {100, 20},
                   {100, 20 + t},
                   {60 - k, 20 + t, R},
                   {40 - k, t, r},
                   {0, t}}},
                 60);
}

/// A round sheet with a bead round its middle: planes, cones and tori.
TopoDS_Shape beaded_disc() {
  const double k = t * std::tan(M_PI / 8);
  const TopoDS_Shape half = section({{{20, 0},
                                      {40, 0, R},
                                      {50, 10, r},
                                      {60, 10, r},
                                      {70, 0, R},
                                      {90, 0},
                                      {90, t},
                                      {70 + k, t, r},
                                      {60 + k, 10 + t, R},
                                      {50 - k, 10 + t, R},
                                      {40 - k, t, r},
                                      {20, t}}});
  return BRepPrimAPI_MakeRevol(half, gp_Ax1(gp_Pnt(0, 0, 0), gp::DY())).Shape();
}

Handle(Geom_Curve) wavy_curve(double height, double aside) {
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 17);
  const double waves = 6 - 0.02 * height;
  for (int i = 0; i < 17; ++i) {
    const double x = 5.0 * i, slope = waves * 0.08 * std::cos(0.08 * x);
    const double length = std::hypot(1, slope);
    points->SetValue(i + 1,
                     gp_Pnt(x - aside * slope / length, waves * std::sin(0.08 * x) + aside / length, height));
  }
  GeomAPI_Interpolate spline(points, Standard_False, 1e-9);
  spline.Perform();
  return Handle(Geom_Curve)(spline.Curve());
}

/// A wall of some 2 mm between B-spline surfaces, from a wavy line to one that waves less.
TopoDS_Shape lofted_wall() {
  BRepOffsetAPI_ThruSections loft(Standard_True, Standard_False);
  for (const double height : {0.0, 30.0, 70.0}) {
    const Handle(Geom_Curve) near = wavy_curve(height, -1), far = wavy_curve(height, 1);
    BRepBuilderAPI_MakeWire wire;
    wire.Add(BRepBuilderAPI_MakeEdge(near).Edge());
    wire.Add(BRepBuilderAPI_MakeEdge(near->Value(near->LastParameter()), far->Value(far->LastParameter())));
    wire.Add(BRepBuilderAPI_MakeEdge(far->Reversed()).Edge());
    wire.Add(BRepBuilderAPI_MakeEdge(far->Value(far->FirstParameter()), near->Value(near->FirstParameter())));
    loft.AddWire(wire.Wire());
  }
  loft.Build();
  return loft.Shape();
}

/// The same on a plate, which it meets in a curve.
TopoDS_Shape lofted_wall_on_plate() {
  return fuse({box(-10, -20, -1, 100, 40, 3), lofted_wall()});
}

}  // namespace

TopoDS_Shape section(const std::vector<Outline>& outlines) {
  BRepBuilderAPI_MakeFace face(rounded(outlines.front()), Standard_True);
  for (std::size_t i = 1; i < outlines.size(); ++i) {
    face.Add(TopoDS::Wire(rounded(outlines[i]).Reversed()));
  }
  return face.Face();
}

TopoDS_Shape profile(const std::vector<Outline>& outlines, double length) {
  return BRepPrimAPI_MakePrism(section(outlines), gp_Vec(0, 0, length)).Shape();
}

std::vector<CantileverModel> cantilevers() {
  const Outline hat{{0, 0},  {20, 0, R},     {20, 30 - t, r}, {60, 30 - t, r}, {60, 0, R},     {80, 0},
                    {80, t}, {60 + t, t, r}, {60 + t, 30, R}, {20 - t, 30, R}, {20 - t, t, r}, {0, t}};
  const Outline zed{{0, 0},   {30, 0, R},      {30, 40 - t, r}, {60, 40 - t},
                    {60, 40}, {30 - t, 40, R}, {30 - t, t, r},  {0, t}};
  return {{"i_beam_with_fillets", {i_outline(60, 100, 4, 6, 5)}, 600},
          {"h_beam", {i_outline(100, 100, 5, 7, 0)}, 600},
          {"ipe_200", {i_outline(100, 200, 5.6, 8.5, 12)}, 800},
          {"t_beam_with_fillets",
           {{{0, 0}, {60, 0}, {60, 4}, {32, 4, 4}, {32, 60}, {28, 60}, {28, 4, 4}, {0, 4}}},
           500},
          {"box_beam_with_fillets", {rectangle(0, 0, 60, 80), rectangle(3, 4, 54, 72, 4)}, 600},
          {"box_beam_rounded_outside", {rectangle(0, 0, 60, 80, 3), rectangle(3, 4, 54, 72, 6)}, 600},
          {"square_tube", {rectangle(0, 0, 50, 50, 6), rectangle(3, 3, 44, 44, 3)}, 500},
          {"round_tube", {rectangle(0, 0, 50, 50, 25), rectangle(3, 3, 44, 44, 22)}, 500},
          {"channel_with_bends",
           {{{0, 0, 5}, {60, 0, 5}, {60, 40}, {58, 40}, {58, 2, 3}, {2, 2, 3}, {2, 40}, {0, 40}}},
           500},
          {"l_section", {{{0, 0, R}, {40, 0}, {40, t}, {t, t, r}, {t, 60}, {0, 60}}}, 500},
          {"z_section", {zed}, 500},
          {"hat_section", {hat}, 500}};
}

TopoDS_Shape ribbed_plate(int ribs) {
  std::vector<TopoDS_Shape> parts{box(0, 0, 0, 200, 200, 3)};
  for (int i = 1; i <= ribs; ++i) {
    const double x = 200.0 * i / (ribs + 1);
    parts.push_back(box(x - 1, 0, 0, 2, 200, 25));
    parts.push_back(box(0, x - 1, 0, 200, 2, 25));
  }
  return fuse(parts);
}

/// The same with fillets of 1 mm, where the ribs stand on the plate and where they cross.
TopoDS_Shape ribbed_plate_with_fillets() {
  const TopoDS_Shape sharp = ribbed_plate(2);
  BRepFilletAPI_MakeFillet fillet(sharp);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(sharp, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(edges(i)));
    const gp_Pnt at = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
    const bool inside = at.X() > 1 && at.X() < 199 && at.Y() > 1 && at.Y() < 199;
    const bool upright = std::abs(at.Z() - 14) < 1e-6;
    if (inside && (upright || std::abs(at.Z() - 3) < 1e-6)) fillet.Add(1, TopoDS::Edge(edges(i)));
  }
  return fillet.Shape();
}

TopoDS_Shape thick_block() {
  return box(0, 0, 0, 30, 20, 10);
}

/// A tube along x from a corner, square outside.
TopoDS_Shape tube_along_x(double x, double y, double z, double length, double wide, double wall) {
  const double inside = wide - 2 * wall;
  return cut(box(x, y, z, length, wide, wide), {box(x - 1, y + wall, z + wall, length + 2, inside, inside)});
}

TopoDS_Shape welded_frame(double gap, double wide) {
  std::vector<TopoDS_Shape> parts;
  for (const double x : {-20.0, 180.0})
    parts.push_back(cut(box(x, 0, 0, 40, 40, 200), {box(x + 3, 3, -1, 34, 34, 202)}));
  parts.push_back(tube_along_x(20 + gap, 20 - 0.5 * wide, 130, 160 - 2 * gap, wide, 2));
  return compound(parts);
}

/// Two square tubes that meet in a miter, one of them set off along the other.
TopoDS_Shape mitered_frame(double gap) {
  const TopoDS_Shape half = profile({{{-10, -10}, {300, 300}, {300, -10}}}, 60);
  gp_Trsf down, mirror, apart;
  down.SetTranslation(gp_Vec(0, 0, -20));
  const TopoDS_Shape one =
      BRepAlgoAPI_Common(tube_along_x(0, 0, 0, 200, 30, 2), BRepBuilderAPI_Transform(half, down).Shape())
          .Shape();
  mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, -1, 0)));
  apart.SetTranslation(gp_Vec(-gap, 0, 0));
  return compound({one, BRepBuilderAPI_Transform(one, apart * mirror).Shape()});
}

/// An I-beam between two plates.
TopoDS_Shape beam_between_plates(double gap) {
  const TopoDS_Shape beam = profile({i_outline(60, 100, 4, 6, 0)}, 200);
  return compound({beam, box(-10, -10, -4 - gap, 80, 120, 4), box(-10, -10, 200 + gap, 80, 120, 4)});
}

/// A column of I-section, a tube that stands off from it, and a brace between them at 45 degrees, all a
/// little apart.
TopoDS_Shape braced_frame() {
  gp_Trsf place, lift;
  place.SetTranslation(gp_Vec(-30, -50, 0));
  lift.SetTranslation(gp_Vec(0, 50, 60));
  const TopoDS_Shape column =
      BRepBuilderAPI_Transform(profile({i_outline(60, 100, 4, 6, 0)}, 300), place).Shape();
  const TopoDS_Shape beam = cut(box(-20, 50.5, 180, 40, 200, 40), {box(-17, 49, 183, 34, 203, 34)});
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp::DX()), M_PI / 4);
  const TopoDS_Shape straight = cut(box(-10, 0, 0, 20, 200, 20), {box(-8, -1, 2, 16, 202, 16)});
  const TopoDS_Shape brace = BRepBuilderAPI_Transform(straight, lift * turn).Shape();
  return compound({column, beam, BRepAlgoAPI_Common(brace, box(-50, 50.3, 0, 100, 400, 179.7)).Shape()});
}

TopoDS_Shape tube(double z, double length, double outer, double inner) {
  return cut(drill(0, 0, z, gp::DZ(), outer, length), {drill(0, 0, z - 1, gp::DZ(), inner, length + 2)});
}

/// The area of a ring.
double ring(double outer, double inner) {
  return M_PI * (outer * outer - inner * inner);
}

const std::vector<JoinedModel>& joined_models() {
  const double columns = 2 * 4 * 37 * 200;
  static const std::vector<JoinedModel> models{
      {"frame_with_gaps", [] { return welded_frame(1); }, 3, columns + 4 * 28 * 163, {2, 3}},
      {"frame_with_narrow_gaps", [] { return welded_frame(0.01); }, 3, columns + 4 * 28 * 163, {2, 3}},
      {"frame_with_wide_gaps", [] { return welded_frame(1.99); }, 3, columns + 4 * 28 * 163, {2, 3}},
      // The beam's sides lie beside those of the columns by 0.5.
      {"flush_frame", [] { return welded_frame(0, 40); }, 3, columns + 4 * 38 * 163 + 4 * 38 * 0.5, {2, 3}},
      {"flush_frame_with_gaps",
       [] { return welded_frame(0.5, 40); },
       3,
       columns + 4 * 38 * 163 + 4 * 38 * 0.5,
       {2, 3}},
      {"mitered_frame", [] { return mitered_frame(1); }, 2, 0, {2}},
      {"braced_frame", braced_frame, 3, 0, {2, 3, 4, 6}},
      {"beam_between_plates", [] { return beam_between_plates(0.5); }, 3, 2 * 80 * 120 + 205 * 214, {4, 6}},
      {"plates_end_to_end",
       [] {
         return compound({box(0, 0, 0, 50, 60, 2), box(51, 0, 0, 50, 60, 2)});
       },
       2,
       101 * 60,
       {2}},
      {"plate_on_plate",
       [] {
         return compound({box(0, 0, 0, 100, 60, 3), box(49, 0, 3.5, 2, 60, 40)});
       },
       2,
       100 * 60 + 60 * 42,
       {2, 3}},
      // Where they lie on each other it is as thick as both with the gap.
      {"lap",
       [] {
         return compound({box(0, 0, 0, 60, 40, 2), box(40, 0, 2.5, 60, 40, 2)});
       },
       2,
       100 * 40 + 2 * 40 * 1.25,
       {2, 4.5}},
      {"lap_of_two_thicknesses",
       [] {
         return compound({box(0, 0, 0, 60, 40, 2), box(40, 0, 2, 60, 40, 3)});
       },
       2,
       100 * 40 + 40 * (1.5 + 1),
       {2, 3, 5}},
      {"crossed_bars",
       [] {
         return compound({box(0, 20, 0, 80, 20, 2), box(30, -10, 2.4, 20, 80, 3)});
       },
       2,
       20 * (80 + 60) + 2 * 20 * (1.7 + 1.2),
       {2, 3, 5.4}},
      {"sheet_with_doubler",
       [] {
         return compound({box(0, 0, 0, 100, 80, 2), box(30, 20, 2, 40, 40, 2)});
       },
       2,
       100 * 80 + 4 * 40,
       {2, 4}},
      {"square_tube_on_round_one",
       [] {
         return compound({cut(drill(0, 0, 0, gp::DZ(), 30, 150), {drill(0, 0, -1, gp::DZ(), 27, 152)}),
                          tube_along_x(31, -6, 60, 120, 12, 1.5)});
       },
       2,
       0,
       {1.5, 3}},
      // Gaps between bent faces; where both walls face each other they are one with what fills the gap.
      {"tube_in_sleeve",
       [] {
         return compound({tube(0, 100, 30, 27), tube(20, 60, 34, 31)});
       },
       2,
       2 * M_PI * (28.5 * 40 + 30.5 * 60) + 2 * ring(30.5, 28.5),
       {3, 7}},
      {"sleeve_at_end",
       [] {
         return compound({tube(0, 100, 30, 27), tube(60, 100, 34, 31)});
       },
       2,
       2 * M_PI * (28.5 * 60 + 30.5 * 40 + 32.5 * 60) + ring(30.5, 28.5) + ring(32.5, 30.5),
       {3, 7}},
      {"tube_through_plate",
       [] {
         return compound({tube(0, 100, 30, 27),
                          cut(box(-50, -50, 48, 100, 100, 4), {drill(0, 0, 40, gp::DZ(), 31, 20)})});
       },
       2,
       2 * M_PI * 28.5 * 100 + 100 * 100 - M_PI * 28.5 * 28.5,
       {3, 4}},
      {"tube_cut_to_fit",
       [] {
         const gp_Dir up(1, 0, 1);
         const TopoDS_Shape brace = cut(drill(0, 0, 30, up, 15, 150), {drill(-1, 0, 29, up, 13, 153)});
         return compound({tube(0, 150, 30, 27), cut(brace, {drill(0, 0, -50, gp::DZ(), 31, 250)})});
       },
       2,
       0,
       {2, 3}},
      {"saddle_on_tube",
       [] {
         const gp_Ax2 place(gp_Pnt(0, 0, 20), gp::DZ());
         return compound(
             {tube(0, 100, 30, 27), cut(BRepPrimAPI_MakeCylinder(place, 34, 60, 0.5 * M_PI).Shape(),
                                        {drill(0, 0, 0, gp::DZ(), 31, 100)})});
       },
       2,
       2 * M_PI * (28.5 * 100 + 0.25 * (30.5 - 28.5) * 60) + 0.5 * ring(30.5, 28.5) + 2 * 2 * 60,
       {3, 7}},
  };
  return models;
}

TopoDS_Shape blended_housing() {
  const auto rounded_lid = [](const TopoDS_Shape& loft, double radius) {
    BRepFilletAPI_MakeFillet fillet(loft);
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(loft, TopAbs_EDGE, edges);
    for (int i = 1; i <= edges.Extent(); ++i) {
      const BRepAdaptor_Curve curve(TopoDS::Edge(edges(i)));
      const double low = curve.Value(curve.FirstParameter()).Z(),
                   high = curve.Value(curve.LastParameter()).Z();
      if (std::min(low, high) > 20) fillet.Add(radius, TopoDS::Edge(edges(i)));
    }
    return fillet.Shape();
  };
  return cut(rounded_lid(lofted_box(rectangle(0, 0, 100, 60, 8), rectangle(1, 1, 98, 58, 7.5), 30), 4),
             {rounded_lid(lofted_box(rectangle(2, 2, 96, 56, 6), rectangle(3, 3, 94, 54, 5.5), 28), 2)});
}

TopoDS_Shape plate_on_block(double height) {
  return fuse({box(0, 0, 0, 40, 40, height), box(18, 0, height, 3, 40, 60)});
}

const std::vector<ThinModel>& thin_models() {
  // Of the middle of a 2 mm sheet: a bend, and what it takes of the two straight ends at it.
  const double bend = 0.5 * M_PI * (r + 0.5 * t), end = r + t;
  const auto hole = [](double radius) { return M_PI * radius * radius; };
  const auto i_beam = [](double fillet) {
    return [=] { return profile({i_outline(60, 100, 4, 6, fillet)}, 200); };
  };
  static const std::vector<ThinModel> models{
      {"plate_with_holes", plate_with_holes, 120 * 70 - hole(9) - hole(14) - hole(6) - 160, {2}, 0.01, 5},
      {"l_section", l_section, 100 * (40 + 60 - 2 * end + bend) - hole(5) - 12 * 20, {2}, 0.01, 3},
      {"u_section",
       u_section,
       120 * (50 + 2 * 30 - 4 * end + 2 * bend) - hole(8) - 20 * (19 + 14 - 2 * end + bend),
       {2},
       0.01,
       3},
      {"z_section", z_section, 90 * (30 + 32 + 40 - 4 * end + 2 * bend) - hole(6), {2}, 0.01, 2},
      {"hat_section",
       hat_section,
       120 * (2 * 20 + 2 * 30 + 44 - 8 * end + 4 * bend) - hole(9) - hole(3),
       {2},
       0.01,
       3},
      {"square_tube", square_tube, 150 * (4 * 38 + 2 * M_PI * 4.5), {3}, 0.01, 2},
      {"round_tube", round_tube, 120 * 2 * M_PI * 23.5, {3}, 0.01, 2},
      {"i_beam", i_beam(0), 200 * (2 * 60 + 94), {4, 6}, 0.03, 1},
      {"i_beam_with_fillets", i_beam(5), 200 * (2 * 60 + 94), {4, 4.64, 6, 6.36}, 0.03, 1},
      {"i_beam_with_tapered_flanges",
       [] {
         return profile({{{0, 0},
                          {60, 0},
                          {60, 5},
                          {32, 8},
                          {32, 92},
                          {60, 95},
                          {60, 100},
                          {0, 100},
                          {0, 95},
                          {28, 92},
                          {28, 8},
                          {0, 5}}},
                        200);
       },
       0,
       {4, 6.6},
       0.03,
       1},
      {"h_beam",
       [] { return profile({i_outline(100, 100, 5, 7, 0)}, 200); },
       200 * (2 * 100 + 93),
       {5, 7},
       0.03,
       1},
      {"t_beam", [] { return t_beam(0); }, 200 * (60 + 58), {4}, 0.03, 1},
      {"t_beam_with_fillets", [] { return t_beam(4); }, 200 * (60 + 58), {4, 4.57, 5.14}, 0.035, 1},
      {"box_beam", [] { return box_beam(0, 0); }, 200 * 2 * (57 + 76), {3, 4}, 0.01, 2},
      {"box_beam_with_fillets",
       [] { return box_beam(0, 4); },
       200 * 2 * (57 + 76),
       {3, 3.29, 4, 4.31},
       1e-6,
       2},
      {"box_beam_rounded_outside",
       [] { return box_beam(3, 6); },
       200 * 2 * (57 + 76),
       {3, 3.36, 4, 4.39},
       1e-6,
       2},
      {"sharp_l", sharp_l, 100 * (39 + 58.5), {2, 3}, 0.01, 1},
      {"folded_sheet", folded_sheet, 80 * (50 + 50), {2}, 0.01, 1},
      {"ribbed_plate", [] { return ribbed_plate(2); }, 200 * 200 + 4 * 200 * 23.5, {2, 3}, 0.02, 1},
      {"ribbed_plate_with_fillets", ribbed_plate_with_fillets, 200 * 200 + 4 * 200 * 23.5, {2, 3}, 0.02, 1},
      {"short_rib", short_rib, 100 * 60 + 50 * 18.5, {2, 3}, 0.02, 2},
      {"stepped_sheet", stepped_sheet, 100 * 50 + 0.5 * 50, {2, 3}, 0.01, 1},
      {"leaning_step", leaning_step, 100 * 50 + 0.5 * 50, {2, 3}, 0.01, 1},
      {"rounded_step", rounded_step, 0, {2, 3}, 0.01, 1},
      {"milled_pocket", milled_pocket, 0, {2, 4}, 0.01, 1},
      {"pocket_sheet", pocket_sheet, 100 * 60 + 120, {2, 4}, 0.015, 1},
      {"tapering_web", tapering_web, 60 * 100 / std::cos(0.5 * std::atan(0.02)), {3}, 0.01, 1},
      {"housing", housing, 0, {1.3, 1.4, 1.7, 2}, 0.02, 4},
      {"rounded_housing", rounded_housing, 0, {2}, 0.01, 1},
      {"rounded_housing_with_ribs", rounded_housing_with_ribs, 0, {1.2, 1.5, 2}, 0.02, 4},
      {"lofted_housing", lofted_housing, 0, {2}, 0.01, 1},
      {"tank", tank, 80 * 2 * M_PI * 30 + 4 * M_PI * 900, {2}, 0.01, 0},
      {"nozzle", nozzle, 0, {2, 3}, 0.03, 3},
      {"joggle", joggle, 60 * (80 + 20 * M_SQRT2 - 4 * 4 * std::tan(M_PI / 8) + M_PI * 2), {2}, 0.01, 1},
      {"beaded_disc", beaded_disc, 0, {2}, 0.01, 2},
      {"loose_bend", loose_bend, 0, {2, 2.4}, 0.01, 2},
      {"gusset_on_bend", gusset_on_bend, 0, {2, 2.2}, 0.02, 2},
      {"lofted_wall", lofted_wall, 0, {2}, 0.01, 1},
      {"lofted_wall_on_plate", lofted_wall_on_plate, 0, {2, 3}, 0.02, 2},
  };
  return models;
}

}  // namespace quadrille
