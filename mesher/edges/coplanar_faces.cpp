/// Joins coplanar faces: collects the faces around each one, and makes one outline of theirs.

#include "mesher/edges/simplified_model.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/tiny_features.hpp"
#include "mesher/mesh/criteria.hpp"

namespace quadrille {

namespace {

/// A plane face that may be joined with others, or several that are joined.
struct PlaneFace {
  Vector3 origin{0, 0, 0};
  Vector3 normal{0, 0, 0};            // out of the part
  double area = 0, length = 0;        // of the outline, without holes
  std::map<VertexId, double> angles;  // inside the face

  /// Of the rectangle with the area and the length of the outline.
  double width() const {
    const double half = 0.25 * length;
    return half - std::sqrt(std::max(0.0, half * half - area));
  }
  /// \param shared length of the edges between the two
  void add(const PlaneFace& other, double shared) {
    area += other.area;
    length += other.length - 2 * shared;
    for (const auto& [vertex, angle] : other.angles) angles[vertex] += angle;
  }
};

/// \return the direction of a coedge in the parameter plane, along its wire, at its start or its end
Vector2 direction(const CadEdge& edge, const Coedge& coedge, bool at_start) {
  gp_Pnt2d point;
  gp_Vec2d along;
  coedge.parametric_curve->D1(at_start == coedge.forward ? edge.first : edge.last, point, along);
  return (coedge.forward ? 1 : -1) * Vector2(along.X(), along.Y());
}

/// Finds the faces that may be joined.
class CoplanarFaces {
 public:
  CoplanarFaces(const CadShape& shape, const FaceFlags& used, const SizingOptions& sizing,
                const SizeLimits& limits)
      : shape_(shape), sizing_(sizing), limits_(limits), planes_(shape.faces.size()) {
    for (const FaceId face : used.ids())
      if (used[face]) planes_[face] = plane_of(face);
  }

  /// Faces that are joined.
  struct Group {
    std::vector<FaceId> members;
    std::set<FaceId> inside;      // the same
    PlaneFace whole;              // all of them
    std::set<VertexId> touching;  // where the outline touches itself
  };

  /// The faces to be joined with a face, which comes first. \param taken 1 = not again
  Group around(FaceId first, const FaceFlags& taken) const {
    if (!planes_[first]) return {{first}, {first}, {}, {}};
    Group group{{first}, {first}, *planes_[first], {}};
    do {
      grow(group, taken);
    } while (find_touching(group));
    // A few faces in a plane are a partition that someone drew; many small ones come from a program.
    constexpr std::size_t least = 6;
    if (group.members.size() < least) group.members = {first};
    return group;
  }

 private:
  void grow(Group& group, const FaceFlags& taken) const {
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      const FaceId member = group.members[i];
      for (const EdgeId edge : shape_.faces[member].edges()) {
        for (const FaceId next : shape_.edges[edge].faces) {
          if (taken[next] || group.inside.contains(next) || !planes_[next] || stays(edge)) continue;
          if (!does_harm(edge, group, *planes_[next]) || !lie_beside_each_other(edge, member, next)) continue;
          if (!lies_in_plane(group.whole, group.members.front(), next)) continue;
          const std::vector<EdgeId> shared = shared_edges(next, group.inside);
          if (std::ranges::any_of(shared, [&](EdgeId id) { return stays(id); })) continue;
          double length = 0;
          for (const EdgeId id : shared) length += shape_.edges[id].length;
          group.whole.add(*planes_[next], length);
          group.inside.insert(next);
          group.members.push_back(next);
        }
      }
    }
  }

  /// \return whether there are more such vertices than before
  bool find_touching(Group& group) const {
    std::map<VertexId, int> ends;
    for (const FaceId member : group.members)
      for (const EdgeId id : shape_.faces[member].edges()) {
        const CadEdge& edge = shape_.edges[id];
        if (edge.faces.size() == 2 && group.inside.contains(edge.faces[0]) &&
            group.inside.contains(edge.faces[1]))
          continue;
        ++ends[edge.first_vertex];
        ++ends[edge.last_vertex];
      }
    const std::size_t before = group.touching.size();
    for (const auto& [vertex, count] : ends)
      if (count > 2) group.touching.insert(vertex);
    return group.touching.size() > before;
  }

  std::optional<PlaneFace> plane_of(FaceId id) const {
    const CadFace& face = shape_.faces[id];
    if (sizing_.names_face(id.number()) || !face.inner_vertices.empty()) return std::nullopt;
    if (BRep_Tool::Surface(face.face).IsNull()) return std::nullopt;
    const BRepAdaptor_Surface surface(face.face, false);
    if (surface.GetType() != GeomAbs_Plane) return std::nullopt;
    PlaneFace plane;
    gp_Pnt origin;
    gp_Vec u, v;
    surface.D1(0, 0, origin, u, v);
    plane.origin = to_vector(origin);
    plane.normal = (face.reversed ? -1 : 1) * to_vector(u.Crossed(v)).normalized();
    for (const CadWire& wire : face.wires)
      if (!measure(wire, plane)) return std::nullopt;
    return plane;
  }

  /// \return false if the wire is not a plain loop
  bool measure(const CadWire& wire, PlaneFace& plane) const {
    double area = 0, length = 0;
    for (std::size_t i = 0; i < wire.coedges.size(); ++i) {
      const Coedge &coedge = wire.coedges[i], &next = wire.coedges[(i + 1) % wire.coedges.size()];
      const CadEdge &edge = shape_.edges[coedge.edge], &after = shape_.edges[next.edge];
      const VertexId end = shape_.end_of(coedge);
      if (!wire.ordered || coedge.internal || !(edge.length > 0) || end != shape_.start_of(next))
        return false;
      const Vector2 in = direction(edge, coedge, false), out = direction(after, next, true);
      const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
      plane.angles[end] += std::numbers::pi - turn;
      Vector2 from = parametric_point(coedge, edge.first);
      for (int k = 1; k <= steps_of_edge; ++k) {
        const double t = edge.first + (edge.last - edge.first) * k / steps_of_edge;
        const Vector2 to = parametric_point(coedge, t);
        area += (coedge.forward ? 0.5 : -0.5) * (from.x() * to.y() - from.y() * to.x());
        from = to;
      }
      length += edge.length;
    }
    if (area <= 0) return true;  // around a hole
    plane.area = area;
    plane.length = length;
    return true;
  }

  bool stays(EdgeId id) const {
    const CadEdge& edge = shape_.edges[id];
    return edge.faces.size() != 2 || edge.faces[0] == edge.faces[1] || is_named(edge, sizing_);
  }

  /// The edges between a face and those of a group.
  std::vector<EdgeId> shared_edges(FaceId face, const std::set<FaceId>& inside) const {
    std::vector<EdgeId> result = shape_.faces[face].edges();
    std::erase_if(result, [&](EdgeId edge) {
      const auto& faces = shape_.edges[edge].faces;
      return std::ranges::none_of(faces, [&](FaceId other) { return inside.contains(other); });
    });
    return result;
  }

  /// Whether the edge between a group and another face had better not be there.
  bool does_harm(EdgeId id, const Group& group, const PlaneFace& other) const {
    constexpr double sharp = usual_limit(Criterion::angle_min) * std::numbers::pi / 180;
    const CadEdge& edge = shape_.edges[id];
    const PlaneFace& whole = group.whole;
    const auto is_bad = [&](VertexId end) {
      return group.touching.contains(end) || std::min(whole.angles.at(end), other.angles.at(end)) < sharp;
    };
    return edge.length < limits_.size_min || std::min(whole.width(), other.width()) < limits_.largest ||
           is_bad(edge.first_vertex) || is_bad(edge.last_vertex);
  }

  /// Whether the edges of a face lie in a plane, within the tolerances of the face and of that of the plane.
  bool lies_in_plane(const PlaneFace& plane, FaceId first, FaceId face) const {
    const double tolerance = std::max(shape_.faces[first].tolerance, shape_.faces[face].tolerance);
    for (const EdgeId id : shape_.faces[face].edges()) {
      for (const Vector3& point : points_along(shape_.edges[id]))
        if (std::abs((point - plane.origin).dot(plane.normal)) >
            std::max(tolerance, shape_.edges[id].tolerance))
          return false;
    }
    return true;
  }

  /// Whether the faces look the same way, and lie on both sides of the edge.
  bool lie_beside_each_other(EdgeId edge, FaceId a, FaceId b) const {
    constexpr double parallel = 0.9;  // slivers may have any normal
    if (planes_[a]->normal.dot(planes_[b]->normal) < parallel) return false;
    return is_along(edge, a) != is_along(edge, b);
  }

  /// Whether the face, seen from outside, lies to the left of the edge.
  bool is_along(EdgeId edge, FaceId face) const {
    for (const CadWire& wire : shape_.faces[face].wires)
      for (const Coedge& coedge : wire.coedges)
        if (coedge.edge == edge) return coedge.forward != shape_.faces[face].reversed;
    return false;
  }

  const CadShape& shape_;
  const SizingOptions& sizing_;
  const SizeLimits& limits_;
  IdVector<FaceId, std::optional<PlaneFace>> planes_;  // of the faces that may be joined
};

/// The edges that lie between several faces, ascending.
std::vector<EdgeId> edges_between(const CadShape& shape, const std::vector<FaceId>& members) {
  std::map<EdgeId, int> uses;
  for (const FaceId member : members)
    for (const EdgeId edge : shape.faces[member].edges()) ++uses[edge];
  std::vector<EdgeId> result;
  for (const auto& [edge, count] : uses)
    if (count == 2) result.push_back(edge);
  return result;
}

/// The outline of several faces, in the parameter plane of the first. Nothing if it touches itself.
/// \param inner edges between them, ascending
std::optional<std::vector<CadWire>> outline_of(const CadShape& shape, const std::vector<FaceId>& members,
                                               const std::vector<EdgeId>& inner) {
  const CadFace& first = shape.faces[members.front()];
  std::map<VertexId, Coedge> starts;
  for (const FaceId member : members) {
    const CadFace& face = shape.faces[member];
    for (const CadWire& wire : face.wires) {
      for (Coedge coedge : wire.coedges) {
        if (std::ranges::binary_search(inner, coedge.edge)) continue;
        coedge.forward = coedge.forward == (face.reversed == first.reversed);
        coedge.source =
            TopoDS::Edge(coedge.source.Oriented(coedge.forward ? TopAbs_FORWARD : TopAbs_REVERSED));
        double from = 0, to = 0;
        coedge.parametric_curve = BRep_Tool::CurveOnSurface(coedge.source, first.face, from, to);
        const VertexId start = shape.start_of(coedge);
        if (coedge.parametric_curve.IsNull() || !start.exists() ||
            !starts.emplace(start, std::move(coedge)).second)
          return std::nullopt;
      }
    }
  }
  std::vector<CadWire> wires;
  while (!starts.empty()) {
    CadWire wire;
    for (auto next = starts.begin(); next != starts.end();) {
      const VertexId end = shape.end_of(next->second);
      wire.coedges.push_back(std::move(next->second));
      starts.erase(next);
      next = starts.find(end);
    }
    wires.push_back(std::move(wire));
  }
  return wires;
}

/// The face with the outline of all. Nothing if the outline touches itself. \param inner see outline_of()
std::optional<CadFace> joined(const CadShape& shape, const std::vector<FaceId>& members,
                              const std::vector<EdgeId>& inner) {
  std::optional<std::vector<CadWire>> wires = outline_of(shape, members, inner);
  if (!wires) return std::nullopt;
  CadFace result = shape.faces[members.front()];
  result.face = TopoDS::Face(result.face.EmptyCopied());
  result.wires = std::move(*wires);
  const BRep_Builder builder;
  for (const CadWire& wire : result.wires) {
    TopoDS_Wire loop;
    builder.MakeWire(loop);
    for (const Coedge& coedge : wire.coedges) builder.Add(loop, coedge.source);
    builder.Add(result.face, loop);
  }
  BRepTools::UVBounds(result.face, result.u_min, result.u_max, result.v_min, result.v_max);
  for (const FaceId member : members)
    result.tolerance = std::max(result.tolerance, shape.faces[member].tolerance);
  return result;
}

/// Puts the joined face in the place of the first. \param inner edges between the members
void replace(CadShape& shape, const std::vector<FaceId>& members, const std::vector<EdgeId>& inner,
             CadFace face, SimplifiedModel& model) {
  const FaceId first = members.front();
  for (const EdgeId id : inner) {
    CadEdge& edge = shape.edges[id];
    model.inner.push_back(crossed_edge(edge));
    edge.faces.clear();
  }
  for (const FaceId member : members) {
    if (member == first) continue;
    model.gone[member] = 1;
    model.taken_by[member] = first;
    shape.faces[member].wires.clear();
  }
  for (const EdgeId edge : face.edges()) {
    auto& faces = shape.edges[edge].faces;
    for (FaceId& at : faces)
      if (model.taken_by[at].exists()) at = model.taken_by[at];
    std::ranges::sort(faces);
  }
  shape.faces[first] = std::move(face);
}

}  // namespace

void join_coplanar_faces(SimplifiedModel& model, const FaceFlags& used, const SizingOptions& sizing,
                         const SizeLimits& limits) {
  const CadShape& before = model.model.shape();
  const CoplanarFaces faces(before, model.left(used), sizing, limits);
  std::shared_ptr<CadShape> after;
  FaceFlags taken(before.faces.size());
  for (const FaceId face : taken.ids()) {
    if (taken[face]) continue;
    const auto group = faces.around(face, taken);
    if (group.members.size() < 2) continue;
    for (const FaceId member : group.members) taken[member] = 1;
    const std::vector<EdgeId> inner = edges_between(before, group.members);
    std::optional<CadFace> whole = joined(before, group.members, inner);
    if (!whole) continue;
    if (!after) after = std::make_shared<CadShape>(before);
    replace(*after, group.members, inner, std::move(*whole), model);
  }
  if (after) model.model = CadModel(after);
}

}  // namespace quadrille
