/// Extends the middle past all that it may meet, cuts it by fences and skin, and keeps what lies in the wall.

#include "geometry/midsurface/wall_pieces.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Cone.hxx>
#include <set>

#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/parameter_range.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// The faces that a wall's middle surface may have to cover: its sides, and adjacent faces that belong to no
/// wall, such as fillets.
std::vector<int> faces_to_cover(const Skin& skin, const std::vector<Wall>& walls, int wall) {
  const std::vector<int> wall_of = walls_of_faces(walls);
  std::set<int> result;
  for (const int face : both_sides(walls[wall])) {
    result.insert(face);
    for (const auto& [edge, neighbor] : skin.neighbors(skin.faces()[face]))
      if (wall_of[neighbor] < 0) result.insert(neighbor);
  }
  return {result.begin(), result.end()};
}

/// Limits v where a cone or a sphere shrinks to a point.
void keep_regular(const GeomAdaptor_Surface& surface, ParameterRange& v) {
  if (surface.GetType() == GeomAbs_Sphere) {
    v.low = std::max(v.low, -0.5 * M_PI);
    v.high = std::min(v.high, 0.5 * M_PI);
  }
  if (surface.GetType() != GeomAbs_Cone) return;
  const gp_Cone cone = surface.Cone();
  const double apex = -cone.RefRadius() / std::sin(cone.SemiAngle());
  if (0.5 * (v.low + v.high) > apex)
    v.low = std::max(v.low, apex);
  else
    v.high = std::min(v.high, apex);
}

/// The wall's middle. A sphere is turned so that its seam and poles are away from the wall's sides if these
/// are less than half a sphere: near seam and poles OpenCASCADE loses parts.
Handle(Geom_Surface) turned_away(const Wall& wall) {
  const auto sphere = Handle(Geom_SphericalSurface)::DownCast(wall.middle);
  if (sphere.IsNull()) return wall.middle;
  const gp_Pnt center = sphere->Location();
  gp_Vec middle;
  double area = 0;
  for (const int face : both_sides(wall)) {
    for (const FaceSample& sample : wall.face(face).samples(24)) {
      middle += sample.area * gp_Vec(center, sample.point).Normalized();
      area += sample.area;
    }
  }
  constexpr double half = 0.5,
                   margin = 0.05;  // half a sphere has its centroid there, over the radius
  if (middle.Magnitude() < (half + margin) * area) return wall.middle;
  const gp_Dir ahead(middle);
  const gp_Dir up = std::abs(ahead.Dot(sphere->Axis().Direction())) < 0.7 ? sphere->Axis().Direction()
                                                                          : sphere->Position().XDirection();
  return new Geom_SphericalSurface(gp_Ax3(center, ahead.Crossed(up), ahead.Reversed()), sphere->Radius());
}

/// The wall's middle surface, bounded so that it extends past everything that it may have to meet.
TopoDS_Face middle_patch(const Skin& skin, const std::vector<Wall>& walls, int wall) {
  double margin = 0;
  for (const Wall& other : walls) margin = std::max(margin, 1.5 * other.thickness);
  if (walls[wall].ends) return BRepBuilderAPI_MakeFace(walls[wall].middle, Precision::Confusion()).Face();
  const auto points = points_on_edges(skin, faces_to_cover(skin, walls, wall));
  const Handle(Geom_Surface) middle = turned_away(walls[wall]);
  const gp_Pnt2d uv = ShapeAnalysis_Surface(middle).ValueOfUV(points.front(), Precision::Confusion());
  gp_Pnt at;
  gp_Vec du, dv;
  middle->D1(uv.X(), uv.Y(), at, du, dv);
  auto [u, v] = range_of(
      middle, points,
      {margin / std::max(du.Magnitude(), 1e-3 * margin), margin / std::max(dv.Magnitude(), 1e-3 * margin)});
  keep_regular(GeomAdaptor_Surface(middle), v);
  return BRepBuilderAPI_MakeFace(middle, u.low, u.high, v.low, v.high, Precision::Confusion()).Face();
}

/// The faces that need not cut a wall's middle: the wall's own sides, which it cannot meet, and the sides of
/// walls that continue at its bounds or behind its fences. It meets the latter only beyond the fences and
/// nearly tangent, where OpenCASCADE takes long and may lose everything. Nor need the risers behind fences at
/// steps: a riser's lower edge, and the side where it ends, may lie in the middle.
std::set<int> left_out(const std::vector<Wall>& walls, int wall, const std::vector<WallEnd>& ends) {
  std::set<int> result;
  const auto leave_out = [&](int other) {
    const std::vector<int> sides = both_sides(walls[other]);
    result.insert(sides.begin(), sides.end());
  };
  leave_out(wall);
  for (const int next : walls[wall].goes_on) leave_out(next);
  for (const WallEnd& end : ends) {
    if (end.wall == wall && (!end.step || end.riser >= 0)) leave_out(end.next);
    if (end.wall == wall && end.riser >= 0) result.insert(end.riser);
  }
  return result;
}

/// The faces of the skin that the patch may meet, as one argument, so that OpenCASCADE does not look for
/// intersections among them.
std::vector<TopoDS_Shape> near_faces(const Skin& skin, const std::set<int>& left_out,
                                     const TopoDS_Face& patch) {
  std::vector<TopoDS_Face> result;
  const Bnd_Box box = box_of(patch);
  for (std::size_t i = 0; i < skin.faces().size(); ++i) {
    if (left_out.count(static_cast<int>(i)) == 0 && !box.IsOut(skin.faces()[i].box()))
      result.push_back(skin.faces()[i].face());
  }
  if (result.empty()) return {};
  return {compound_of(result)};
}

/// Adds the corners to the thickness range: there a varying thickness has its extremes, outside the samples.
void widen_to_corners(const TopoDS_Face& face, const Wall& wall, Coverage& coverage) {
  for (TopExp_Explorer it(face, TopAbs_VERTEX); it.More(); it.Next()) {
    const gp_Pnt corner = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
    if (wall.fitted && !position_in(wall, corner)) continue;
    const double t = thickness_round(wall, corner);
    coverage.thinnest = std::min(coverage.thinnest, t);
    coverage.thickest = std::max(coverage.thickest, t);
  }
}

/// The pieces into which others cut a face; the face if they do not meet it, none if OpenCASCADE fails.
std::vector<TopoDS_Face> cut_by(const TopoDS_Face& face, const std::vector<TopoDS_Shape>& others,
                                const ExecutionContext& context) {
  if (others.empty()) return {face};
  BOPAlgo_Builder cutter;
  cutter.AddArgument(face);
  for (const TopoDS_Shape& other : others) cutter.AddArgument(other);
  perform(cutter, context);
  if (cutter.HasErrors()) return {};
  std::vector<TopoDS_Face> result;
  for (const TopoDS_Shape& piece : images(cutter, face)) result.push_back(TopoDS::Face(piece));
  return result;
}

}  // namespace

void triangulate_middle(const TopoDS_Face& face, double thickness) {
  // A crescent is narrower than the sagitta of its sides.
  const double width = width_of(face);
  constexpr double turn = 0.8;  // OpenCASCADE's time is quadratic in the nodes, of which each hole has eight
  triangulate(face, std::min(0.2 * thickness, width > 0 ? 0.1 * width : thickness), turn);
}

Coverage coverage_of(const TopoDS_Face& face, const Wall& wall, bool past_sides) {
  triangulate_middle(face, wall.thickness);
  Coverage result;
  double area = 0, covered = 0;
  for (const FaceSample& sample : sample_face(face, 16)) {
    area += sample.area;
    const auto position = past_sides ? std::nullopt : position_in(wall, sample.point);
    if (!past_sides && !position) continue;
    const double t = position ? position->thickness() : thickness_round(wall, sample.point);
    if (position) result.faces.insert(position->faces.begin(), position->faces.end());
    result.thinnest = covered > 0 ? std::min(result.thinnest, t) : t;
    result.thickest = std::max(result.thickest, t);
    result.mean += t * sample.area;
    covered += sample.area;
  }
  if (covered > 0) result.mean /= covered;
  if (result.thickest > (1 + 1e-4) * result.thinnest) widen_to_corners(face, wall, result);
  if (area > 0 && !past_sides) result.share = covered / area;
  return result;
}

double thickness_at(const Coverage& coverage, const Wall& wall, const gp_Pnt& point) {
  if (coverage.thickest <= coverage.thinnest) return coverage.mean;
  const double t = thickness_round(wall, point) + coverage.added;
  return std::clamp(t, coverage.thinnest, coverage.thickest);
}

std::vector<TopoDS_Face> wall_pieces(const Skin& skin, const std::vector<Wall>& walls, int wall,
                                     const std::vector<WallEnd>& ends, const ExecutionContext& context) {
  constexpr double least_share = 0.02;
  std::vector<TopoDS_Shape> fences;
  for (const WallEnd& end : ends) {
    if (end.wall == wall) fences.push_back(end.fence);
  }
  // The fences first, which the surface meets at clear angles. The parts then meet little of the skin.
  std::vector<TopoDS_Face> result;
  const std::set<int> never_met = left_out(walls, wall, ends);
  for (const TopoDS_Face& part : cut_by(middle_patch(skin, walls, wall), fences, context)) {
    for (const TopoDS_Face& piece : cut_by(part, near_faces(skin, never_met, part), context)) {
      context.check();
      if (coverage_of(piece, walls[wall]).share > least_share) result.push_back(piece);
    }
  }
  return result;
}

}  // namespace quadrille
