/// Splits such vertices into one for each place where curves end, and closes the gaps that this leaves.

#include "geometry/cad/curve_ends.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <GeomProjLib.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/cad/shape_parts.hpp"

namespace quadrille {

namespace {

/// One end of an edge's curve.
struct CurveEnd {
  EdgeId edge;
  bool last = false;
  Vector3 point;
};

Vector3 point_on(const CadEdge& edge, double share) {
  return to_vector(BRepAdaptor_Curve(edge.edge).Value(edge.first + share * (edge.last - edge.first)));
}

class CurveEndMender {
 public:
  explicit CurveEndMender(CadShape& shape) : shape_(shape), ends_(shape.vertices.size()) {
    for (const EdgeId id : shape.edges.ids()) {
      const CadEdge& edge = shape.edges[id];
      if (edge.degenerate || !(edge.length > 0)) continue;
      for (const bool last : {false, true}) {
        const VertexId vertex = last ? edge.last_vertex : edge.first_vertex;
        if (vertex.exists()) ends_[vertex].push_back({id, last, point_on(edge, last ? 1 : 0)});
      }
    }
  }

  void run() {
    std::set<VertexId> wrong;
    for (const CadEdge& edge : shape_.edges) {
      if (is_swallowed(edge)) wrong.insert(edge.first_vertex);
    }
    for (const VertexId vertex : shape_.vertices.ids()) {
      if (is_far(vertex)) wrong.insert(vertex);
    }
    if (wrong.empty()) return;
    for (const VertexId vertex : wrong) split(vertex);
    drop_dangling();
    for (const FaceId face : shape_.faces.ids()) close_wires(face);
  }

 private:
  /// Whether the edge lies within the tolerance of its only vertex, but its ends do not lie at the vertex.
  bool is_swallowed(const CadEdge& edge) const {
    if (edge.degenerate || !edge.closed() || !edge.first_vertex.exists() || !(edge.length > 0)) return false;
    const Vector3& vertex = shape_.vertices[edge.first_vertex];
    const double reach = shape_.vertex_tolerances[edge.first_vertex];
    const auto distance = [&](double share) { return (point_on(edge, share) - vertex).norm(); };
    constexpr double ends_off = 1e-3;  // share of the edge's length
    if (std::max(distance(0), distance(1)) <= std::max(ends_off * edge.length, edge.tolerance)) return false;
    constexpr int edge_parts = 8;
    for (int i = 0; i <= edge_parts; ++i) {
      if (distance(static_cast<double>(i) / edge_parts) > reach) return false;
    }
    return true;
  }

  /// The distance of a vertex from the nearest end of its curves; infinite without curves.
  double nearest_end(VertexId vertex) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const CurveEnd& end : ends_[vertex])
      nearest = std::min(nearest, (end.point - shape_.vertices[vertex]).norm());
    return nearest;
  }

  /// Whether all curves of a vertex miss it by more than the length of the shortest one.
  bool is_far(VertexId vertex) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const CurveEnd& end : ends_[vertex]) shortest = std::min(shortest, shape_.edges[end.edge].length);
    const double nearest = nearest_end(vertex);
    return std::isfinite(nearest) && nearest > std::max(shortest, shape_.vertex_tolerances[vertex]);
  }

  /// Makes one vertex of each place where curves end. The place with the most ends keeps the number.
  void split(VertexId vertex) {
    constexpr double reach_share = 0.01;  // share of the length of the shortest edge there
    std::vector<CurveEnd> left = ends_[vertex];
    double shortest = shape_.edges[left.front().edge].length, tolerance = 0;
    for (const CurveEnd& end : left) {
      shortest = std::min(shortest, shape_.edges[end.edge].length);
      tolerance = std::max(tolerance, shape_.edges[end.edge].tolerance);
    }
    const double reach = std::max(reach_share * shortest, tolerance);
    std::vector<std::vector<CurveEnd>> places;
    while (!left.empty()) {
      auto& place = places.emplace_back(1, left.back());
      left.pop_back();
      for (std::size_t i = 0; i < place.size(); ++i) {
        const auto apart = std::stable_partition(left.begin(), left.end(), [&](const CurveEnd& end) {
          return (end.point - place[i].point).norm() > reach;
        });
        place.insert(place.end(), apart, left.end());
        left.erase(apart, left.end());
      }
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    shape_.problems.push_back(fmt::format(
        "{}: {} used instead", what_is_wrong(vertex),
        places.size() == 1 ? "the place where its curves end is"
                           : fmt::format("the {} places where its curves end are", places.size())));
    for (std::size_t i = 0; i < places.size(); ++i)
      place_vertex(i == 0 ? vertex : new_vertex(), places[i], tolerance);
  }

  std::string what_is_wrong(VertexId vertex) const {
    const double tolerance = shape_.vertex_tolerances[vertex], nearest = nearest_end(vertex);
    if (nearest > tolerance)
      return fmt::format("Vertex{} lies {} away from where its curves end", vertex.number(),
                         number_text(nearest));
    return fmt::format("Vertex{} has a tolerance of {}, larger than an edge that ends there", vertex.number(),
                       number_text(tolerance));
  }

  VertexId new_vertex() {
    shape_.vertex_tolerances.push_back(0);
    return shape_.vertices.push_back(Vector3::Zero());
  }

  void place_vertex(VertexId vertex, const std::vector<CurveEnd>& ends, double tolerance) {
    Vector3 sum = Vector3::Zero();
    for (const CurveEnd& end : ends) sum += end.point;
    const Vector3 middle = sum / static_cast<double>(ends.size());
    for (const CurveEnd& end : ends) {
      CadEdge& edge = shape_.edges[end.edge];
      (end.last ? edge.last_vertex : edge.first_vertex) = vertex;
      tolerance = std::max(tolerance, (end.point - middle).norm());
      touched_.insert(end.edge);
    }
    shape_.vertices[vertex] = middle;
    shape_.vertex_tolerances[vertex] = tolerance;
  }

  /// Removes dangling edges (no other edge shares one of their ends) from all wires, one at a time.
  void drop_dangling() {
    for (bool changed = true; changed;) {
      changed = false;
      IdVector<VertexId, int> uses(shape_.vertices.size());
      for (const CadEdge& edge : shape_.edges) {
        if (edge.faces.empty() || edge.degenerate) continue;
        for (const VertexId vertex : {edge.first_vertex, edge.last_vertex}) {
          if (vertex.exists()) ++uses[vertex];
        }
      }
      for (const EdgeId id : touched_) {
        CadEdge& edge = shape_.edges[id];
        if (edge.faces.empty() || edge.closed()) continue;
        const auto is_shared = [&](VertexId vertex) { return vertex.exists() && uses[vertex] > 1; };
        if (is_shared(edge.first_vertex) && is_shared(edge.last_vertex)) continue;
        shape_.problems.push_back(fmt::format("Edge{} is a dangling edge and is left out", edge.number));
        for (const FaceId face : edge.faces) drop_from(shape_.faces[face], id);
        edge.faces.clear();
        changed = true;
        break;
      }
    }
  }

  static void drop_from(CadFace& face, EdgeId edge) {
    for (CadWire& wire : face.wires)
      std::erase_if(wire.coedges, [&](const Coedge& coedge) { return coedge.edge == edge; });
    std::erase_if(face.wires, [](const CadWire& wire) { return wire.coedges.empty(); });
  }

  /// Closes gaps between the end of a coedge and the start of the next one by an edge of a split vertex.
  void close_wires(FaceId id) {
    CadFace& face = shape_.faces[id];
    for (CadWire& wire : face.wires) {
      for (std::size_t i = 0; i < wire.coedges.size(); ++i) {
        const Coedge& now = wire.coedges[i];
        const Coedge& next = wire.coedges[(i + 1) % wire.coedges.size()];
        if (!touched_.contains(now.edge) || !touched_.contains(next.edge)) continue;
        if (shape_.end_of(now) == shape_.start_of(next)) continue;
        Coedge link = link_between(face, shape_.end_of(now), shape_.start_of(next));
        if (!link.edge.exists()) continue;
        CadEdge& edge = shape_.edges[link.edge];
        edge.faces.insert(std::upper_bound(edge.faces.begin(), edge.faces.end(), id), id);
        shape_.problems.push_back(
            fmt::format("a wire of Face{} is open: Edge{} closes it", id.number(), edge.number));
        wire.coedges.insert(wire.coedges.begin() + static_cast<long>(i) + 1, std::move(link));
      }
    }
  }

  /// An edge of a split vertex that lies on the face and joins these two vertices; without an edge if there
  /// is none.
  Coedge link_between(const CadFace& face, VertexId from, VertexId to) const {
    for (const EdgeId id : touched_) {
      const CadEdge& edge = shape_.edges[id];
      const bool forward = edge.first_vertex == from && edge.last_vertex == to;
      if (!forward && !(edge.first_vertex == to && edge.last_vertex == from)) continue;
      double first = 0, last = 0;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge.edge, first, last);
      const Handle(Geom_Surface) surface = BRep_Tool::Surface(face.face);
      if (curve.IsNull() || surface.IsNull()) continue;
      Coedge link;
      double tolerance = edge.tolerance;
      link.parametric_curve = GeomProjLib::Curve2d(curve, first, last, surface, face.u_min, face.u_max,
                                                   face.v_min, face.v_max, tolerance);
      if (link.parametric_curve.IsNull()) continue;
      link.edge = id;
      link.forward = forward;
      link.source = TopoDS::Edge(edge.edge.Oriented(forward ? TopAbs_FORWARD : TopAbs_REVERSED));
      const gp_Pnt2d middle = link.parametric_curve->Value(0.5 * (first + last));
      const Vector3 on_face = to_vector(surface->Value(middle.X(), middle.Y()));
      if ((on_face - point_on(edge, 0.5)).norm() <= 0.01 * edge.length) return link;
    }
    return {};
  }

  CadShape& shape_;
  IdVector<VertexId, std::vector<CurveEnd>> ends_;  ///< as they were at first
  std::set<EdgeId> touched_;                        ///< edges whose vertices changed
};

}  // namespace

void trust_curve_ends(CadShape& shape) {
  CurveEndMender(shape).run();
}

}  // namespace quadrille
