/// Closed forms: middle planes, coaxial cones and cylinders, spheres, and tori, within a tolerance.

#include "geometry/midsurface/middle_geometry.hpp"

#include <Adaptor3d_Curve.hxx>
#include <BRep_Tool.hxx>
#include <ElCLib.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_ElementarySurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <gp_Torus.hxx>
#include <optional>

namespace quadrille {

namespace {

constexpr double same_length = 1e-6;     // over the solid's size
constexpr double same_direction = 1e-5;  // radians

bool same_axis(const gp_Ax1& a, const gp_Ax1& b, double size) {
  return a.Direction().IsParallel(b.Direction(), same_direction) &&
         gp_Lin(a).Distance(b.Location()) < same_length * size;
}

/// The position of a cone's apex along an axis on which the cone is centered.
double apex_along(const gp_Cone& cone, const gp_Ax1& axis) {
  return gp_Vec(axis.Location(), cone.Apex()).Dot(gp_Vec(axis.Direction()));
}

/// Half-angle of a cone, positive where it widens along the axis.
double widening(const gp_Cone& cone, const gp_Ax1& axis) {
  return cone.Axis().Direction().Dot(axis.Direction()) > 0 ? cone.SemiAngle() : -cone.SemiAngle();
}

bool same_cones(const gp_Cone& a, const gp_Cone& b, double size) {
  return same_axis(a.Axis(), b.Axis(), size) &&
         std::abs(widening(a, a.Axis()) - widening(b, a.Axis())) < same_direction;
}

/// \param surface a cylinder or a sphere.
double radius_of(const BRepAdaptor_Surface& surface) {
  return surface.GetType() == GeomAbs_Cylinder ? surface.Cylinder().Radius() : surface.Sphere().Radius();
}

/// What leads from the axis of a cylinder to that of another one parallel to it, or from the center of a
/// sphere to that of another one. Nothing for other pairs.
std::optional<gp_Vec> way_between_rounds(const BRepAdaptor_Surface& s, const BRepAdaptor_Surface& t) {
  const bool cylinders = s.GetType() == GeomAbs_Cylinder;
  if (s.GetType() != t.GetType() || (!cylinders && s.GetType() != GeomAbs_Sphere)) return std::nullopt;
  const gp_Ax3 first = *frame_of(s), second = *frame_of(t);
  const gp_Vec way(first.Location(), second.Location()), along(first.Direction());
  if (!cylinders) return way;
  if (!first.Axis().IsParallel(second.Axis(), same_direction)) return std::nullopt;
  return way - way.Dot(along) * along;
}

/// A cylinder or a sphere of the mean radius of two.
Handle(Geom_Surface)
    between_rounds(const BRepAdaptor_Surface& s, const BRepAdaptor_Surface& t, const gp_Ax3& frame) {
  const double radius = 0.5 * (radius_of(s) + radius_of(t));
  if (s.GetType() == GeomAbs_Cylinder) return new Geom_CylindricalSurface(frame, radius);
  return new Geom_SphericalSurface(frame, radius);
}

bool same_surfaces(const SkinFace& a, const SkinFace& b, double size) {
  const BRepAdaptor_Surface &s = a.surface(), &t = b.surface();
  const double near = same_length * size;
  if (const auto way = way_between_rounds(s, t))
    return way->Magnitude() < near && std::abs(radius_of(s) - radius_of(t)) < near;
  switch (s.GetType()) {
    case GeomAbs_Plane:
      return s.Plane().Axis().Direction().IsParallel(t.Plane().Axis().Direction(), same_direction) &&
             s.Plane().Distance(t.Plane().Location()) < near;
    case GeomAbs_Cone:
      return same_cones(s.Cone(), t.Cone(), size) &&
             std::abs(apex_along(s.Cone(), s.Cone().Axis()) - apex_along(t.Cone(), s.Cone().Axis())) < near;
    case GeomAbs_Torus:
      return same_axis(s.Torus().Axis(), t.Torus().Axis(), size) &&
             s.Torus().Location().Distance(t.Torus().Location()) < near &&
             std::abs(s.Torus().MajorRadius() - t.Torus().MajorRadius()) < near &&
             std::abs(s.Torus().MinorRadius() - t.Torus().MinorRadius()) < near;
    default:
      return BRep_Tool::Surface(a.face()) == BRep_Tool::Surface(b.face());
  }
}

/// Whether two faces on one surface have their outward normals on the same side.
bool same_outside(const SkinFace& a, const SkinFace& b) {
  const auto samples = a.samples(1);
  if (samples.empty()) return false;
  const auto here = a.outward(samples.front().uv);
  const auto there = b.outward_at(samples.front().point);
  return here && there && here->Dot(*there) > 0;
}

Handle(Geom_Surface) between_planes(const SkinFace& a, const SkinFace& b) {
  const auto n = a.outward({}), m = b.outward({});  // the same everywhere
  const gp_Pln p = a.surface().Plane(), q = b.surface().Plane();
  // The points that are equally far from both: difference * x = offset.
  const gp_XYZ difference = n->XYZ() - m->XYZ();
  const double offset = n->XYZ().Dot(p.Location().XYZ()) - m->XYZ().Dot(q.Location().XYZ());
  const gp_Pnt at(p.Location().XYZ() +
                  difference * ((offset - difference.Dot(p.Location().XYZ())) / difference.SquareModulus()));
  return new Geom_Plane(gp_Ax3(at, gp_Dir(difference), p.XAxis().Direction()));
}

Handle(Geom_Surface) between_cones(const gp_Cone& a, const gp_Cone& b) {
  const gp_Ax1 axis = a.Axis();
  const double apex = 0.5 * (apex_along(a, axis) + apex_along(b, axis));
  const double radius = -apex * std::tan(a.SemiAngle());
  if (radius >= 0) return new Geom_ConicalSurface(a.Position(), a.SemiAngle(), radius);
  gp_Ax3 moved = a.Position();  // the reference radius must not be negative
  moved.SetLocation(gp_Pnt(axis.Location().XYZ() + apex * axis.Direction().XYZ()));
  return new Geom_ConicalSurface(moved, a.SemiAngle(), 0);
}

/// The torus of a surface that is one, or that is a circle revolved around an axis in its plane.
std::optional<gp_Torus> torus_of(const BRepAdaptor_Surface& surface, double size) {
  if (surface.GetType() == GeomAbs_Torus) return surface.Torus();
  if (surface.GetType() != GeomAbs_SurfaceOfRevolution) return std::nullopt;
  const Handle(Adaptor3d_Curve) curve = surface.BasisCurve();
  if (curve->GetType() != GeomAbs_Circle) return std::nullopt;
  const gp_Circ circle = curve->Circle();
  const gp_Lin axis(surface.AxeOfRevolution());
  const gp_Pnt center = ElCLib::Value(ElCLib::Parameter(axis, circle.Location()), axis);
  const double major = center.Distance(circle.Location());
  const bool in_plane =
      std::abs(circle.Axis().Direction().Dot(axis.Direction())) < same_direction &&
      std::abs(gp_Vec(center, circle.Location()).Dot(gp_Vec(circle.Axis().Direction()))) < same_length * size;
  if (!in_plane || major < same_length * size) return std::nullopt;
  const gp_Ax3 frame(center, axis.Direction(), gp_Dir(gp_Vec(center, circle.Location())));
  return gp_Torus(frame, major, circle.Radius());
}

/// The axis around which a surface's u turns.
std::optional<gp_Ax1> turning_axis(const BRepAdaptor_Surface& surface) {
  if (surface.GetType() == GeomAbs_SurfaceOfRevolution) return surface.AxeOfRevolution();
  const auto frame = surface.GetType() == GeomAbs_Plane ? std::nullopt : frame_of(surface);
  return frame ? std::optional(frame->Axis()) : std::nullopt;
}

Handle(Geom_Surface) between_tori(const gp_Torus& a, const gp_Torus& b, double size) {
  const double near = same_length * size;
  if (!same_axis(a.Axis(), b.Axis(), size) || a.Location().Distance(b.Location()) > near ||
      std::abs(a.MajorRadius() - b.MajorRadius()) > near)
    return {};
  return new Geom_ToroidalSurface(a.Position(), a.MajorRadius(), 0.5 * (a.MinorRadius() + b.MinorRadius()));
}

}  // namespace

std::optional<gp_Ax3> frame_of(const BRepAdaptor_Surface& surface) {
  const auto elementary = Handle(Geom_ElementarySurface)::DownCast(surface.Surface().Surface());
  if (elementary.IsNull()) return std::nullopt;
  return elementary->Position().Transformed(surface.Trsf());
}

std::optional<gp_Ax1> common_axis(const Skin& skin, const std::vector<int>& faces) {
  const auto axis = turning_axis(skin.faces()[faces.front()].surface());
  if (!axis) return std::nullopt;
  const auto turns_around_it = [&](int face) {
    const BRepAdaptor_Surface& surface = skin.faces()[face].surface();
    if (surface.GetType() == GeomAbs_Plane)
      return axis->Direction().IsParallel(surface.Plane().Axis().Direction(), same_direction);
    if (surface.GetType() == GeomAbs_Sphere)
      return gp_Lin(*axis).Distance(surface.Sphere().Location()) < same_length * skin.size();
    const auto own = turning_axis(surface);
    return own && same_axis(*axis, *own, skin.size());
  };
  return std::all_of(faces.begin(), faces.end(), turns_around_it) ? axis : std::nullopt;
}

bool on_one_surface(const SkinFace& a, const SkinFace& b, double size) {
  return a.surface().GetType() == b.surface().GetType() && same_surfaces(a, b, size) && same_outside(a, b);
}

Handle(Geom_Surface) middle_surface(const SkinFace& a, const SkinFace& b, double size) {
  const BRepAdaptor_Surface &s = a.surface(), &t = b.surface();
  const auto torus = torus_of(s, size), other = torus_of(t, size);
  if (torus && other) return between_tori(*torus, *other, size);
  if (s.GetType() != t.GetType()) return {};
  if (s.GetType() == GeomAbs_Plane) return between_planes(a, b);
  if (s.GetType() == GeomAbs_Cone && same_cones(s.Cone(), t.Cone(), size))
    return between_cones(s.Cone(), t.Cone());
  const auto way = way_between_rounds(s, t);
  if (!way || way->Magnitude() > same_length * size) return {};
  return between_rounds(s, t, *frame_of(s));
}

NearMiddle near_middle_surface(const SkinFace& a, const SkinFace& b, double tolerance) {
  const BRepAdaptor_Surface &s = a.surface(), &t = b.surface();
  const auto way = way_between_rounds(s, t);
  if (!way) return {};
  // Half the difference of a point's distances from both is largest half way round from one center to the
  // other.
  const double radius = 0.5 * (radius_of(s) + radius_of(t));
  const double off = std::hypot(0.5 * way->Magnitude(), radius) - radius;
  if (off > tolerance) return {};
  return {between_rounds(s, t, frame_of(s)->Translated(0.5 * *way)), off};
}

}  // namespace quadrille
