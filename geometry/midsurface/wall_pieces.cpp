#include "geometry/midsurface/wall_pieces.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Cone.hxx>
#include <set>

#include "geometry/midsurface/parameter_range.hpp"

namespace quadrille {

namespace {

/// The faces that a wall's middle surface may have to reach over: its sides, and the faces next to them that
/// belong to no wall, such as fillets.
std::vector<int> faces_to_cover(const Skin& skin, const std::vector<Wall>& walls, int wall) {
  TopTools_IndexedDataMapOfShapeListOfShape neighbors;
  TopExp::MapShapesAndAncestors(skin.solid(), TopAbs_EDGE, TopAbs_FACE, neighbors);
  std::set<int> in_walls, result;
  for (const Wall& other : walls) {
    for (const auto& side : other.sides) in_walls.insert(side.begin(), side.end());
  }
  for (const auto& side : walls[wall].sides) {
    for (const int face : side) {
      result.insert(face);
      for (TopExp_Explorer it(skin.faces()[face].face(), TopAbs_EDGE); it.More(); it.Next()) {
        for (const TopoDS_Shape& neighbor : neighbors.FindFromKey(it.Current())) {
          const int index = skin.index_of(TopoDS::Face(neighbor));
          if (in_walls.count(index) == 0) result.insert(index);
        }
      }
    }
  }
  return {result.begin(), result.end()};
}

/// Cones and spheres end where they become a point.
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

/// The wall's middle surface, bounded so that it reaches past all that it may have to meet.
TopoDS_Face middle_patch(const Skin& skin, const std::vector<Wall>& walls, int wall) {
  double margin = 0;
  for (const Wall& other : walls) margin = std::max(margin, 1.5 * other.thickness);
  const Handle(Geom_Surface)& middle = walls[wall].middle;
  if (walls[wall].fitted) return BRepBuilderAPI_MakeFace(middle, Precision::Confusion()).Face();
  const auto points = points_on_edges(skin, faces_to_cover(skin, walls, wall));
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

/// The faces of the skin that the patch may meet, as one argument: OpenCASCADE then does not look for
/// intersections among them. A wall's own sides it cannot meet, and next to a bent one OpenCASCADE looks
/// long.
TopoDS_Compound near_faces(const Skin& skin, const Wall& wall, const TopoDS_Face& patch) {
  TopoDS_Compound result;
  const BRep_Builder builder;
  builder.MakeCompound(result);
  Bnd_Box box;
  BRepBndLib::Add(patch, box, Standard_False);
  const std::vector<int> sides = both_sides(wall);
  for (std::size_t i = 0; i < skin.faces().size(); ++i) {
    const bool side = std::find(sides.begin(), sides.end(), static_cast<int>(i)) != sides.end();
    if (!side && !box.IsOut(skin.faces()[i].box())) builder.Add(result, skin.faces()[i].face());
  }
  return result;
}

/// The samples lie inside the face: where the thickness varies, it has its extremes at corners.
void widen_to_corners(const TopoDS_Face& face, const Wall& wall, const Skin& skin, Coverage& coverage) {
  for (TopExp_Explorer it(face, TopAbs_VERTEX); it.More(); it.Next()) {
    const gp_Pnt corner = BRep_Tool::Pnt(TopoDS::Vertex(it.Current()));
    if (wall.fitted && !position_in(wall, skin, corner)) continue;
    const double t = thickness_round(wall, skin, corner);
    coverage.thinnest = std::min(coverage.thinnest, t);
    coverage.thickest = std::max(coverage.thickest, t);
  }
}

}  // namespace

Coverage coverage_of(const TopoDS_Face& face, const Wall& wall, const Skin& skin) {
  Coverage result;
  double area = 0, covered = 0;
  for (const FaceSample& sample : sample_face(face, 16)) {
    area += sample.area;
    const auto position = position_in(wall, skin, sample.point);
    if (!position) continue;
    result.faces.insert(position->faces.begin(), position->faces.end());
    const double t = position->thickness();
    result.thinnest = covered > 0 ? std::min(result.thinnest, t) : t;
    result.thickest = std::max(result.thickest, t);
    result.mean += t * sample.area;
    covered += sample.area;
  }
  if (covered > 0) result.mean /= covered;
  if (result.thickest > (1 + 1e-4) * result.thinnest) widen_to_corners(face, wall, skin, result);
  result.share = area > 0 ? covered / area : 0;
  return result;
}

std::vector<TopoDS_Face> wall_pieces(const Skin& skin, const std::vector<Wall>& walls, int wall,
                                     const std::vector<WallEnd>& ends) {
  const TopoDS_Face patch = middle_patch(skin, walls, wall);
  BOPAlgo_Builder cutter;
  cutter.SetNonDestructive(Standard_True);
  cutter.AddArgument(patch);
  cutter.AddArgument(near_faces(skin, walls[wall], patch));
  for (const WallEnd& end : ends) {
    if (end.wall == wall) cutter.AddArgument(end.fence);
  }
  cutter.Perform();
  std::vector<TopoDS_Face> result;
  if (cutter.HasErrors() || !cutter.Images().IsBound(patch)) return result;
  constexpr double least_share = 0.02;
  for (const TopoDS_Shape& piece : cutter.Images().Find(patch)) {
    const TopoDS_Face& face = TopoDS::Face(piece);
    triangulate(face, 0.2 * walls[wall].thickness);
    if (coverage_of(face, walls[wall], skin).share > least_share) result.push_back(face);
  }
  return result;
}

}  // namespace quadrille
