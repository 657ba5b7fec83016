#include "geometry/midsurface/gaps.hpp"

#include <BRepAdaptor_Curve.hxx>
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
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomFill.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Solid.hxx>
#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

using Neighbors = TopTools_IndexedDataMapOfShapeListOfShape;

/// A face of one of the solids.
struct FaceOf {
  int solid = 0, face = 0;
  bool operator<(const FaceOf& other) const {
    return solid != other.solid ? solid < other.solid : face < other.face;
  }
};

/// A face drawn along a way, and the numbers of the faces that the solid's sides carry on.
struct DrawnFace {
  TopoDS_Shape solid;
  std::vector<std::pair<TopoDS_Shape, int>> numbers;
};

/// What was seen of another solid's face across a gap.
struct Across {
  double widest = 0;     ///< of the gap
  double thickness = 0;  ///< of the thinner of the two walls there
  double area = 0;       ///< of the samples that face it
};

struct Gap {
  FaceOf from, to;
  std::optional<gp_Dir> along;  ///< the way across; each point's own normal where there is none
  Across across;
  double share = 0;  ///< of the first face that faces the other
};

/// How thick a wall is at a point of its skin: into the material, or the width of a rim.
double thickness_at(const Skin& skin, const SkinFace& face, double width, const gp_Pnt2d& uv) {
  const auto outward = face.outward(uv);
  if (!outward) return 0;
  const auto hit = skin.first_hit(face.point(uv), outward->Reversed());
  return hit ? std::min(width, hit->distance) : width;
}

bool is_flat(const SkinFace& face) {
  return face.surface().GetType() == GeomAbs_Plane;
}

/// What stands beside a face at a point of its border.
struct Beside {
  double length = 0;    ///< of the border that the point stands for
  gp_Vec own, outward;  ///< of the face, and of what stands beside it
};

/// Along the longest edges of a face, a dozen points at most; half way along each, and of bent faces at two
/// more.
std::vector<Beside> beside(const Skin& skin, const Neighbors& neighbors, const SkinFace& face) {
  std::vector<Beside> result;
  const auto places = is_flat(face) ? std::vector<double>{0.5} : std::vector<double>{0.2, 0.5, 0.9};
  for (TopExp_Explorer it(face.face(), TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    for (const TopoDS_Shape& next : neighbors.FindFromKey(edge)) {
      if (next.IsSame(face.face())) continue;
      const SkinFace& other = skin.faces()[skin.index_of(TopoDS::Face(next))];
      for (const double place : places) {
        const gp_Pnt at = curve.Value((1 - place) * curve.FirstParameter() + place * curve.LastParameter());
        const auto own = face.outward(face.closest(at)), outward = other.outward(other.closest(at));
        if (own && outward)
          result.push_back(
              {length_of(edge) / static_cast<double>(places.size()), gp_Vec(*own), gp_Vec(*outward)});
      }
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Beside& a, const Beside& b) { return a.length > b.length; });
  constexpr std::size_t enough = 12;
  if (result.size() > enough) result.resize(enough);
  return result;
}

/// The direction in which what stands beside a face runs on past it.
struct RunningOn {
  gp_Dir along;  ///< for most of the border; the normal that was given where nothing speaks for another one
  double share = 0;  ///< of the border
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

/// Whether what stands beside a face runs on past it along the face's normals, but for a tenth of the border.
bool runs_on_along_normals(const std::vector<Beside>& around) {
  double all = 0, runs = 0;
  for (const Beside& side : around) {
    all += side.length;
    if (std::abs(side.outward.Dot(side.own)) < 1e-4) runs += side.length;
  }
  return runs >= 0.9 * all;
}

/// The axes of a surface that closes in itself.
std::optional<gp_Ax3> frame_of(const BRepAdaptor_Surface& surface) {
  switch (surface.GetType()) {
    case GeomAbs_Plane:
      return surface.Plane().Position();
    case GeomAbs_Cylinder:
      return surface.Cylinder().Position();
    case GeomAbs_Cone:
      return surface.Cone().Position();
    case GeomAbs_Sphere:
      return surface.Sphere().Position();
    case GeomAbs_Torus:
      return surface.Torus().Position();
    default:
      return std::nullopt;
  }
}

/// A face in two halves, so that no edge of them is closed. Empty where it is not known how to cut it.
std::list<BRepAlgoAPI_Common> halves(const SkinFace& face) {
  std::list<BRepAlgoAPI_Common> result;  // which must not be copied
  const auto frame = frame_of(face.surface());
  if (!frame) return result;
  const gp_Vec axis(frame->Direction());
  const double reach = frame->Location().Distance(face.point(face.samples(1).front().uv)) +
                       2 * std::sqrt(face.box().SquareExtent());
  for (const double side : {-1.0, 1.0}) {
    const gp_Vec away = side * gp_Vec(frame->XDirection());
    const gp_Pnt corner = frame->Location().Translated(-reach * (axis + axis.Crossed(away)));
    const gp_Ax2 place(corner, frame->Direction(), away);
    result.emplace_back(face.face(), BRepPrimAPI_MakeBox(place, reach, 2 * reach, 2 * reach).Solid());
    if (result.back().HasErrors()) return {};
  }
  return result;
}

/// What lies a distance from a face, along its normals: the same borders on its surface, moved.
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
    std::optional<BRepBuilderAPI_MakeFace> result;
    const TopoDS_Wire outer = BRepTools::OuterWire(face_);
    const auto add = [&](const TopoDS_Wire& old) {
      BRepBuilderAPI_MakeWire wire;
      for (BRepTools_WireExplorer it(old, face_); it.More(); it.Next()) wire.Add(edge(it.Current()));
      if (result)
        result->Add(wire.Wire());
      else
        result.emplace(surface_, wire.Wire());
    };
    add(outer);
    for (TopExp_Explorer it(face_, TopAbs_WIRE); it.More(); it.Next())
      if (!it.Current().IsSame(outer)) add(TopoDS::Wire(it.Current()));
    return result->Face();
  }

 private:
  TopoDS_Face face_;
  Handle(Geom_Surface) surface_;
};

/// The face of straight lines between two edges that have the same parameters; a plane where it can be.
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

/// The solid between two distances from a face, along its normals. \param numbers of its edges; the sides on
/// others and the two ends have the number `own`. Null where the face has a pole.
DrawnFace thick_face(const TopoDS_Face& face, double from, double to,
                     const TopTools_DataMapOfShapeInteger& numbers, int own) {
  const OffsetFace start(face, from), end(face, to);
  std::vector<std::pair<TopoDS_Shape, int>> parts{{start.face(), own}, {end.face(), own}};
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) return {};
    parts.emplace_back(ruled_face(start.edge(edge), end.edge(edge)),
                       numbers.IsBound(edge) ? numbers.Find(edge) : own);
  }
  BRepBuilderAPI_Sewing sewing(1e-5 * std::abs(to - from));
  for (const auto& [part, number] : parts) sewing.Add(part);
  sewing.Perform();
  if (sewing.SewedShape().ShapeType() != TopAbs_SHELL) return {};
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape()));
  if (!BRepLib::OrientClosedSolid(solid)) return {};
  DrawnFace result{solid, {}};
  for (const auto& [part, number] : parts) result.numbers.emplace_back(sewing.Modified(part), number);
  return result;
}

/// Looks from faces at the other solids.
class Outlook {
 public:
  explicit Outlook(const std::deque<Skin>& solids) : solids_(solids) {
    for (const Skin& skin : solids) {
      widths_.emplace_back();
      for (const SkinFace& face : skin.faces()) widths_.back().push_back(width_of(face.face()));
      neighbors_.emplace_back();
      TopExp::MapShapesAndAncestors(skin.solid(), TopAbs_EDGE, TopAbs_FACE, neighbors_.back());
    }
  }

  const SkinFace& face(const FaceOf& of) const { return solids_[of.solid].faces()[of.face]; }

  /// Adds the gaps before a face that are narrow enough.
  void add_gaps(const FaceOf& from, std::vector<Gap>& gaps) const {
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
      // Straight ends may meet what leans; sides are near each other all along.
      if (along) look(from, others, sample, *along, straight ? 0.5 : std::cos(30 * M_PI / 180), seen);
    }
    for (const auto& [to, across] : seen) gaps.push_back({from, to, straight, across, across.area / area});
  }

  /// The way on from a flat face, and from the bent end of what runs straight, such as a tube that was cut to
  /// fit round another.
  std::optional<gp_Dir> straight_on(const FaceOf& from, const std::vector<FaceSample>& samples) const {
    const auto outward = face(from).outward(samples.front().uv);
    if (!outward || (!is_flat(face(from)) && goes_on(from))) return std::nullopt;
    const RunningOn on =
        running_on(beside(solids_[from.solid], neighbors_[from.solid], face(from)), *outward);
    if (is_flat(face(from))) return on.along;
    const bool ahead = std::all_of(samples.begin(), samples.end(), [&](const FaceSample& sample) {
      const auto normal = face(from).outward(sample.uv);
      return normal && normal->Dot(on.along) > 0.3;
    });
    return on.share > 0.9 && ahead ? std::optional(on.along) : std::nullopt;
  }

  /// The whole solid of a face, moved: what runs straight there goes on so.
  DrawnFace moved(const FaceOf& of, const gp_Vec& way) const {
    gp_Trsf move;
    move.SetTranslation(way);
    BRepBuilderAPI_Transform moved(solids_[of.solid].solid(), move, Standard_True);
    DrawnFace result{moved.Shape(), {}};
    for (const SkinFace& face : solids_[of.solid].faces())
      result.numbers.emplace_back(moved.ModifiedShape(face.face()), face.number());
    return result;
  }

  /// Whether more material before a face carries on what is there. Flat faces go on straight, bent ones along
  /// their normals: sides of walls do so, and rims round which the sides do, as of a hole in a plate; not
  /// that of a tube which was cut to fit round another.
  bool goes_on(const FaceOf& of) const {
    if (is_flat(face(of))) return true;
    const auto samples = face(of).samples(1);
    const double width = widths_[of.solid][of.face];
    return !samples.empty() &&
           (thickness_at(solids_[of.solid], face(of), width, samples.front().uv) < width ||
            runs_on_along_normals(beside(solids_[of.solid], neighbors_[of.solid], face(of))));
  }

  /// A face, moved into the material by a depth and drawn out of it again and on: along a way, or in several
  /// parts along its normals. Empty where it cannot be drawn.
  std::vector<DrawnFace> drawn(const FaceOf& of, const std::optional<gp_Dir>& along, double depth,
                               double length) const {
    if (!along) return thickened(of, depth, length);
    return {drawn_along(of, -depth * gp_Vec(*along), length * gp_Vec(*along))};
  }

 private:
  DrawnFace drawn_along(const FaceOf& of, const gp_Vec& start, const gp_Vec& way) const {
    gp_Trsf move;
    move.SetTranslation(start);
    BRepBuilderAPI_Transform moved(face(of).face(), move, Standard_True);
    BRepPrimAPI_MakePrism prism(moved.Shape(), way);
    DrawnFace result{prism.Shape(), {}};
    for_each_neighbor(of, [&](const TopoDS_Edge& edge, int number) {
      for (const TopoDS_Shape& side : prism.Generated(moved.ModifiedShape(edge)))
        result.numbers.emplace_back(side, number);
    });
    result.numbers.emplace_back(prism.FirstShape(), face(of).number());
    result.numbers.emplace_back(prism.LastShape(), face(of).number());
    return result;
  }

  /// Along the normals.
  std::vector<DrawnFace> thickened(const FaceOf& of, double depth, double length) const {
    std::vector<DrawnFace> result;
    for (BRepAlgoAPI_Common& half : halves(face(of))) {
      TopTools_DataMapOfShapeInteger numbers;
      for_each_neighbor(of, [&](const TopoDS_Edge& edge, int number) {
        TopTools_ListOfShape parts = half.Modified(edge);
        if (parts.IsEmpty()) parts.Append(edge);
        for (const TopoDS_Shape& part : parts) numbers.Bind(part, number);
      });
      for (TopExp_Explorer it(half.Shape(), TopAbs_FACE); it.More(); it.Next()) {
        result.push_back(
            thick_face(TopoDS::Face(it.Current()), -depth, length - depth, numbers, face(of).number()));
        if (result.back().solid.IsNull()) return {};
      }
    }
    return result;
  }

  /// Tells the edges of a face and the numbers of the faces beside it there.
  template <class Tell>
  void for_each_neighbor(const FaceOf& of, const Tell& tell) const {
    const Skin& skin = solids_[of.solid];
    for (TopExp_Explorer it(face(of).face(), TopAbs_EDGE); it.More(); it.Next()) {
      for (const TopoDS_Shape& beside : neighbors_[of.solid].FindFromKey(it.Current())) {
        if (!beside.IsSame(face(of).face()))
          tell(TopoDS::Edge(it.Current()), skin.faces()[skin.index_of(TopoDS::Face(beside))].number());
      }
    }
  }

  /// The solids that come near a face.
  std::vector<int> solids_near(const FaceOf& from) const {
    Bnd_Box box = face(from).box();
    box.Enlarge(2 * widths_[from.solid][from.face]);  // no gap is wider, along a normal or aslant
    std::vector<int> result;
    for (int other = 0; other < static_cast<int>(solids_.size()); ++other) {
      const auto& faces = solids_[other].faces();
      const auto is_near = [&](const SkinFace& face) { return !box.IsOut(face.box()); };
      if (other != from.solid && std::any_of(faces.begin(), faces.end(), is_near)) result.push_back(other);
    }
    return result;
  }

  /// \param facing least cosine between the way along and the normal of what is seen.
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
    const double thickness =
        std::min(thickness_at(solids_[from.solid], face(from), widths_[from.solid][from.face], sample.uv),
                 thickness_at(solids_[to.solid], face(to), widths_[to.solid][to.face], nearest->uv));
    if (nearest->distance > thickness) return;
    Across& across = seen[to];
    across.widest = std::max(across.widest, nearest->distance);
    across.thickness = across.area > 0 ? std::min(across.thickness, thickness) : thickness;
    across.area += sample.area;
  }

  const std::deque<Skin>& solids_;
  std::vector<std::vector<double>> widths_;  ///< of each face of each solid
  std::vector<Neighbors> neighbors_;
};

/// The narrow gaps, one for two faces: from the one that faces the other with the larger share of it.
std::vector<Gap> find_gaps(const std::deque<Skin>& solids, const Outlook& outlook) {
  std::vector<Gap> gaps;
  for (int solid = 0; solid < static_cast<int>(solids.size()); ++solid) {
    for (int face = 0; face < static_cast<int>(solids[solid].faces().size()); ++face)
      outlook.add_gaps({solid, face}, gaps);
  }
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.share > b.share; });
  std::set<std::pair<FaceOf, FaceOf>> closed;
  std::erase_if(gaps, [&](const Gap& gap) { return !closed.insert(std::minmax(gap.from, gap.to)).second; });
  return gaps;
}

void add(const DrawnFace& prism, GapFillers& fillers) {
  fillers.solids.push_back(prism.solid);
  for (const auto& [face, number] : prism.numbers) {
    if (!fillers.numbers.IsBound(face)) fillers.numbers.Bind(face, number);
  }
}

/// What two prisms have in common.
void add_common(const DrawnFace& a, const DrawnFace& b, GapFillers& fillers) {
  BRepAlgoAPI_Common common(a.solid, b.solid);
  if (common.HasErrors()) return;  // told as parts that are not connected
  for (TopExp_Explorer it(common.Shape(), TopAbs_SOLID); it.More(); it.Next())
    fillers.solids.push_back(it.Current());
  for (const DrawnFace& prism : {a, b}) {
    for (const auto& [face, number] : prism.numbers) {
      TopTools_ListOfShape parts = common.Modified(face);
      if (parts.IsEmpty()) parts.Append(face);
      for (const TopoDS_Shape& part : parts) {
        if (!fillers.numbers.IsBound(part)) fillers.numbers.Bind(part, number);
      }
    }
  }
}

}  // namespace

GapFillers fill_gaps(const std::deque<Skin>& solids) {
  constexpr double into = 0.25;  // of the thickness: surfaces that only touch are harder to fuse
  constexpr double all = 0.999;
  const Outlook outlook(solids);
  GapFillers result;
  std::set<std::pair<int, FaceOf>> moved;
  for (const Gap& gap : find_gaps(solids, outlook)) {
    const double depth = into * gap.across.thickness, length = gap.across.widest + depth;
    const bool flat = is_flat(outlook.face(gap.from));
    std::vector<DrawnFace> parts;
    if (flat || !gap.along)
      parts = outlook.drawn(gap.from, gap.along, 0, length);
    else if (moved.insert({gap.from.solid, gap.to}).second)  // an end may have several faces
      parts.push_back(outlook.moved(gap.from, length * gp_Vec(*gap.along)));
    if (flat && (gap.share > all || !is_flat(outlook.face(gap.to)))) {
      add(parts.front(), result);
    } else if (outlook.goes_on(gap.to)) {
      const auto back = flat ? std::optional(gap.along->Reversed()) : std::nullopt;
      for (const DrawnFace& other : outlook.drawn(gap.to, back, depth, 2 * length)) {
        for (const DrawnFace& part : parts) add_common(part, other, result);
      }
    }
  }
  return result;
}

}  // namespace quadrille
