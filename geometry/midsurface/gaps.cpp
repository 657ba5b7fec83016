#include "geometry/midsurface/gaps.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
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
struct FacePrism {
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
  gp_Dir along;
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

/// What stands beside a face along one of its edges.
struct Beside {
  double length = 0;
  gp_Vec outward;
};

/// The longest edges of a face, a dozen at most.
std::vector<Beside> beside(const Skin& skin, const Neighbors& neighbors, const SkinFace& face) {
  std::vector<Beside> result;
  for (TopExp_Explorer it(face.face(), TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(it.Current());
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const gp_Pnt middle = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
    for (const TopoDS_Shape& next : neighbors.FindFromKey(edge)) {
      if (next.IsSame(face.face())) continue;
      const SkinFace& other = skin.faces()[skin.index_of(TopoDS::Face(next))];
      if (const auto outward = other.outward(other.closest(middle)))
        result.push_back({length_of(edge), gp_Vec(*outward)});
    }
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Beside& a, const Beside& b) { return a.length > b.length; });
  constexpr std::size_t enough = 12;
  if (result.size() > enough) result.resize(enough);
  return result;
}

/// The direction in which what stands beside a flat face runs on past it: most of it, measured along the
/// border; the face's normal where nothing speaks for another one.
gp_Dir running_on(const Skin& skin, const Neighbors& neighbors, const SkinFace& face) {
  const gp_Vec normal(*face.outward(face.samples(1).front().uv));
  const std::vector<Beside> around = beside(skin, neighbors, face);
  gp_Vec best = normal;
  double most = 0;
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
  return best;
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

  /// Adds the gaps before a flat face that are narrow enough.
  void add_gaps(const FaceOf& from, std::vector<Gap>& gaps) const {
    if (face(from).surface().GetType() != GeomAbs_Plane) return;
    const std::vector<int> others = solids_near(from);
    const auto samples = others.empty() ? std::vector<FaceSample>() : face(from).samples(24);
    if (samples.empty() || !face(from).outward(samples.front().uv)) return;
    const gp_Dir along = running_on(solids_[from.solid], neighbors_[from.solid], face(from));
    std::map<FaceOf, Across> seen;
    double area = 0;
    for (const FaceSample& sample : samples) {
      area += sample.area;
      look(from, others, sample, along, seen);
    }
    for (const auto& [to, across] : seen) gaps.push_back({from, to, along, across, across.area / area});
  }

  /// A face, moved, and drawn along a way.
  FacePrism drawn(const FaceOf& of, const gp_Vec& start, const gp_Vec& way) const {
    gp_Trsf move;
    move.SetTranslation(start);
    BRepBuilderAPI_Transform moved(face(of).face(), move, Standard_True);
    BRepPrimAPI_MakePrism prism(moved.Shape(), way);
    FacePrism result{prism.Shape(), {}};
    const auto number = [&](const TopoDS_Shape& side, int value) {
      result.numbers.emplace_back(side, value);
    };
    for (TopExp_Explorer it(face(of).face(), TopAbs_EDGE); it.More(); it.Next()) {
      for (const TopoDS_Shape& beside : neighbors_[of.solid].FindFromKey(it.Current())) {
        if (beside.IsSame(face(of).face())) continue;
        const Skin& skin = solids_[of.solid];
        for (const TopoDS_Shape& side : prism.Generated(moved.ModifiedShape(it.Current())))
          number(side, skin.faces()[skin.index_of(TopoDS::Face(beside))].number());
      }
    }
    number(prism.FirstShape(), face(of).number());
    number(prism.LastShape(), face(of).number());
    return result;
  }

 private:
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

  void look(const FaceOf& from, const std::vector<int>& others, const FaceSample& sample, const gp_Dir& along,
            std::map<FaceOf, Across>& seen) const {
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
    if (!opposite || opposite->Dot(along) > -0.5) return;  // met from inside, or grazed
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

void add(const FacePrism& prism, GapFillers& fillers) {
  fillers.solids.push_back(prism.solid);
  for (const auto& [face, number] : prism.numbers) {
    if (!fillers.numbers.IsBound(face)) fillers.numbers.Bind(face, number);
  }
}

/// What two prisms have in common.
void add_common(const FacePrism& a, const FacePrism& b, GapFillers& fillers) {
  BRepAlgoAPI_Common common(a.solid, b.solid);
  if (common.HasErrors()) return;  // told as parts that are not connected
  for (TopExp_Explorer it(common.Shape(), TopAbs_SOLID); it.More(); it.Next())
    fillers.solids.push_back(it.Current());
  for (const FacePrism& prism : {a, b}) {
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
  for (const Gap& gap : find_gaps(solids, outlook)) {
    const double depth = into * gap.across.thickness;
    const gp_Vec along(gap.along), way = (gap.across.widest + depth) * along;
    const FacePrism whole = outlook.drawn(gap.from, {}, way);
    if (gap.share > all || outlook.face(gap.to).surface().GetType() != GeomAbs_Plane)
      add(whole, result);
    else
      add_common(whole, outlook.drawn(gap.to, depth * along, -2 * way), result);
  }
  return result;
}

}  // namespace quadrille
