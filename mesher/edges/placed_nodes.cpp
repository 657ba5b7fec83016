/// Projects each place onto the vertices, edges and faces near it, in that order.

#include "mesher/edges/placed_nodes.hpp"

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Extrema_ExtPC.hxx>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_division.hpp"

namespace quadrille {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

gp_Pnt to_point(const Vector3& p) {
  return {p.x(), p.y(), p.z()};
}

/// The place of a face that is nearest to a point.
struct OnFace {
  FaceId face;
  double distance = endless;
  bool inside = false;  ///< not on an edge; then uv is known
  Vector2 uv{0, 0};
};

class Placing {
 public:
  Placing(const CadShape& shape, const FaceFlags& used, const SizingOptions& sizing, double size)
      : shape_(std::make_shared<CadShape>(shape)),
        sizing_(sizing),
        tolerance_(place_tolerance_share * size),
        own_vertices_(shape.vertices.size()) {
    for (const FaceId face : used.ids())
      if (used[face]) faces_.emplace_back(face, box_of(shape.faces[face].face));
  }

  PlacedNodes run() {
    PlacedNodes result;
    std::set<std::string> given;
    for (const NodePlace& place : sizing_.nodes) given.insert(place.name);
    int unnamed = 0;
    for (const NodePlace& place : sizing_.nodes) {
      name_ = place.name;
      while (name_.empty() || (place.name.empty() && given.contains(name_)))
        name_ = fmt::format("Node{}", ++unnamed);
      result.nodes.push_back({name_, vertex_at(place.point)});
    }
    if (shape_->vertices.size() > own_vertices_) result.shape = shape_;
    return result;
  }

 private:
  VertexId vertex_at(const Vector3& p) {
    std::vector<FaceId> near;
    for (const auto& [face, box] : faces_)
      if (distance_to(box, p) <= std::max(tolerance_, shape_->faces[face].tolerance)) near.push_back(face);
    if (const VertexId vertex = nearest_vertex(near, p); vertex.exists()) return vertex;
    if (const auto [edge, parameter] = nearest_edge(near, p); edge.exists())
      return on_edge(p, edge, parameter);
    return in_face(p);
  }

  static double distance_to(const Bnd_Box& box, const Vector3& p) {
    if (box.IsVoid()) return endless;
    const Vector3 low = to_vector(box.CornerMin()), high = to_vector(box.CornerMax());
    return (p - p.cwiseMax(low).cwiseMin(high)).norm();
  }

  VertexId nearest_vertex(const std::vector<FaceId>& faces, const Vector3& p) const {
    VertexId nearest;
    double least = endless;
    const auto look_at = [&](VertexId vertex) {
      if (!vertex.exists()) return;
      const double distance = (shape_->vertices[vertex] - p).norm();
      if (distance > std::max(tolerance_, shape_->vertex_tolerances[vertex]) || !(distance < least)) return;
      nearest = vertex;
      least = distance;
    };
    for (const FaceId face : faces) {
      for (const EdgeId edge : shape_->faces[face].edges()) {
        look_at(shape_->edges[edge].first_vertex);
        look_at(shape_->edges[edge].last_vertex);
      }
    }
    for (const FaceId face : faces)
      for (const InnerVertex& inner : shape_->faces[face].inner_vertices) look_at(inner.vertex);
    return nearest;
  }

  /// The edge that passes through the point, and the parameter there; none if there is none.
  std::pair<EdgeId, double> nearest_edge(const std::vector<FaceId>& faces, const Vector3& p) const {
    std::pair<EdgeId, double> nearest{EdgeId(), 0};
    double least = endless;
    for (const FaceId face : faces) {
      for (const EdgeId id : shape_->faces[face].edges()) {
        const CadEdge& edge = shape_->edges[id];
        if (edge.degenerate || !(edge.length > 0)) continue;
        const auto [distance, parameter] = project(edge, p);
        if (distance > std::max(tolerance_, edge.tolerance) || !(distance < least)) continue;
        nearest = {id, parameter};
        least = distance;
      }
    }
    return nearest;
  }

  /// The distance of a point from the inside of an edge, and the parameter of the nearest point.
  static std::pair<double, double> project(const CadEdge& edge, const Vector3& p) {
    std::pair<double, double> nearest{endless, 0};
    try {
      const BRepAdaptor_Curve curve(edge.edge);
      const Extrema_ExtPC found(to_point(p), curve, edge.first, edge.last);
      if (!found.IsDone()) return nearest;
      for (int i = 1; i <= found.NbExt(); ++i) {
        const double parameter = found.Point(i).Parameter();
        const double distance = (to_vector(found.Point(i).Value()) - p).norm();
        if (distance < nearest.first && parameter > edge.first && parameter < edge.last)
          nearest = {distance, parameter};
      }
    } catch (const Standard_Failure&) {
      // Its distance is unknown. The faces at it decide.
    }
    return nearest;
  }

  VertexId on_edge(const Vector3& p, EdgeId edge, double parameter) {
    const int number = shape_->edges[edge].number;
    if (sizing_.spacings.contains(number))
      throw refused(p, fmt::format("lies inside Edge{}, whose nodes follow from `segments` or a bias: "
                                   "remove one of the two",
                                   number));
    return divide_edge(*shape_, edge, {parameter}).front();
  }

  VertexId in_face(const Vector3& p) {
    const OnFace found = nearest_face(p);
    const bool exists = found.face.exists();
    const double allowed = exists ? std::max(tolerance_, shape_->faces[found.face].tolerance) : tolerance_;
    if (!exists || !found.inside || found.distance > allowed)
      throw refused(
          p, exists ? fmt::format("lies {} mm from Face{}, the nearest face that is meshed, and may lie "
                                  "at most {} mm from it",
                                  number_text(found.distance), found.face.number(), number_text(allowed))
                    : "cannot be projected onto a face that is meshed");
    CadFace& face = shape_->faces[found.face];
    const FaceSurface surface(face);
    Vector2 uv = found.uv;
    const VertexId vertex = shape_->vertices.push_back(surface.project(uv, p).point);
    shape_->vertex_tolerances.push_back(face.tolerance);
    face.inner_vertices.push_back({vertex, uv});
    return vertex;
  }

  /// Looks at faces in the order of the distances of their boxes, as long as these are nearer.
  OnFace nearest_face(const Vector3& p) const {
    std::vector<std::pair<double, FaceId>> order;
    for (const auto& [face, box] : faces_) order.emplace_back(distance_to(box, p), face);
    std::ranges::stable_sort(order);
    OnFace nearest;
    const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(to_point(p)).Shape();
    for (const auto& [least, face] : order) {
      if (least > nearest.distance) break;
      const OnFace found = project(vertex, face);
      if (found.distance < nearest.distance) nearest = found;
    }
    return nearest;
  }

  OnFace project(const TopoDS_Shape& vertex, FaceId face) const {
    OnFace result;
    try {
      const BRepExtrema_DistShapeShape distance(vertex, shape_->faces[face].face);
      if (!distance.IsDone() || distance.NbSolution() == 0) return result;
      result.face = face;
      result.distance = distance.Value();
      for (int i = 1; i <= distance.NbSolution() && !result.inside; ++i) {
        result.inside = distance.SupportTypeShape2(i) == BRepExtrema_IsInFace;
        if (result.inside) distance.ParOnFaceS2(i, result.uv.x(), result.uv.y());
      }
    } catch (const Standard_Failure&) {
      // Its distance is unknown. Others may be nearer.
    }
    return result;
  }

  Error refused(const Vector3& p, const std::string& why) const {
    return usage_error("nodes_at", fmt::format("`nodes_at` {} at {} {}", name_, place_text(p), why));
  }

  std::shared_ptr<CadShape> shape_;
  const SizingOptions& sizing_;
  double tolerance_;
  std::size_t own_vertices_;
  std::vector<std::pair<FaceId, Bnd_Box>> faces_;  // that are meshed
  std::string name_;                               // of the place looked at
};

}  // namespace

PlacedNodes place_nodes(const CadShape& shape, const FaceFlags& used, const SizingOptions& sizing,
                        double size) {
  if (sizing.nodes.empty()) return {};
  return Placing(shape, used, sizing, size).run();
}

}  // namespace quadrille
