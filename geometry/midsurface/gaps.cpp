/// Looks from each solid's faces for others near by, and sweeps or offsets faces into solids between them.

#include "geometry/midsurface/gaps.hpp"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomFill.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/fusing.hpp"
#include "geometry/midsurface/middle_geometry.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// A face of one of the solids, by indices.
struct FaceOf {
  int solid = 0, face = 0;
  friend auto operator<=>(const FaceOf&, const FaceOf&) = default;  // NOLINT(modernize-use-nullptr)
};

/// Measurements of another solid's face across a gap.
struct Across {
  double widest = 0;     ///< largest width of the gap
  double thickness = 0;  ///< least thickness of the two walls there
  double area = 0;       ///< area of the samples that face it
};

struct Gap {
  FaceOf from, to;
  std::optional<gp_Dir> along;  ///< direction across the gap; empty = along the normal at each point
  Across across;
  double share = 0;  ///< share of the area of `from` that faces `to`
};

bool is_flat(const SkinFace& face) {
  return face.surface().GetType() == GeomAbs_Plane;
}

/// A face and its neighbor at a point of their common edge.
struct Beside {
  double length = 0;    ///< length of the edge that the point represents
  gp_Vec own, outward;  ///< outward normals of the face and of its neighbor
};

/// At most a dozen points on the longest edges of a face: half way along each edge, and at two more places if
/// the face is curved.
std::vector<Beside> beside(const Skin& skin, const SkinFace& face) {
  std::vector<Beside> result;
  const auto places = is_flat(face) ? std::vector<double>{0.5} : std::vector<double>{0.2, 0.5, 0.9};
  for (const auto& [edge, other] : skin.neighbors(face)) {
    for (const double place : places) {
      const gp_Pnt at = point_at(edge, place);
      const auto own = face.outward_at(at), outward = skin.faces()[other].outward_at(at);
      if (own && outward)
        result.push_back({length_of(edge) / static_cast<double>(places.size()), *own, *outward});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Beside& a, const Beside& b) { return a.length > b.length; });
  constexpr std::size_t longest_kept = 12;
  if (result.size() > longest_kept) result.resize(longest_kept);
  return result;
}

/// The direction in which the neighbors of a face would continue past it.
struct RunningOn {
  gp_Dir along;      ///< direction that fits most of the border; the face's normal if no other fits better
  double share = 0;  ///< share of the border that it fits
};

RunningOn running_on(const std::vector<Beside>& around, const gp_Dir& outward) {
  const gp_Vec normal(outward);
  gp_Vec best = normal;
  double most = 0, whole = 0;
  for (const Beside& side : around) whole += side.length;
  const auto attempt = [&](gp_Vec along) {
    if (along.Magnitude() < 0.1) return;
    along.Normalize();
    if (along.Dot(normal) < 0) along.Reverse();
    double length = 0;
    for (const Beside& side : around) length += std::abs(side.outward.Dot(along)) < 1e-4 ? side.length : 0;
    if (along.Dot(normal) < 0.5 || length <= (1 + 1e-6) * most) return;
    most = length;
    best = along;
  };
  attempt(normal);
  for (std::size_t i = 0; i < around.size(); ++i) {
    attempt(normal - normal.Dot(around[i].outward) * around[i].outward);
    for (std::size_t j = 0; j < i; ++j) attempt(around[i].outward.Crossed(around[j].outward));
  }
  return {best, whole > 0 ? most / whole : 0};
}

/// Whether the neighbors of a face would continue along its normals, on at least nine tenths of the border.
bool runs_on_along_normals(const std::vector<Beside>& around) {
  double all = 0, runs = 0;
  for (const Beside& side : around) {
    all += side.length;
    if (std::abs(side.outward.Dot(side.own)) < 1e-4) runs += side.length;
  }
  return runs >= 0.9 * all;
}

/// Cuts a face in two, so that no edge of the halves is closed. Empty if its surface has no local axes.
std::list<BRepAlgoAPI_Common> halves(const SkinFace& face, const ExecutionContext& context) {
  std::list<BRepAlgoAPI_Common> result;  // a list, since its elements must not be copied
  const auto frame = frame_of(face.surface());
  if (!frame) return result;
  const gp_Vec axis(frame->Direction());
  const double reach = frame->Location().Distance(face.point(face.samples(1).front().uv)) +
                       2 * std::sqrt(face.box().SquareExtent());
  for (const double side : {-1.0, 1.0}) {
    const gp_Vec away = side * gp_Vec(frame->XDirection());
    const gp_Pnt corner = frame->Location().Translated(-reach * (axis + axis.Crossed(away)));
    const gp_Ax2 place(corner, frame->Direction(), away);
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(place, reach, 2 * reach, 2 * reach).Solid();
    under_limit(context,
                [&](const Message_ProgressRange& range) { result.emplace_back(face.face(), box, range); });
    if (result.back().HasErrors()) return {};
  }
  return result;
}

/// A face offset along its normals: the same parametric curves on the offset surface.
class OffsetFace {
 public:
  OffsetFace(const TopoDS_Face& face, double distance) : face_(face) {
    const double along = face.Orientation() == TopAbs_REVERSED ? -distance : distance;
    const Handle(Geom_OffsetSurface) offset = new Geom_OffsetSurface(BRep_Tool::Surface(face), along);
    surface_ = offset->Surface();
    if (surface_.IsNull()) surface_ = offset;
  }

  TopoDS_Edge edge(const TopoDS_Edge& edge) const {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face_, first, last);
    TopoDS_Edge result = BRepBuilderAPI_MakeEdge(curve, surface_, first, last).Edge();
    BRepLib::BuildCurve3d(result);
    result.Orientation(edge.Orientation());
    return result;
  }

  TopoDS_Face face() const {
    const TopoDS_Wire outer = BRepTools::OuterWire(face_);
    const auto moved = [&](const TopoDS_Wire& old) {
      BRepBuilderAPI_MakeWire wire;
      for (BRepTools_WireExplorer it(old, face_); it.More(); it.Next()) wire.Add(edge(it.Current()));
      return wire.Wire();
    };
    BRepBuilderAPI_MakeFace result(surface_, moved(outer));
    for (TopExp_Explorer it(face_, TopAbs_WIRE); it.More(); it.Next())
      if (!it.Current().IsSame(outer)) result.Add(moved(TopoDS::Wire(it.Current())));
    return result.Face();
  }

 private:
  TopoDS_Face face_;
  Handle(Geom_Surface) surface_;
};

/// The ruled face between two edges with the same parameters; on a plane if possible.
TopoDS_Face ruled_face(const TopoDS_Edge& a, const TopoDS_Edge& b) {
  std::array<Handle(Geom_Curve), 2> curves;
  std::array<gp_Pnt, 4> ends;
  for (int side = 0; side < 2; ++side) {
    double first = 0, last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(side == 0 ? a : b, first, last);
    curves[side] = new Geom_TrimmedCurve(curve, first, last);
    ends[2 * side] = curve->Value(first);
    ends[2 * side + 1] = curve->Value(last);
  }
  BRepBuilderAPI_MakeWire border(a);
  border.Add(BRepBuilderAPI_MakeEdge(ends[0], ends[2]));
  border.Add(BRepBuilderAPI_MakeEdge(ends[1], ends[3]));
  border.Add(b);
  if (border.IsDone()) {
    BRepBuilderAPI_MakeFace flat(border.Wire(), Standard_True);
    if (flat.IsDone()) return flat;
  }
  return BRepBuilderAPI_MakeFace(GeomFill::Surface(curves[0], curves[1]), Precision::Confusion());
}

/// Adds the solid between two distances along a face's normals. \param numbers by edge, for the sides; other
/// sides and the two ends get `own`. \return false if the face has a pole or its parts cannot be sewn to a
/// closed solid.
bool add_thick_face(const TopoDS_Face& face, double from, double to,
                    const TopTools_DataMapOfShapeInteger& numbers, int own, const ExecutionContext& context,
                    NumberedSolids& result) {
  const OffsetFace start(face, from), end(face, to);
  std::vector<std::pair<TopoDS_Shape, int>> parts{{start.face(), own}, {end.face(), own}};
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) return false;
    parts.emplace_back(ruled_face(start.edge(edge), end.edge(edge)),
                       numbers.IsBound(edge) ? numbers.Find(edge) : own);
  }
  BRepBuilderAPI_Sewing sewing(1e-5 * std::abs(to - from));
  for (const auto& [part, number] : parts) sewing.Add(part);
  under_limit(context, [&](const Message_ProgressRange& range) { sewing.Perform(range); });
  if (sewing.SewedShape().ShapeType() != TopAbs_SHELL) return false;
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape()));
  if (!BRepLib::OrientClosedSolid(solid)) return false;
  result.solids.push_back(solid);
  for (const auto& [part, number] : parts) result.numbers.Bind(sewing.Modified(part), number);
  return true;
}

/// Looks from the faces of each solid toward the other solids.
class GapFinder {
 public:
  GapFinder(const std::deque<Skin>& solids, const ExecutionContext& context)
      : solids_(solids), context_(context) {}

  const SkinFace& face(const FaceOf& of) const { return solids_[of.solid].faces()[of.face]; }

  /// Adds the gaps in front of a face that are narrow enough.
  void add_gaps(const FaceOf& from, std::vector<Gap>& gaps) const {
    context_.check();
    const std::vector<int> others = solids_near(from);
    const auto samples = others.empty() ? std::vector<FaceSample>() : face(from).samples(24);
    if (samples.empty()) return;
    const auto straight = straight_on(from, samples);
    if (!straight && !goes_on(from)) return;
    std::map<FaceOf, Across> seen;
    double area = 0;
    for (const FaceSample& sample : samples) {
      area += sample.area;
      const auto along = straight ? straight : face(from).outward(sample.uv);
      // A straight end may meet a slanted face; sides must be nearly parallel.
      if (along) look(from, others, sample, *along, straight ? 0.5 : std::cos(30 * M_PI / 180), seen);
    }
    for (const auto& [to, across] : seen) gaps.push_back({from, to, straight, across, across.area / area});
  }

  /// Whether a gap is the crevice beside a contact: one of its faces is curved and tangent to the other at
  /// its edge. So the outside of a bend leaves the plate on which the bent sheet lies.
  bool is_crevice(const Gap& gap) const {
    return leaves_contact(gap.from, gap.to) || leaves_contact(gap.to, gap.from);
  }

  /// The direction in which to extend a flat face, or the curved end of a straight part, such as a tube that
  /// was cut to fit around another.
  std::optional<gp_Dir> straight_on(const FaceOf& from, const std::vector<FaceSample>& samples) const {
    const auto outward = face(from).outward(samples.front().uv);
    if (!outward || (!is_flat(face(from)) && goes_on(from))) return std::nullopt;
    const RunningOn on = running_on(beside(solids_[from.solid], face(from)), *outward);
    if (is_flat(face(from))) return on.along;
    const bool ahead = std::all_of(samples.begin(), samples.end(), [&](const FaceSample& sample) {
      const auto normal = face(from).outward(sample.uv);
      return normal && normal->Dot(on.along) > 0.3;
    });
    return on.share > 0.9 && ahead ? std::optional(on.along) : std::nullopt;
  }

  /// The whole solid of a face, moved. This extends a straight part.
  NumberedSolids moved(const FaceOf& of, const gp_Vec& way) const {
    gp_Trsf move;
    move.SetTranslation(way);
    BRepBuilderAPI_Transform moved(solids_[of.solid].solid(), move, Standard_True);
    NumberedSolids result{{moved.Shape()}, {}};
    for (const SkinFace& face : solids_[of.solid].faces())
      result.numbers.Bind(moved.ModifiedShape(face.face()), face.number());
    return result;
  }

  /// Whether a face can be extended so that its part continues: flat faces straight, curved ones along their
  /// normals. This suits curved sides of walls, and rims whose neighbors follow the normals, as at a hole in
  /// a plate. It does not suit the end of a tube that was cut to fit around another.
  bool goes_on(const FaceOf& of) const {
    if (is_flat(face(of))) return true;
    const auto samples = face(of).samples(1);
    return !samples.empty() && (thickness_at(of, samples.front().uv) < face(of).width() ||
                                runs_on_along_normals(beside(solids_[of.solid], face(of))));
  }

  /// Sweeps a face, starting at a depth inside the material, over a length outward: along a direction, or in
  /// several parts along its normals. Empty if that fails.
  NumberedSolids drawn(const FaceOf& of, const std::optional<gp_Dir>& along, double depth,
                       double length) const {
    if (!along) return thickened(of, depth, length);
    gp_Trsf move;
    move.SetTranslation(-depth * gp_Vec(*along));
    BRepBuilderAPI_Transform moved(face(of).face(), move, Standard_True);
    BRepPrimAPI_MakePrism prism(moved.Shape(), length * gp_Vec(*along));
    NumberedSolids result{{prism.Shape()}, {}};
    for (const auto& [edge, beside] : solids_[of.solid].neighbors(face(of))) {
      for (const TopoDS_Shape& side : prism.Generated(moved.ModifiedShape(edge)))
        result.numbers.Bind(side, face({of.solid, beside}).number());
    }
    for (const TopoDS_Shape& end : {prism.FirstShape(), prism.LastShape()})
      result.numbers.Bind(end, face(of).number());
    return result;
  }

 private:
  /// The thickness of a wall at a point of its skin: through the material, but at most the width of the face.
  double thickness_at(const FaceOf& of, const gp_Pnt2d& uv) const {
    const auto outward = face(of).outward(uv);
    if (!outward) return 0;
    const auto hit = solids_[of.solid].first_hit(face(of).point(uv), outward->Reversed());
    return hit ? std::min(face(of).width(), hit->distance) : face(of).width();
  }

  /// drawn() along the normals.
  NumberedSolids thickened(const FaceOf& of, double depth, double length) const {
    NumberedSolids result;
    for (BRepAlgoAPI_Common& half : halves(face(of), context_)) {
      TopTools_DataMapOfShapeInteger numbers;
      for (const auto& [edge, beside] : solids_[of.solid].neighbors(face(of))) {
        for (const TopoDS_Shape& part : images(half, edge))
          numbers.Bind(part, face({of.solid, beside}).number());
      }
      for (TopExp_Explorer it(half.Shape(), TopAbs_FACE); it.More(); it.Next()) {
        if (!add_thick_face(TopoDS::Face(it.Current()), -depth, length - depth, numbers, face(of).number(),
                            context_, result))
          return {};
      }
    }
    return result;
  }

  /// Whether a curved face is tangent to the other one at an edge.
  bool leaves_contact(const FaceOf& rounded, const FaceOf& other) const {
    if (is_flat(face(rounded))) return false;
    const double near = 1e-6 * solids_[rounded.solid].size();
    for (const TopoDS_Edge& edge : edges_of(face(rounded).face())) {
      const gp_Pnt at = point_at(edge, 0.5);
      if (face(other).distance(at) > near) continue;
      const auto own = face(rounded).outward_at(at), opposite = face(other).outward_at(at);
      if (own && opposite && own->Dot(*opposite) < -0.9999) return true;
    }
    return false;
  }

  /// The other solids near a face.
  std::vector<int> solids_near(const FaceOf& from) const {
    Bnd_Box box = face(from).box();
    box.Enlarge(2 * face(from).width());  // no gap is wider, not even at a slant
    std::vector<int> result;
    for (int other = 0; other < static_cast<int>(solids_.size()); ++other) {
      const auto& faces = solids_[other].faces();
      const auto is_near = [&](const SkinFace& face) { return !box.IsOut(face.box()); };
      if (other != from.solid && std::any_of(faces.begin(), faces.end(), is_near)) result.push_back(other);
    }
    return result;
  }

  /// Records the face that is met from a sample. \param facing least cosine of `along` and its inward normal.
  void look(const FaceOf& from, const std::vector<int>& others, const FaceSample& sample, const gp_Dir& along,
            double facing, std::map<FaceOf, Across>& seen) const {
    const auto own = solids_[from.solid].first_hit(sample.point, along);
    std::optional<Skin::Hit> nearest;
    FaceOf to;
    for (const int other : others) {
      const auto hit = solids_[other].first_hit(sample.point, along);
      if (!hit || (own && own->distance < hit->distance) || (nearest && nearest->distance <= hit->distance))
        continue;
      nearest = hit;
      to = {other, hit->face};
    }
    if (!nearest) return;
    const auto opposite = face(to).outward(nearest->uv);
    if (!opposite || opposite->Dot(along) > -facing) return;  // met from inside, or grazed
    const double thickness = std::min(thickness_at(from, sample.uv), thickness_at(to, nearest->uv));
    if (nearest->distance > thickness) return;
    Across& across = seen[to];
    across.widest = std::max(across.widest, nearest->distance);
    across.thickness = across.area > 0 ? std::min(across.thickness, thickness) : thickness;
    across.area += sample.area;
  }

  const std::deque<Skin>& solids_;
  const ExecutionContext& context_;
};

/// The narrow gaps, one for each pair of faces, seen from the face of which the larger share faces the other.
std::vector<Gap> find_gaps(const std::deque<Skin>& solids, const GapFinder& finder) {
  std::vector<Gap> gaps;
  for (int solid = 0; solid < static_cast<int>(solids.size()); ++solid) {
    for (int face = 0; face < static_cast<int>(solids[solid].faces().size()); ++face)
      finder.add_gaps({solid, face}, gaps);
  }
  std::erase_if(gaps, [&](const Gap& gap) { return finder.is_crevice(gap); });
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.share > b.share; });
  std::set<std::pair<FaceOf, FaceOf>> closed;
  std::erase_if(gaps, [&](const Gap& gap) { return !closed.insert(std::minmax(gap.from, gap.to)).second; });
  return gaps;
}

/// Numbers a face, unless it has a number.
void number_once(const TopoDS_Shape& face, int as, NumberedSolids& solids) {
  if (!solids.numbers.IsBound(face)) solids.numbers.Bind(face, as);
}

/// Adds the common parts of two solids at a time.
void add_common(const NumberedSolids& first, const NumberedSolids& second, const ExecutionContext& context,
                NumberedSolids& fillers) {
  for (const TopoDS_Shape& b : second.solids) {
    for (const TopoDS_Shape& a : first.solids) {
      std::optional<BRepAlgoAPI_Common> common;
      under_limit(context, [&](const Message_ProgressRange& range) { common.emplace(a, b, range); });
      if (common->HasErrors()) continue;  // reported later as parts that are not connected
      for (const TopoDS_Shape& solid : list_of(common->Shape(), TopAbs_SOLID))
        fillers.solids.push_back(solid);
      for (const NumberedSolids* drawn : {&first, &second}) {
        for (TopTools_DataMapOfShapeInteger::Iterator it(drawn->numbers); it.More(); it.Next())
          for (const TopoDS_Shape& part : images(*common, it.Key())) number_once(part, it.Value(), fillers);
      }
    }
  }
}

}  // namespace

NumberedSolids fill_gaps(const std::deque<Skin>& solids, const ExecutionContext& context) {
  constexpr double into = 0.25;  // over the thickness; surfaces that only touch are harder to fuse
  constexpr double all = 0.999;
  const GapFinder finder(solids, context);
  NumberedSolids result;
  std::set<std::pair<int, FaceOf>> moved;
  for (const Gap& gap : find_gaps(solids, finder)) {
    context.check();
    const double depth = into * gap.across.thickness, length = gap.across.widest + depth;
    const bool flat = is_flat(finder.face(gap.from));
    NumberedSolids parts;
    if (flat || !gap.along)
      parts = finder.drawn(gap.from, gap.along, 0, length);
    else if (moved.insert({gap.from.solid, gap.to}).second)  // an end may have several faces
      parts = finder.moved(gap.from, length * gp_Vec(*gap.along));
    if (flat && (gap.share > all || !is_flat(finder.face(gap.to)))) {
      result.solids.push_back(parts.solids.front());
      for (TopTools_DataMapOfShapeInteger::Iterator it(parts.numbers); it.More(); it.Next())
        number_once(it.Key(), it.Value(), result);
    } else if (finder.goes_on(gap.to)) {
      const auto back = flat ? std::optional(gap.along->Reversed()) : std::nullopt;
      add_common(parts, finder.drawn(gap.to, back, depth, 2 * length), context, result);
    }
  }
  return result;
}

}  // namespace quadrille
