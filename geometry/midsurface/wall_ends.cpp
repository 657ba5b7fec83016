/// Finds which wall begins where another ends, and draws the fences that cut middle surfaces there.

#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomFill.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Lin.hxx>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/wall_pieces.hpp"
#include "geometry/midsurface/widths.hpp"

namespace quadrille {

namespace {

const double nearly_parallel = std::cos(45 * M_PI / 180);

/// One edge of a face, with the directions into the material and away from the face.
class FaceEdge {
 public:
  /// \param beside the face on the other side of the edge.
  FaceEdge(const SkinFace& face, const SkinFace& beside, const TopoDS_Edge& edge)
      : face_(face),
        beside_(beside),
        edge_(edge),
        curve_(edge),
        first_(curve_.FirstParameter()),
        last_(curve_.LastParameter()) {}

  const SkinFace& beside() const { return beside_; }
  double first() const { return first_; }
  double last() const { return last_; }
  /// The part of the edge between two parameters.
  FaceEdge stretch(double first, double last) const {
    FaceEdge result = *this;
    result.first_ = first;
    result.last_ = last;
    return result;
  }
  double middle() const { return 0.5 * (first_ + last_); }
  /// The parameter at a share of the way along it.
  double at(double share) const { return first_ + share * (last_ - first_); }
  bool closed() const {
    return curve_.Value(first()).Distance(curve_.Value(last())) < Precision::Confusion();
  }
  const BRepAdaptor_Curve& curve() const { return curve_; }

  gp_Dir outward(double t) const { return face_.outward_at(curve_.Value(t)).value_or(gp::DZ()); }
  gp_Pnt inside(double t, double depth) const {
    return curve_.Value(t).Translated(-depth * gp_Vec(outward(t)));
  }
  /// Whether the other face rises outward from this one at the edge.
  bool in_corner() const {
    const auto other = beside_.outward_at(curve_.Value(middle()));
    return other && gp_Vec(*other).Dot(away(middle())) < -0.1;
  }
  /// Unit vector in the face's tangent plane, across the edge and out of the face.
  gp_Vec away(double t) const {
    gp_Pnt at;
    gp_Vec along;
    curve_.D1(t, at, along);
    if (along.Magnitude() < Precision::Confusion()) return {};
    // A face lies to the left of its edges, seen from outside.
    const gp_Vec right = along.Crossed(gp_Vec(outward(t))).Normalized();
    return edge_.Orientation() == TopAbs_REVERSED ? right.Reversed() : right;
  }

 private:
  const SkinFace& face_;
  const SkinFace& beside_;
  TopoDS_Edge edge_;
  BRepAdaptor_Curve curve_;
  double first_, last_;
};

Handle(Geom_Curve) interpolated(const FaceEdge& edge, double depth) {
  constexpr int intervals = 32;
  const bool closed = edge.closed();
  const int count = closed ? intervals : intervals + 1;
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
  for (int i = 0; i < count; ++i) {
    const double t = edge.first() + (edge.last() - edge.first()) * i / intervals;
    points->SetValue(i + 1, edge.inside(t, depth));
  }
  GeomAPI_Interpolate spline(points, closed, Precision::Confusion());
  spline.Perform();
  return Handle(Geom_Curve)(spline.Curve());
}

/// The edge moved into the material by a depth: a line or an arc if all its points lie on one, otherwise
/// interpolated. \param longer length by which a line or an arc is extended at both ends.
Handle(Geom_Curve) moved(const FaceEdge& edge, double depth, double longer) {
  const double first = edge.first(), last = edge.last(), near = 1e-5 * std::abs(depth);
  const auto at = [&](double share) { return edge.inside(edge.at(share), depth); };
  if (const double length = at(0).Distance(at(1)); length > near) {
    const gp_Lin line(at(0), gp_Dir(gp_Vec(at(0), at(1))));
    const auto is_on_line = [&](double share) { return line.Distance(at(share)) < near; };
    if (is_on_line(0.25) && is_on_line(0.5) && is_on_line(0.75))  // also straight B-splines
      return new Geom_TrimmedCurve(new Geom_Line(line), -longer, length + longer);
  }
  if (edge.curve().GetType() == GeomAbs_Circle) {
    gp_Ax2 frame = edge.curve().Circle().Position();
    const gp_Vec up(frame.Direction());
    frame.Translate(gp_Vec(frame.Location(), at(0)).Dot(up) * up);
    const gp_Circ circle(frame, at(0).Distance(frame.Location()));
    const bool stays = circle.Distance(at(0.3)) < near && circle.Distance(at(0.6)) < near;
    const double angle = std::min(longer / circle.Radius(), 0.45 * (2 * M_PI - (last - first)));
    if (stays && edge.closed()) return new Geom_TrimmedCurve(new Geom_Circle(circle), first, last);
    if (stays) return new Geom_TrimmedCurve(new Geom_Circle(circle), first - angle, last + angle);
  }
  return interpolated(edge, depth);
}

/// The face between two curves. Between arcs around one axis it is a cone, a cylinder or a plane, which
/// OpenCASCADE intersects much faster than the surface that it makes of two curves itself.
TopoDS_Face face_between(const Handle(Geom_Curve) & a, const Handle(Geom_Curve) & b) {
  const GeomAdaptor_Curve first(a), second(b);
  if (first.GetType() == GeomAbs_Circle && second.GetType() == GeomAbs_Circle &&
      gp_Lin(first.Circle().Axis()).Distance(second.Circle().Location()) < 1e-7 * first.Circle().Radius()) {
    const double low = a->FirstParameter();
    const TopoDS_Edge side = BRepBuilderAPI_MakeEdge(a->Value(low), b->Value(b->FirstParameter()));
    return TopoDS::Face(BRepPrimAPI_MakeRevol(side, first.Circle().Axis(), a->LastParameter() - low).Shape());
  }
  return BRepBuilderAPI_MakeFace(GeomFill::Surface(a, b), Precision::Confusion()).Face();
}

/// Whether the wall contains the point and its thickness direction there is nearly parallel to `across`.
bool runs_through(const Wall& wall, const gp_Pnt& point, const gp_Dir& across) {
  const auto position = position_in(wall, point);
  if (!position || position->thickness() < Precision::Confusion()) return false;
  return std::abs(gp_Dir(gp_Vec(position->feet[0], position->feet[1])).Dot(across)) > nearly_parallel;
}

/// The wall that begins where another one ends at an edge.
struct NextWall {
  int wall = -1;     ///< -1 = none
  double away = 0;   ///< distance from the edge at which it was found; large if a riser leans or is rounded
  double depth = 0;  ///< depth below the edge at which it was found
  double at = 0;     ///< parameter of the edge at which it was found
};

constexpr double close_by = 0.05;       // over the thickness
constexpr double least_steep = 0.5;     // sine of the angle at which rims run through others, as checked
constexpr double at_one_vertex = 1e-4;  // over the thickness
// Depths over the thickness at which a next wall is searched for. Half way down first: what begins there
// continues the wall itself. Where two sheets lie on each other, the thinner one does not reach that depth.
constexpr std::array<double, 4> searched_depths{0.5, 0.85, 0.15, 0.95};

/// Whether a wall begins behind a point of an edge, at the distance and depth of `next`.
bool begins_behind(const Wall& wall, const FaceEdge& edge, double at, const NextWall& next) {
  const gp_Pnt beyond = edge.inside(at, next.depth).Translated(next.away * edge.away(at));
  return runs_through(wall, beyond, edge.outward(at));
}

/// The walls that begin close by: at several depths at one place, as where a sheet leaves the one it lies on,
/// and beside each other; otherwise the first one farther away. Empty if there is none.
std::vector<NextWall> next_walls(const std::vector<Wall>& walls, int wall, const FaceEdge& edge) {
  const double t = walls[wall].thickness;
  const bool corner = edge.in_corner();
  std::vector<NextWall> result;
  const auto is_known = [&](int other) {
    return std::any_of(result.begin(), result.end(),
                       [&](const NextWall& known) { return known.wall == other; });
  };
  for (const double depth : searched_depths) {
    for (const double away : {close_by, 0.3, 0.6, 1.0}) {
      if ((corner || !result.empty()) && away > close_by)
        break;  // what is found farther away is behind a wall, not behind a riser
      for (const double share : {0.5, 0.25, 0.75, 0.06, 0.94}) {
        if (std::abs(share - 0.5) > 0.3 && result.empty()) continue;  // only others beside what is found
        const double at = edge.at(share);
        for (int other = 0; other < static_cast<int>(walls.size()); ++other) {
          const NextWall next{other, away * t, depth * t, at};
          if (other == wall || is_known(other) || !begins_behind(walls[other], edge, at, next)) continue;
          result.push_back(next);
          if (away > close_by) return result;
        }
      }
    }
  }
  return result;
}

/// The depth of a wall's middle below the edge at a parameter, a little before the edge (`step` negative) or
/// behind it. \param t thickness of the edge's wall. \param guess of the depth, which is returned if the wall
/// is at none of the depths that are searched.
double depth_at(const Wall& wall, const FaceEdge& edge, double at, double step, double t, double guess) {
  const gp_Pnt start = edge.curve().Value(at).Translated(step * edge.away(at));
  const auto is_in = [&](double depth) {
    return position_in(wall, start.Translated(-depth * gp_Vec(edge.outward(at)))).has_value();
  };
  double depth = guess;
  for (std::size_t i = 0; i < searched_depths.size() && !is_in(depth); ++i) depth = searched_depths[i] * t;
  if (!is_in(depth)) return guess;
  for (int i = 0; i < 4; ++i) {  // if the sides are not parallel their middle lies a little aside
    const gp_Pnt point = start.Translated(-depth * gp_Vec(edge.outward(at)));
    const auto position = position_in(wall, point);
    if (!position) break;
    const gp_Pnt middle(0.5 * (position->feet[0].XYZ() + position->feet[1].XYZ()));
    depth -= gp_Vec(point, middle).Dot(gp_Vec(edge.outward(at)));
  }
  return depth;
}

/// Whether the middles of two walls meet in a corner at the edge, as at a sharp fold. Such walls are extended
/// to where their middles intersect, and no fence separates them. Where the thickness changes at the fold,
/// they intersect between the edges of its two sides, so in neither wall.
bool meet_in_corner(const Skin& skin, const std::vector<Wall>& walls, int wall, const NextWall& next,
                    const FaceEdge& edge) {
  const double t = std::min(walls[wall].thickness, walls[next.wall].thickness);
  const gp_Pnt start = edge.curve().Value(next.at);
  const gp_Vec away = edge.away(next.at), down = gp_Vec(edge.outward(next.at)).Reversed();
  /// The line in which a wall's middle crosses the plane across the edge: its depth at the edge and its
  /// slope.
  struct Line {
    double depth = 0, slope = 0;
  };
  const auto line_of = [&](const Wall& of, double aside, double depth) -> std::optional<Line> {
    const auto position = position_in(of, start.Translated(aside * away + depth * down));
    if (!position || position->thickness() < Precision::Confusion()) return std::nullopt;
    const gp_Vec across(position->feet[0], position->feet[1]);
    const gp_Vec to(start, gp_Pnt(0.5 * (position->feet[0].XYZ() + position->feet[1].XYZ())));
    if (std::abs(across.Dot(down)) < Precision::Confusion()) return std::nullopt;
    const double slope = -across.Dot(away) / across.Dot(down);
    return Line{to.Dot(down) - slope * to.Dot(away), slope};
  };
  const auto is_plane = [](const Wall& of) {
    return GeomAdaptor_Surface(of.middle).GetType() == GeomAbs_Plane;
  };
  const bool planes = is_plane(walls[wall]) && is_plane(walls[next.wall]);
  const double least_turn = planes ? 1e-3 : 0.05;  // radians
  // The other side of a fold ends before this one, or after it; far from it if the thickness changes there.
  const double own_thickness = walls[wall].thickness;
  std::optional<Line> own;
  for (const double before : {close_by, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    if (own || (before > 0.5 && !planes)) break;
    own = line_of(walls[wall], -before * own_thickness, 0.5 * own_thickness);
  }
  const auto other = line_of(walls[next.wall], next.away, next.depth);
  if (!own || !other || std::abs(std::atan(own->slope) - std::atan(other->slope)) < least_turn) return false;
  const double meet = (other->depth - own->depth) / (own->slope - other->slope);  // distance from the edge
  if (std::abs(meet) < 0.5 * t) return true;
  const gp_Pnt corner = start.Translated(meet * away + (own->depth + own->slope * meet) * down);
  return planes && std::abs(meet) < 8 * own_thickness && skin.in_material(corner) &&
         !position_in(walls[wall], corner) && !position_in(walls[next.wall], corner);
}

/// \param beside all walls that begin at the edge. At a step the fence reaches from the first to the last of
/// their middles: fences that lie on each other in part would cut each other.
WallEnd make_end(const std::vector<Wall>& walls, int wall, const NextWall& next, const FaceEdge& edge,
                 const std::vector<NextWall>& beside) {
  const double t = walls[wall].thickness;
  const double step_over = next.away > close_by * t ? next.away : 1e-3 * t;
  bool step = false;
  double high = HUGE_VAL, low = 0;  // the depths between which both middles lie all along the edge
  for (const double share : {0.5, 0.1, 0.9}) {
    // Behind the middle of the edge there may be another wall, beside this one.
    const bool elsewhere = share == 0.5 && edge.first() < next.at && next.at < edge.last();
    const double at = elsewhere ? next.at : edge.at(share);
    const double own = depth_at(walls[wall], edge, at, -1e-3 * t, t, 0.5 * t);
    const double other = depth_at(walls[next.wall], edge, at, step_over, t, next.depth);
    if (share == 0.5) step = std::abs(own - other) > 1e-2 * t;
    high = std::min({high, own, other});
    low = std::max({low, own, other});
    if (!step) break;
    for (const NextWall& also : beside) {
      const double depth = depth_at(walls[also.wall], edge, at, step_over, t, also.depth);
      high = std::min(high, depth);
      low = std::max(low, depth);
    }
  }
  high -= 0.1 * t;
  low += 0.1 * t;
  // A rib across the bend interrupts the edge, not the wall: the fence is extended through the rib.
  double longer = 0;
  if (!step)
    for (const Wall& other : walls) longer = std::max(longer, other.thickness);
  return {wall, next.wall, face_between(moved(edge, high, longer), moved(edge, low, longer)), step};
}

/// The stretches of an edge of a wall of that thickness behind which another wall begins. If a bar lies
/// across another one, a stretch is only as long as the other bar is wide. What stands on the wall there does
/// not interrupt a stretch.
std::vector<FaceEdge> stretches_along(const Skin& skin, const Wall& wall, const FaceEdge& edge,
                                      const NextWall& next, double thickness) {
  constexpr int count = 32;
  const double first = edge.first(), length = edge.last() - first;
  const auto at = [&](double i) { return first + length * (i + 0.5) / count; };
  // At any of the depths that are searched: the floor behind an edge may lean.
  const auto begins = [&](double t) {
    return begins_behind(wall, edge, t, next) ||
           std::any_of(searched_depths.begin(), searched_depths.end(), [&](double depth) {
             return begins_behind(wall, edge, t, {next.wall, next.away, depth * thickness, t});
           });
  };
  const auto is_material = [&](double t) {
    return skin.in_material(edge.inside(t, next.depth).Translated(next.away * edge.away(t)));
  };
  const auto border = [&](double inside, double outside) {
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (inside + outside);
      (begins(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  // In a corner between the wall and another one, the wall's own sides do not reach the end of the edge, or
  // its middle goes on past it, as that of a lip flush with the outside does, up to the skin ahead.
  const auto up_to_corner = [&](double from, double end) {
    constexpr double longest = 3;  // over the thickness
    const bool line = edge.curve().GetType() == GeomAbs_Line;
    if (!line && from == end) return from;
    const double ahead = std::copysign(0.1 * thickness, end - first - 0.5 * length);
    const double depth = depth_at(wall, edge, from, next.away, thickness, next.depth);
    const auto behind = [&](double t) { return edge.inside(t, depth).Translated(next.away * edge.away(t)); };
    const auto hit = skin.first_hit(behind(from), gp_Dir(gp_Vec(behind(from), behind(from + ahead))));
    const gp_Vec back = -close_by * thickness * edge.away(from);
    const bool corner = hit && hit->distance > close_by * thickness && hit->distance < longest * thickness &&
                        skin.in_material(edge.inside(from + ahead, 0.25 * thickness).Translated(back));
    const double left = edge.curve().Value(from).Distance(edge.curve().Value(end));
    if (!corner) {
      const double stop = left < 1.5 * thickness && is_material(0.9 * from + 0.1 * end) ? end : from;
      const double past = 2 * ahead;
      return line && std::abs(stop - end) < 1e-3 * thickness && begins(end + past) ? end + 4.5 * past : stop;
    }
    const double stop = left < longest * thickness ? end : from;
    const double reach = from + std::copysign(0.95 * hit->distance, ahead);
    return line && (reach - stop) * ahead > 0 ? reach : stop;
  };
  std::vector<FaceEdge> result;
  for (int i = 0; i < count; ++i) {
    if (!begins(at(i))) continue;
    int last = i;
    for (int k = i + 1; k < count && (begins(at(k)) || is_material(at(k))); ++k)
      last = begins(at(k)) ? k : last;
    const double low = i > 0 ? border(at(i), at(i - 1)) : first;
    const double high = last + 1 < count ? border(at(last), at(last + 1)) : first + length;
    result.push_back(edge.stretch(up_to_corner(low, first), up_to_corner(high, first + length)));
    i = last;
  }
  if (result.empty()) result.push_back(edge);  // the wall is narrower than the spacing of samples
  return result;
}

/// Whether a point lies near one of the others. If not, adds it to them.
bool is_near(const gp_Pnt& point, double distance, std::vector<gp_Pnt>& others) {
  const bool result = std::any_of(others.begin(), others.end(),
                                  [&](const gp_Pnt& other) { return other.Distance(point) < distance; });
  if (!result) others.push_back(point);
  return result;
}

/// The edges of a face that lead to another surface. \param surfaces numbers of the faces' surfaces
std::vector<FaceEdge> borders_of(const SkinFace& face, const Skin& skin, const std::vector<int>& surfaces) {
  std::vector<FaceEdge> result;
  for (const auto& [edge, other] : skin.neighbors(face)) {
    if (surfaces[other] != surfaces[skin.index_of(face.face())])
      result.emplace_back(face, skin.faces()[other], edge);
  }
  return result;
}

/// An edge of a wall's side at one of its vertices.
struct EdgeEnd {
  const FaceEdge* edge = nullptr;
  double at = 0;         ///< parameter of the vertex
  gp_Vec outward_along;  ///< unit tangent that leaves the edge at the vertex
};

/// \param near edges that end closer to the vertex than this end at it.
std::vector<EdgeEnd> ends_at(const gp_Pnt& vertex, const std::vector<FaceEdge>& edges, double near) {
  std::vector<EdgeEnd> result;
  for (const FaceEdge& edge : edges) {
    for (const double at : {edge.first(), edge.last()}) {
      gp_Pnt point;
      gp_Vec along;
      edge.curve().D1(at, point, along);
      if (edge.closed() || point.Distance(vertex) > near || along.Magnitude() < Precision::Confusion())
        continue;
      if (at == edge.first()) along.Reverse();
      result.push_back({&edge, at, along.Normalized()});
    }
  }
  return result;
}

using EdgeEnds = std::vector<std::pair<gp_Pnt, gp_Dir>>;

/// The ends of a solid's edges, with the directions in which the edges leave them.
EdgeEnds edge_ends(const TopoDS_Solid& solid) {
  EdgeEnds result;
  for (const TopoDS_Shape& edge : list_of(solid, TopAbs_EDGE)) {
    if (BRep_Tool::Degenerated(TopoDS::Edge(edge))) continue;
    const BRepAdaptor_Curve curve(TopoDS::Edge(edge));
    for (const bool last : {false, true}) {
      gp_Pnt at;
      gp_Vec along;
      curve.D1(last ? curve.LastParameter() : curve.FirstParameter(), at, along);
      if (along.Magnitude() < Precision::Confusion()) continue;
      result.emplace_back(at, gp_Dir(last ? along.Reversed() : along));
    }
  }
  return result;
}

/// The direction of the edge that leaves a point most nearly along a wanted direction; the wanted direction
/// if there is no edge within 45 degrees of it. \param near edges that start closer to the point than this
/// leave it.
gp_Dir leaving(const EdgeEnds& ends, const gp_Pnt& point, const gp_Dir& wanted, double near) {
  gp_Dir best = wanted;
  double most = nearly_parallel;
  for (const auto& [at, along] : ends) {
    if (at.Distance(point) > near || along.Dot(wanted) < most) continue;
    most = along.Dot(wanted);
    best = along;
  }
  return best;
}

/// Whether another wall that stands on this one ends along the edge: its middle crosses the edge. Where it
/// is flush with the rim, what lies past its middle must be cut off at its end.
bool runs_under_an_end(const std::vector<Wall>& walls, int own, const FaceEdge& edge) {
  const double t = walls[own].thickness;
  const auto share_of = [&](const Wall& wall, double share) -> std::optional<double> {
    const double at = edge.at(share);
    const gp_Pnt above = edge.inside(at, -0.5 * t).Translated(close_by * t * edge.away(at));
    const auto position = position_in(wall, above);
    if (!position) return std::nullopt;
    return position->feet[0].Distance(above) / position->thickness() - 0.5;
  };
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
    if (wall == own) continue;
    const auto from = share_of(walls[wall], 0.1), to = share_of(walls[wall], 0.9);
    if (from && to && *from * *to < 0) return true;
  }
  return false;
}

/// The direction in which the rim would continue, and the length up to the next skin.
std::pair<gp_Vec, double> onward(const Skin& skin, const EdgeEnd& end, const EdgeEnd& rim, double t) {
  const gp_Vec straight = end.edge->away(end.at);
  const gp_Vec away = rim.outward_along.Dot(straight) > least_steep ? rim.outward_along : straight;
  // A little within the rim, beside which the ray might run along the skin.
  const gp_Pnt start = end.edge->inside(end.at, 0.5 * t).Translated(0.05 * t * (away - end.outward_along));
  const auto hit = skin.first_hit(start, gp_Dir(away));
  return {away, hit ? hit->distance + 0.1 * t : 2 * t};
}

/// Whether the material is wider than the rim anywhere along its continuation. Beside the vertex it need
/// not be: a fillet or chamfer along a rib ends in the same plane as the rib.
bool continues(const Skin& skin, const gp_Pnt& center, const gp_Vec& away, double length,
               const gp_Vec& aside) {
  for (const double share : {0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85})
    if (skin.in_material(center.Translated(share * length * away + aside))) return true;
  return false;
}

/// A parallelogram across the wall, from the vertex in the direction in which the rim would continue. It
/// contains the edge that leads from the vertex to the other side. If the side leans, a rectangle along its
/// normal would miss that edge, and with it the end of the rim; if the whole wall leans, it would miss
/// where the rim continues. Half way across a hollow side, as that of a ring around blades, the
/// tangent would be past the side: it begins before that.
TopoDS_Face rim_fence(const EdgeEnds& edges, const EdgeEnd& end, const gp_Vec& away, double length,
                      double t) {
  const gp_Pnt vertex = end.edge->curve().Value(end.at);
  const gp_Dir across = leaving(edges, vertex, end.edge->outward(end.at).Reversed(), at_one_vertex * t);
  const double wide = t / std::max(0.5, -across.Dot(end.edge->outward(end.at)));
  const gp_Pnt half_way = vertex.Translated(0.5 * t * gp_Vec(across));
  const SkinFace& beside = end.edge->beside();
  const double late = gp_Vec(beside.point(beside.closest(half_way)), half_way).Dot(away);
  const gp_Vec before = 2 * std::max(0.0, late) * away;
  const gp_Vec aside = 0.6 * wide * gp_Vec(across), onward = length * away + before;
  const gp_Pnt start = vertex.Translated(0.2 * wide * gp_Vec(across) - before);
  BRepBuilderAPI_MakePolygon border(start, start.Translated(aside), start.Translated(aside + onward),
                                    start.Translated(onward), Standard_True);
  return BRepBuilderAPI_MakeFace(border.Wire(), Standard_True).Face();
}

/// Adds the fences at the vertices of one face where an edge past which the wall continues meets its rim.
/// \param edges of the face. \param all of the solid. \param centers of the wall's fences, old and new.
void add_rim_ends(const std::vector<Wall>& walls, int wall, const std::vector<FaceEdge>& edges,
                  const EdgeEnds& all, std::vector<gp_Pnt>& centers, std::vector<WallEnd>& ends) {
  const Skin& skin = *walls[wall].skin;
  const double t = walls[wall].thickness;
  std::set<const FaceEdge*> going_on;  // past them the wall's middle continues inside the material
  for (const FaceEdge& edge : edges) {
    const gp_Pnt middle = edge.inside(edge.middle(), 0.5 * t);
    if (!edge.closed() && skin.in_material(middle.Translated(0.05 * t * edge.away(edge.middle()))))
      going_on.insert(&edge);
  }
  for (const FaceEdge& edge : edges) {
    if (going_on.count(&edge) == 0) continue;
    for (const double at : {edge.first(), edge.last()}) {
      const std::vector<EdgeEnd> around = ends_at(edge.curve().Value(at), edges, at_one_vertex * t);
      if (around.size() != 2) continue;
      const EdgeEnd &own = around[around[0].edge == &edge ? 0 : 1], &rim = around[&own == &around[0] ? 1 : 0];
      if (own.edge != &edge || going_on.count(rim.edge) != 0) continue;
      const gp_Pnt center = edge.inside(at, 0.5 * t);
      const auto [away, length] = onward(skin, own, rim, t);
      TopoDS_Face across;
      if (continues(skin, center, away, length, 0.05 * t * own.outward_along))
        across = rim_fence(all, own, away, length, t);
      else if (runs_under_an_end(walls, wall, edge))
        across = face_between(moved(edge, 0.3 * t, 0.1 * t), moved(edge, 0.7 * t, 0.1 * t));
      if (!across.IsNull() && !is_near(center, 0.01 * t, centers))
        ends.push_back({wall, wall, across, false});
    }
  }
}

/// The shortest vector from a fence to a point.
std::optional<gp_Vec> way_from(const TopoDS_Face& fence, const gp_Pnt& point) {
  const BRepExtrema_DistShapeShape distance(fence, BRepBuilderAPI_MakeVertex(point).Vertex());
  if (!distance.IsDone() || distance.NbSolution() == 0) return std::nullopt;
  return gp_Vec(distance.PointOnShape1(1), point);
}

/// The index of the end between `wall` and `next` whose fence already stands along the edge; -1 = none. The
/// edges of the two sides of a bend differ in length if the bend continues into rounded corners. They are not
/// exactly opposite to each other if the two radii have different centers.
int fence_along(const std::vector<WallEnd>& ends, int wall, int next, const FaceEdge& edge,
                double thickness) {
  constexpr double reach = 0.02;  // over the thickness
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].wall != wall || ends[i].next != next || ends[i].step) continue;
    const auto stands_at = [&](double share) {
      const auto way = way_from(ends[i].fence, edge.inside(edge.at(share), 0.5 * thickness));
      return way && way->Magnitude() < reach * thickness;
    };
    if (stands_at(0.5) && stands_at(0.05) && stands_at(0.95)) return static_cast<int>(i);
  }
  return -1;
}

/// Moves a fence half way toward the edge on the other side of the wall.
void move_between(TopoDS_Face& fence, const FaceEdge& edge, double thickness) {
  const auto way = way_from(fence, edge.inside(edge.middle(), 0.5 * thickness));
  if (!way || way->Magnitude() < Precision::Confusion()) return;
  gp_Trsf half;
  half.SetTranslation(0.5 * *way);
  fence = TopoDS::Face(BRepBuilderAPI_Transform(fence, half, Standard_True).Shape());
}

/// Finds where walls end and others begin.
class WallEnds {
 public:
  WallEnds(const Skin& skin, const std::vector<Wall>& walls) : skin_(skin), walls_(walls) {}

  /// The ends of all walls. \param surfaces numbers of the faces' surfaces
  std::vector<WallEnd> find(const std::vector<int>& surfaces, const ExecutionContext& context) {
    for (int wall = 0; wall < static_cast<int>(walls_.size()); ++wall) {
      for (int side = 0; side < 2; ++side) {
        for (const int face : walls_[wall].sides[side]) {
          for (const FaceEdge& edge : borders_of(skin_.faces()[face], skin_, surfaces)) {
            context.check();
            add(wall, side, edge);
          }
        }
      }
    }
    add_thinner();
    for (WallEnd& end : ends_)  // forgets the risers along which fences do not stand everywhere
      if (end.riser >= 0 && open_[{end.wall, end.riser}] > 0) end.riser = -1;
    return std::move(ends_);
  }

 private:
  static constexpr int between = -1;

  /// Looks behind an edge of a wall's side and adds the ends found there.
  void add(int wall, int side, const FaceEdge& edge) {
    ++open_[{wall, skin_.index_of(edge.beside().face())}];
    std::map<double, std::vector<NextWall>> nexts;  // by place
    for (const NextWall& next : next_walls(walls_, wall, edge)) nexts[next.at].push_back(next);
    for (const auto& [at, here] : nexts) {
      // Only at a step there may be others above or below the next wall.
      for (const NextWall& next : here)
        if (!add(wall, side, edge, next, here)) break;
    }
  }

  /// Adds the ends of the thinner walls at steps where no fence of the thicker wall stands.
  void add_thinner() {
    for (const Thinner& thinner : thinner_) {
      if (ends_at_fence(thinner)) continue;
      const Wall& next = walls_[thinner.next.wall];
      for (const FaceEdge& part :
           stretches_along(skin_, next, thinner.edge, thinner.next, walls_[thinner.wall].thickness))
        push(make_end(walls_, thinner.wall, thinner.next, part, {}), false, between);
    }
  }

  /// Adds the ends at an edge behind which the next wall begins. \param beside all walls that begin there.
  /// \return whether the edge is at a step.
  bool add(int wall, int side, const FaceEdge& edge, const NextWall& next,
           const std::vector<NextWall>& beside) {
    const double t = walls_[wall].thickness;
    const std::vector<int>& without_fence = walls_[wall].goes_on;
    if (std::find(without_fence.begin(), without_fence.end(), next.wall) != without_fence.end()) return false;
    const bool riser = next.away > close_by * t;
    if (riser && !stands_on(walls_, wall, next.wall)) return false;
    if (meet_in_corner(skin_, walls_, wall, next, edge)) return false;
    if (stands_already(wall, next.wall, side, edge)) return false;
    const gp_Pnt middle = edge.inside(edge.middle(), 0.5 * t);
    if (is_near(middle, 0.01 * t, middles_[{wall, next.wall}])) return false;
    const WallEnd end = make_end(walls_, wall, next, edge, {});
    if (!end.step) {
      push(end, riser, side);
    } else if (stands_on(walls_, wall, next.wall)) {
      for (const FaceEdge& part : stretches_along(skin_, walls_[next.wall], edge, next, t)) {
        WallEnd stretch = make_end(walls_, wall, next, part, beside);
        if (part.last() - part.first() > 0.999999 * (edge.last() - edge.first())) {
          stretch.riser = skin_.index_of(edge.beside().face());
          --open_[{wall, stretch.riser}];
        }
        push(stretch, true, between);
      }
    } else {
      thinner_.push_back({wall, next, edge});
    }
    return end.step;
  }

  /// An edge at which a thinner wall ends at a step.
  struct Thinner {
    int wall = 0;
    NextWall next;
    FaceEdge edge;
  };

  /// Whether fences of the thicker wall, at which the thinner one ends too, stand all along the edge. They
  /// stand across the thicker wall; the thinner one may lean.
  bool ends_at_fence(const Thinner& thinner) const {
    constexpr double reach = 0.35;  // over the thickness; half of it times the sine of the steepest slope
    const double t = walls_[thinner.wall].thickness;
    for (const double share : {0.5, 0.05, 0.95}) {
      const FaceEdge& edge = thinner.edge;
      const double at = edge.at(share);
      const gp_Pnt middle = edge.inside(at, depth_at(walls_[thinner.wall], edge, at, -1e-3 * t, t, 0.5 * t));
      const bool stands = std::any_of(ends_.begin(), ends_.end(), [&](const WallEnd& end) {
        if (end.wall != thinner.wall || end.next != thinner.next.wall || !end.step) return false;
        const auto way = way_from(end.fence, middle);
        return way && way->Magnitude() < reach * t;
      });
      if (!stands) return false;
    }
    return true;
  }

  /// \param side of the wall at whose edge the fence stands, or `between`. \param both whether the other wall
  /// ends at the same fence, as below a riser.
  void push(const WallEnd& end, bool both, int side) {
    ends_.push_back(end);
    if (both) ends_.push_back({end.next, end.wall, end.fence, end.step});
    sides_.resize(ends_.size(), side);
  }

  /// Whether a fence already stands along the edge. One made from the other side of the wall is moved to half
  /// way between both sides. One made for the other wall is used for this wall too.
  bool stands_already(int wall, int next, int side, const FaceEdge& edge) {
    const double t = walls_[wall].thickness;
    const int own = fence_along(ends_, wall, next, edge, t);
    if (own >= 0) {
      if (sides_[own] == 1 - side) {
        move_between(ends_[own].fence, edge, t);
        sides_[own] = between;
      }
      return true;
    }
    const int other_way = fence_along(ends_, next, wall, edge, t);
    if (other_way < 0) return false;
    push({wall, next, TopoDS_Face(ends_[other_way].fence), false}, false, between);
    return true;
  }

  const Skin& skin_;
  const std::vector<Wall>& walls_;
  /// For each wall and the next one, points on its middle at edges with fences.
  std::map<std::pair<int, int>, std::vector<gp_Pnt>> middles_;
  std::map<std::pair<int, int>, int> open_;  ///< by wall and riser: edges between them without a fence
  std::vector<WallEnd> ends_;
  std::vector<int> sides_;  ///< see push()
  std::vector<Thinner> thinner_;
};

/// The angle between the normals of `face` and `beside` at the edge, if `beside` rises from the face away
/// from the material: tangent to it (0) or at an obtuse angle.
std::optional<double> turn_of_fillet(const FaceEdge& edge, const SkinFace& face, const SkinFace& beside) {
  constexpr double tangent = 5 * M_PI / 180, steepest = 85 * M_PI / 180;
  const gp_Pnt at = edge.curve().Value(edge.middle());
  const auto own = face.outward_at(at), other = beside.outward_at(at);
  if (!own || !other) return std::nullopt;
  const double turn = own->Angle(*other);
  if (turn > steepest || (turn > tangent && !edge.in_corner())) return std::nullopt;
  double above = 0;
  for (const FaceSample& sample : beside.samples(8))
    above += sample.area * gp_Vec(at, sample.point).Dot(gp_Vec(*own));
  if (above <= 0) return std::nullopt;
  return turn > tangent ? turn : 0;
}

}  // namespace

bool stands_on(const std::vector<Wall>& walls, int wall, int next) {
  const double t = walls[wall].thickness, other = walls[next].thickness;
  return t > other || (t == other && wall < next);
}

std::map<int, std::vector<FilletBorder>> find_fillet_borders(const Skin& skin,
                                                             const std::vector<Wall>& walls) {
  std::map<int, std::vector<FilletBorder>> result;
  const std::vector<int> wall_of = walls_of_faces(walls);
  for (std::size_t index = 0; index < skin.faces().size(); ++index) {
    const int wall = wall_of[index];
    const SkinFace& face = skin.faces()[index];
    if (wall < 0) continue;
    for (const auto& [border, fillet] : skin.neighbors(face)) {
      const SkinFace& beside = skin.faces()[fillet];
      if (wall_of[fillet] >= 0) continue;
      const FaceEdge edge(face, beside, border);
      const auto turn = turn_of_fillet(edge, face, beside);
      if (!turn) continue;
      const double t = walls[wall].thickness;
      const TopoDS_Face fence = face_between(moved(edge, 0.3 * t, 0), moved(edge, 0.7 * t, 0));
      result[fillet].push_back({wall, fence, edge.outward(edge.middle()), *turn, length_of(border)});
    }
  }
  return result;
}

std::vector<WallEnd> find_wall_ends(const Skin& skin, const std::vector<Wall>& walls,
                                    const std::vector<int>& surfaces, const ExecutionContext& context) {
  return WallEnds(skin, walls).find(surfaces, context);
}

std::vector<WallEnd> find_rim_ends(const Skin& skin, const std::vector<Wall>& walls,
                                   const std::vector<int>& surfaces, const ExecutionContext& context) {
  const EdgeEnds edges = edge_ends(skin.solid());
  std::vector<WallEnd> ends;
  for (int wall = 0; wall < static_cast<int>(walls.size()); ++wall) {
    std::vector<gp_Pnt> centers;  // of the wall's fences
    for (const int face : both_sides(walls[wall])) {
      context.check();
      add_rim_ends(walls, wall, borders_of(skin.faces()[face], skin, surfaces), edges, centers, ends);
    }
  }
  return ends;
}

}  // namespace quadrille
