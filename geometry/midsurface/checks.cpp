/// Checks the middle surface of a solid against the solid: free edges, what is counted twice, thicknesses.

#include "geometry/midsurface/checks.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/midsurface/edge_uses.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

/// How far from the box of a face, over the thickness, its surface counts at a point: that may lie on the
/// other side of the wall and, below the skin of the plate on which the wall stands, past the end of the
/// face.
constexpr double reach = 1.5;

bool is_near(int face, const Wall& wall, const gp_Pnt& point) {
  return wall.face(face).box().Distance(Bnd_Box(point, point)) <= reach * wall.thickness;
}

/// Whether the point lies between the surfaces of a wall's sides, with a face of at least one side above or
/// below it. Where another wall stands on this one, the other side is interrupted.
bool between_sides(const Wall& wall, const gp_Pnt& point) {
  const auto [first, second] = distances_to_sides(wall, point, reach);
  if (first + second >= 1.05 * wall.thickness) return false;
  const std::vector<int> sides = both_sides(wall);
  return std::any_of(sides.begin(), sides.end(),
                     [&](int face) { return is_near(face, wall, point) && wall.face(face).foot(point); });
}

/// The walls other than its face's own on whose middle a point of a free edge lies: they should share the
/// edge. Nothing if it lies in no other wall, as it does where a rib's rim continues to the plate's middle.
std::optional<std::set<int>> halfway_in_others(const std::vector<Wall>& walls, int own, const gp_Pnt& point) {
  std::optional<std::set<int>> result;
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
    const Wall& other = walls[wall];
    if (wall == own || (!position_in(other, point) && !between_sides(other, point))) continue;
    if (!result) result.emplace();
    const auto [first, second] = distances_to_sides(other, point, reach);
    if (std::abs(first - second) < 0.02 * (first + second)) result->insert(wall);
  }
  return result;
}

/// Whether most of a face lies inside walls, as the riser of a step does. No free edge lies on a riser.
bool across_a_wall(const std::vector<Wall>& walls, const SkinFace& face) {
  double across = 0;
  for (const FaceSample& sample : face.samples(8)) {
    const auto holds = [&](const Wall& wall) { return position_in(wall, sample.point).has_value(); };
    if (std::any_of(walls.begin(), walls.end(), holds)) across += sample.area;
  }
  return across > 0.5 * face.area();
}

/// Whether the middle leaves the material through a side of the wall.
bool leaves_through(const Wall& wall, const Fan& fan) {
  const auto position = position_in(wall, fan.point);
  if (!position) return false;
  for (int side = 0; side < 2; ++side) {
    if (position->feet[side].Distance(fan.point) > 1e-3 * wall.thickness) continue;
    const auto outward = wall.face(position->faces[side]).outward_at(fan.point);
    return outward && gp_Vec(*outward).Dot(fan.away) > 0.5;
  }
  return false;
}

/// The numbers of the two faces of the solid that are nearest to a point, ascending; one where both are parts
/// of the same face. Linear in the faces, for points that a check has found wrong.
std::vector<int> nearest_faces(const Skin& skin, const gp_Pnt& point) {
  const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(point).Vertex();
  std::set<std::pair<double, int>> order;  // the nearest first
  for (const SkinFace& face : skin.faces()) {
    const BRepExtrema_DistShapeShape distance(face.face(), vertex);
    if (distance.IsDone() && distance.NbSolution() > 0) order.emplace(distance.Value(), face.number());
  }
  std::set<int> result;  // a face that was cut counts as one
  for (const auto& [distance, number] : order)
    if (result.size() < 2) result.insert(number);
  return {result.begin(), result.end()};
}

/// Whether the skin closes the wall `own` at a point of the skin: no material is behind the point, and it
/// does not lie on the side of another wall.
bool closes(const Skin& skin, const std::vector<Wall>& walls, const Fan& fan, int own) {
  const double step = 0.02 * walls[own].thickness;
  const gp_Pnt behind = fan.point.Translated(step * fan.away);
  if (skin.in_material(behind) && skin.faces_at(behind, 1e-3 * step).empty()) return false;
  return !leaves_through_side(walls, own, fan);
}

/// Whether an edge is at more than 30 degrees to the nearest side of a wall.
bool is_steep(const Wall& wall, const Fan& fan) {
  double nearest = HUGE_VAL;
  bool result = false;
  for (const int face : both_sides(wall)) {
    if (!is_near(face, wall, fan.point)) continue;
    const double distance = wall.face(face).distance(fan.point);
    const auto outward = wall.face(face).outward_at(fan.point);
    if (!outward || distance >= nearest) continue;
    nearest = distance;
    result = std::abs(fan.along.Dot(gp_Vec(*outward))) > 0.5;
  }
  return result;
}

/// Whether an edge runs through the thickness of another wall, as the rim of a rib does below the skin of its
/// plate, up to the plate's middle.
bool runs_across(const std::vector<Wall>& walls, const Fan& fan, int own) {
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
    if (wall == own) continue;
    const auto [first, second] = distances_to_sides(walls[wall], fan.point, reach);
    if (first + second < 1.05 * walls[wall].thickness && is_steep(walls[wall], fan)) return true;
  }
  return false;
}

/// Lists the faces of the solid that belong to no wall. \param accounted indices of those that do
void list_unpaired(const Skin& skin, const std::vector<Wall>& walls, const std::set<int>& accounted,
                   double thinnest, MidSurface& result) {
  // A face that was cut where solids were joined counts as one.
  std::set<int> numbers;
  for (const int face : accounted) numbers.insert(skin.faces()[face].number());
  for (const SkinFace& face : skin.faces()) {
    // Bevels, and strips that are left where solids were joined, belong to no wall.
    const bool narrow = face.width() < 0.5 * thinnest;
    if (numbers.count(face.number()) == 0 && !narrow && !across_a_wall(walls, face))
      result.unpaired.push_back(face.number());
  }
}

/// The area of the section that two half walls, which start at one edge, have in common. Negative where the
/// angle from one to the other is over half a turn: there the corner between them is missing.
double common_section(double angle, double first, double second) {
  const double sine = std::sin(angle);
  if (std::abs(sine) < 0.15) return 0;  // they continue each other
  return (first * second + 0.5 * (first * first + second * second) * std::cos(angle)) / sine;
}

/// The area of a cross-section through an edge that counts to several of the walls that meet there; 0 for
/// fewer than three. \param meeting out: the walls
double section_counted_twice(const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                             const EdgeUses::UsedEdge& edge, std::set<int>& meeting) {
  std::size_t meet = 0;
  for (const EdgeUses::Use& use : edge.uses) {
    if (!faces[use.face].step) meet += use.orientation == TopAbs_INTERNAL ? 2 : 1;
  }
  if (meet < 3) return 0;
  struct Half {
    double angle, thickness;
  };
  std::vector<Half> halves;
  gp_Vec zero;
  for (const EdgeUses::Use& use : edge.uses) {
    const JoinedFace& face = faces[use.face];
    if (face.step) continue;
    const Fan fan = fan_at(TopoDS::Edge(edge.edge.Oriented(use.orientation)), face.face, 0.5);
    if (halves.empty()) zero = fan.away;
    const Coverage& coverage = face.coverage;
    const double thickness = thickness_at(coverage, walls[face.wall], fan.point) - coverage.added;
    meeting.insert(face.wall);
    const auto add = [&](const gp_Vec& away) {
      if (zero.Magnitude() < 0.5 || away.Magnitude() < 0.5) return;
      const double angle = zero.AngleWithRef(away, fan.along);
      halves.push_back({angle < 0 ? angle + 2 * M_PI : angle, 0.5 * thickness});
    };
    add(fan.away);
    if (use.orientation == TopAbs_INTERNAL) add(fan.away.Reversed());
  }
  if (halves.size() < 3) return 0;
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) { return a.angle < b.angle; });
  double section = 0;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const Half& next = halves[(i + 1) % halves.size()];
    const double turn = next.angle - halves[i].angle + (i + 1 == halves.size() ? 2 * M_PI : 0);
    section += common_section(turn, halves[i].thickness, next.thickness);
  }
  return section;
}

/// Normal of a face, of any length. BRepGProp_Face would look at all edges of the face each time.
gp_Vec normal_at(const TopoDS_Face& face, const gp_Pnt2d& uv) {
  gp_Pnt at;
  gp_Vec du, dv;
  BRepAdaptor_Surface(face, Standard_False).D1(uv.X(), uv.Y(), at, du, dv);
  return (face.Orientation() == TopAbs_REVERSED ? -1 : 1) * du.Crossed(dv);
}

/// Unit normal of a face; none where the surface is singular.
std::optional<gp_Dir> direction_at(const TopoDS_Face& face, const gp_Pnt2d& uv) {
  const gp_Vec normal = normal_at(face, uv);
  return normal.Magnitude() < gp::Resolution() ? std::nullopt : std::optional<gp_Dir>(normal);
}

/// A point well inside a face, if it has area.
std::optional<FaceSample> inner_sample(const TopoDS_Face& face) {
  const auto samples = sample_face(face, 16);
  return samples.empty() ? std::nullopt : std::optional(samples[samples.size() / 2]);
}

/// Whether a direction leads from a middle surface into a room that walls close in ahead and at two sides.
bool leads_inside(const Skin& skin, const gp_Pnt& from, const gp_Dir& ahead) {
  const auto end = skin.first_hit(from, ahead);
  const auto outward = end ? skin.faces()[end->face].outward(end->uv) : std::nullopt;
  if (!outward || outward->Dot(ahead) >= 0) return false;
  const gp_Pnt middle = from.Translated(0.5 * gp_Vec(from, end->point));
  const gp_Dir across = gp_Ax2(middle, ahead).XDirection();
  for (const double angle : {0.0, 0.25, 0.5, 0.75}) {
    const gp_Dir aside = across.Rotated(gp_Ax1(middle, ahead), angle * M_PI);
    if (skin.first_hit(middle, aside) && skin.first_hit(middle, aside.Reversed())) return true;
  }
  return false;
}

}  // namespace

Fan fan_at(const TopoDS_Edge& edge, const TopoDS_Face& face, double share) {
  Fan result;
  const BRepAdaptor_Curve curve(edge);
  curve.D1((1 - share) * curve.FirstParameter() + share * curve.LastParameter(), result.point, result.along);
  const gp_Pnt2d uv =
      ShapeAnalysis_Surface(BRep_Tool::Surface(face)).ValueOfUV(result.point, Precision::Confusion());
  result.normal = normal_at(face, uv);
  if (result.along.Magnitude() > Precision::Confusion()) result.along.Normalize();
  if (result.normal.Magnitude() > gp::Resolution()) result.normal.Normalize();
  result.away = result.along.Crossed(result.normal);
  if (edge.Orientation() == TopAbs_REVERSED) result.away.Reverse();
  return result;
}

bool leaves_through_side(const std::vector<Wall>& walls, int own, const Fan& fan) {
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall)
    if (wall != own && leaves_through(walls[wall], fan)) return true;
  return false;
}

void sort_unique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void check_rims(const Skin& skin, const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                const TopTools_IndexedMapOfShape& edge_numbers, const ExecutionContext& context,
                MidSurface& result) {
  double thinnest = skin.size();
  for (const Wall& wall : walls) thinnest = std::min(thinnest, wall.thickness);
  const double tolerance = 1e-3 * thinnest;
  std::set<int> accounted;
  for (const JoinedFace& face : faces) {
    accounted.insert(face.coverage.faces.begin(), face.coverage.faces.end());
  }
  for (const auto& [first, around] : EdgeUses(faces)) {
    context.check();
    if (around.size() > 1) continue;  // shared, or a seam
    const EdgeUses::Use& use = around.front();
    const TopoDS_Edge edge = TopoDS::Edge(first.Oriented(use.orientation));
    const TopoDS_Face& face = faces[use.face].face;
    const int own = faces[use.face].wall;
    ++result.free_edges;
    std::map<int, int> halfway;  // by wall: number of points on its middle
    std::map<int, int> rims;     // by face: number of points on it
    int astray = 0;
    bool stray = false;
    for (const double share : {0.5, 0.2, 0.8}) {
      const Fan fan = fan_at(edge, face, share);
      const auto on = skin.faces_at(fan.point, tolerance);
      accounted.insert(on.begin(), on.end());
      for (const int index : on) ++rims[index];
      if (!on.empty()) {
        astray += closes(skin, walls, fan, own) ? 0 : 1;
        continue;
      }
      const auto others = halfway_in_others(walls, own, fan.point);
      stray = stray || !others;
      if (!others) continue;
      astray += runs_across(walls, fan, own) ? 0 : 1;
      for (const int wall : *others) stray = ++halfway[wall] == 3 || stray;
    }
    // A twisted wall's rim and the fence that extends it straight may be apart by a small step.
    const bool long_enough = length_of(edge) > 0.1 * walls[own].thickness;
    if ((stray || astray > 1) && long_enough) {
      result.stray_edges.push_back(edge_numbers.FindIndex(edge));
      result.stray_faces.push_back(nearest_faces(skin, fan_at(edge, face, 0.5).point));
    }
    MiddleRim rim{edge_numbers.FindIndex(edge), {}};
    for (const auto& [index, points] : rims) {
      if (points == 3) rim.solid_faces.push_back(skin.faces()[index].number());
    }
    sort_unique(rim.solid_faces);
    if (!rim.solid_faces.empty()) result.rims.push_back(rim);
  }
  list_unpaired(skin, walls, accounted, thinnest, result);
}

CountedTwice counted_twice(const std::vector<Wall>& walls, const std::vector<JoinedFace>& faces,
                           Fillets fillets) {  // NOLINT(performance-unnecessary-value-param): counted down
  CountedTwice result;
  for (std::size_t i = 0; i < faces.size(); ++i) {  // steps lie across walls that reach up to them
    if (faces[i].step) result.steps += result.faces[i] = area_of(faces[i].face) * faces[i].coverage.mean;
  }
  struct Place {
    double volume = 0;
    std::set<std::size_t> faces{};
  };
  std::map<std::set<int>, Place> places;  // by the walls that meet
  for (const EdgeUses::UsedEdge& edge : EdgeUses(faces)) {
    std::set<int> meeting;
    const double section = section_counted_twice(walls, faces, edge, meeting);
    if (section == 0) continue;
    Place& place = places[meeting];
    place.volume += section * length_of(edge.edge);
    for (const EdgeUses::Use& use : edge.uses) {
      if (!faces[use.face].step) place.faces.insert(static_cast<std::size_t>(use.face));
    }
  }
  for (auto& [meeting, place] : places) {
    for (auto& [corner, held] : fillets.beside) {
      if (!std::includes(meeting.begin(), meeting.end(), corner.begin(), corner.end())) continue;
      const double made_up = std::max(0.0, std::min(place.volume, held));
      place.volume -= made_up;
      held -= made_up;
    }
    result.junctions += place.volume;
    for (const std::size_t face : place.faces) result.faces[face] += place.volume;
  }
  for (const auto& [corner, held] : fillets.beside) {
    if (held >= 0) continue;
    result.fillets -= held;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (faces[i].coverage.added > 0 && corner.count(faces[i].wall) != 0) result.faces[i] -= held;
    }
  }
  return result;
}

std::vector<std::size_t> faces_of_wrong_thickness(const Skin& skin, const std::vector<Wall>& walls,
                                                  const std::vector<JoinedFace>& faces,
                                                  const ExecutionContext& context) {
  constexpr double most_off = 0.05;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    context.check();
    if (faces[i].step) continue;
    std::vector<double> told;  // over what the rays measure
    for (const FaceSample& sample : sample_face(faces[i].face, 16)) {
      const auto normal = direction_at(faces[i].face, sample.uv);
      if (!normal) continue;
      const auto up = skin.first_hit(sample.point, *normal);
      const auto down = skin.first_hit(sample.point, normal->Reversed());
      if (!up || !down) continue;
      const double here = thickness_at(faces[i].coverage, walls[faces[i].wall], sample.point);
      told.push_back(here / (up->distance + down->distance));
    }
    if (told.empty()) continue;
    std::nth_element(told.begin(), told.begin() + static_cast<std::ptrdiff_t>(told.size() / 2), told.end());
    const double median = told[told.size() / 2];
    if (std::abs(median - 1) > most_off) result.push_back(i);
  }
  return result;
}

std::vector<std::size_t> hollow_joints(const Skin& skin, const std::vector<JoinedFace>& faces) {
  const EdgeUses uses(faces);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const JoinedFace& own = faces[i];
    std::set<std::size_t> standing;  // where the wall goes on beyond them
    bool enclosed = true;
    for (TopExp_Explorer it(own.face, TopAbs_EDGE); it.More(); it.Next()) {
      const std::vector<EdgeUses::Use>* meeting = uses.find(it.Current());
      if (meeting == nullptr || meeting->size() != 3) {
        enclosed = false;
        break;
      }
      const bool goes_on = std::any_of(meeting->begin(), meeting->end(), [&](const EdgeUses::Use& use) {
        return use.face != static_cast<int>(i) && faces[use.face].wall == own.wall;
      });
      for (const EdgeUses::Use& use : *meeting) {
        if (goes_on && faces[use.face].wall != own.wall) standing.insert(static_cast<std::size_t>(use.face));
      }
    }
    const auto sample = inner_sample(own.face);
    const auto normal = sample ? direction_at(own.face, sample->uv) : std::nullopt;
    if (!enclosed || standing.empty() || !normal) continue;
    std::array<bool, 2> on_side{};  // behind, ahead
    for (const std::size_t other : standing) {
      const auto there = inner_sample(faces[other].face);
      if (there) on_side[gp_Vec(sample->point, there->point).Dot(*normal) > 0 ? 1 : 0] = true;
    }
    if (on_side[0] == on_side[1]) continue;
    const gp_Dir ahead = on_side[0] ? *normal : normal->Reversed();
    constexpr double out = 0.6;  // of the wall, over its thickness
    if (leads_inside(skin, sample->point.Translated(out * own.coverage.mean * gp_Vec(ahead)), ahead))
      result.push_back(i);
  }
  return result;
}

}  // namespace quadrille
