/// Turns solids the right way out, fuses them, and checks by points inside that the fusion has lost none.

#include "geometry/midsurface/solids.hpp"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepLib.hxx>
#include <TopTools_ListOfShape.hxx>
#include <algorithm>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/gaps.hpp"

namespace quadrille {

namespace {

/// The solid, oriented with the material inside.
TopoDS_Solid right_way_out(const TopoDS_Shape& shape) {
  TopoDS_Solid solid = TopoDS::Solid(shape);
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

NumberedSolids solids_of(const TopoDS_Shape& shape) {
  NumberedSolids result{list_of(shape, TopAbs_SOLID), {}};
  for (const TopoDS_Shape& face : list_of(shape, TopAbs_FACE))
    result.numbers.Bind(face, result.numbers.Extent() + 1);
  for (TopoDS_Shape& solid : result.solids) solid = right_way_out(solid);
  return result;
}

std::deque<Skin> skins_of(const NumberedSolids& solids, const ExecutionContext& context) {
  std::deque<Skin> result;
  for (const TopoDS_Shape& shape : solids.solids) {
    context.check();
    const TopoDS_Solid solid = right_way_out(shape);
    triangulate(solid, 1e-3 * std::sqrt(box_of(solid).SquareExtent()));
    result.emplace_back(solid, solids.numbers);
  }
  return result;
}

/// Points in the material, one behind each face.
std::vector<gp_Pnt> points_inside(const std::deque<Skin>& skins, const ExecutionContext& context) {
  std::vector<gp_Pnt> result;
  for (const Skin& skin : skins) {
    for (const SkinFace& face : skin.faces()) {
      context.check();
      for (const FaceSample& sample : face.samples(1)) {
        const auto outward = face.outward(sample.uv);
        const auto hit = outward ? skin.first_hit(sample.point, outward->Reversed()) : std::nullopt;
        if (!hit) continue;
        result.push_back(sample.point.Translated(0.5 * gp_Vec(sample.point, hit->point)));
        break;
      }
    }
  }
  return result;
}

/// Whether the solids contain all points. OpenCASCADE may lose solids where surfaces are nearly tangent.
bool hold(const std::deque<Skin>& skins, const std::vector<gp_Pnt>& points, const ExecutionContext& context) {
  return std::all_of(points.begin(), points.end(), [&](const gp_Pnt& point) {
    context.check();
    return std::any_of(skins.begin(), skins.end(), [&](const Skin& skin) { return skin.in_material(point); });
  });
}

NumberedSolids fused(const NumberedSolids& apart, const ExecutionContext& context) {
  TopTools_ListOfShape first, others;
  for (const TopoDS_Shape& solid : apart.solids) (first.IsEmpty() ? first : others).Append(solid);
  BRepAlgoAPI_Fuse fuse;
  fuse.SetArguments(first);
  fuse.SetTools(others);
  fuse.SetNonDestructive(Standard_True);
  under_limit(context, [&](const Message_ProgressRange& range) { fuse.Build(range); });
  if (fuse.HasErrors()) throw failure("", "the solids cannot be joined to one");
  NumberedSolids result{list_of(fuse.Shape(), TopAbs_SOLID), {}};
  for (TopTools_DataMapOfShapeInteger::Iterator it(apart.numbers); it.More(); it.Next()) {
    for (const TopoDS_Shape& part : images(fuse, it.Key())) {
      // Where two faces coincide the lower number counts, whatever the order of the map.
      if (!result.numbers.IsBound(part) || result.numbers.Find(part) > it.Value())
        result.numbers.Bind(part, it.Value());
    }
  }
  return result;
}

}  // namespace

std::deque<Skin> skins_of(const TopoDS_Shape& shape, bool join, const ExecutionContext& context) {
  NumberedSolids solids = solids_of(shape);
  std::deque<Skin> skins = skins_of(solids, context);
  if (!join || skins.size() < 2) return skins;
  const NumberedSolids fillers = fill_gaps(skins, context);
  for (const TopoDS_Shape& filler : fillers.solids) solids.solids.push_back(right_way_out(filler));
  for (TopTools_DataMapOfShapeInteger::Iterator it(fillers.numbers); it.More(); it.Next())
    solids.numbers.Bind(it.Key(), it.Value());
  std::deque<Skin> whole = skins_of(fused(solids, context), context);
  if (!hold(whole, points_inside(skins, context), context))
    throw failure("", "the solids cannot be joined to one");
  return whole;
}

}  // namespace quadrille
