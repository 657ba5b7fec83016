/// Joins the wires' coedges, moved by periods where needed; adds points along poles and unites equal ones.

#include "mesher/faces/face_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

/// Number of segments along a pole: as many as elements meet there, so that triangles fan out evenly.
constexpr int pole_segments = 6;

/// Points closer than this share of the segments beside them are one point.
constexpr double nearness = 0.01;

double scaled_distance(const FaceBoundary& boundary, const Vector2& scale, int a, int b) {
  return (boundary.uv[a] - boundary.uv[b]).cwiseProduct(scale).norm();
}

/// A place inside the face, moved by whole periods into what the wires enclose.
Vector2 enclosed(const FaceBoundary& boundary, const FaceSurface& surface, const Vector2& uv) {
  const TrimmedDomain domain = enclosed_domain(boundary);
  const Vector2 middle = 0.5 * (domain.low() + domain.high());
  for (const int i : {0, -1, 1}) {
    for (const int k : {0, -1, 1}) {
      if ((i != 0 && !surface.u_periodic()) || (k != 0 && !surface.v_periodic())) continue;
      Vector2 moved = uv;
      if (surface.u_periodic())
        moved.x() += surface.u_period() * (i + std::round((middle.x() - uv.x()) / surface.u_period()));
      if (surface.v_periodic())
        moved.y() += surface.v_period() * (k + std::round((middle.y() - uv.y()) / surface.v_period()));
      if (domain.inside(moved)) return moved;
    }
  }
  return uv;
}

/// Moves wires by whole periods to the widest one: in files, holes may be a period away. \param starts first
/// point of each wire, then the number of points
void gather_wires(FaceBoundary& boundary, const std::vector<int>& starts, int axis, double period) {
  std::vector<std::pair<double, double>> ranges;
  std::pair<double, double> widest{0, 0};
  for (std::size_t wire = 0; wire + 1 < starts.size(); ++wire) {
    auto& [low, high] = ranges.emplace_back(std::numeric_limits<double>::infinity(),
                                            -std::numeric_limits<double>::infinity());
    for (int i = starts[wire]; i < starts[wire + 1]; ++i) {
      low = std::min(low, boundary.uv[i][axis]);
      high = std::max(high, boundary.uv[i][axis]);
    }
    if (high - low > widest.second - widest.first) widest = {low, high};
  }
  for (std::size_t wire = 0; wire + 1 < starts.size(); ++wire) {
    const auto [low, high] = ranges[wire];
    // Moves only wires that lie outside entirely: one that reaches over an end belongs there.
    if (!(low >= widest.second) && !(high <= widest.first)) continue;
    const double away = 0.5 * (widest.first + widest.second - low - high);
    const double shift = period * std::round(away / period);
    for (int i = starts[wire]; i < starts[wire + 1]; ++i) boundary.uv[i][axis] += shift;
    for (auto& segment : boundary.segments) {
      if (segment.a >= starts[wire] && segment.a < starts[wire + 1]) segment.middle_uv[axis] += shift;
    }
  }
}

std::vector<int> numbers_to(int count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Drops points that others take the place of. \param target (points) the one that does, or the point itself
void unite_points(FaceBoundary& boundary, const std::vector<int>& target) {
  std::vector<int> renumbered(boundary.size(), -1);
  int n = 0;
  for (int i = 0; i < boundary.size(); ++i) {
    if (target[i] != i) continue;
    renumbered[i] = n;
    boundary.uv[n] = boundary.uv[i];
    boundary.points[n] = boundary.points[i];
    boundary.nodes[n] = boundary.nodes[i];
    boundary.angles[n] = boundary.angles[i];
    ++n;
  }
  boundary.uv.resize(n);
  boundary.points.resize(n);
  boundary.nodes.resize(n);
  boundary.angles.resize(n);
  for (auto& segment : boundary.segments) {
    segment.a = renumbered[target[segment.a]];
    segment.b = renumbered[target[segment.b]];
  }
}

/// Merges points where wires touch, as a hole and a seam may, and along slits.
void join_touching(FaceBoundary& boundary, const Vector2& scale) {
  const auto distance = [&](int a, int b) { return scaled_distance(boundary, scale, a, b); };
  std::vector<double> reach(boundary.size(), std::numeric_limits<double>::infinity());
  for (const auto& segment : boundary.segments) {
    const double length = nearness * distance(segment.a, segment.b);
    for (const int i : {segment.a, segment.b}) reach[i] = std::min(reach[i], length);
  }
  std::vector<int> order = numbers_to(boundary.size()), target = order;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return boundary.nodes[a] < boundary.nodes[b]; });
  std::vector<int> kept;  // points of the current node that are not joined to others
  for (const int i : order) {
    if (!kept.empty() && boundary.nodes[kept.front()] != boundary.nodes[i]) kept.clear();
    const auto near = std::find_if(kept.begin(), kept.end(), [&](int other) {
      return distance(other, i) <= std::min(reach[i], reach[other]);
    });
    if (near != kept.end()) {
      target[i] = *near;
      boundary.angles[*near] = 0;
    } else {
      kept.push_back(i);
    }
  }
  unite_points(boundary, target);
}

class BoundaryWalker {
 public:
  BoundaryWalker(const CadShape& shape, FaceId id, const CadFace& face, const FaceSurface& surface,
                 const BoundaryNodes& nodes)
      : shape_(shape), id_(id), face_(face), surface_(surface), scale_(surface.mean_scale()), nodes_(nodes) {
    boundary_.stride = nodes.plans[id].stride;
  }

  FaceBoundary walk() {
    std::vector<int> starts;
    for (const CadWire& wire : face_.wires) {
      starts.push_back(boundary_.size());
      walk_wire(wire);
    }
    starts.push_back(boundary_.size());
    if (surface_.u_periodic()) gather_wires(boundary_, starts, 0, surface_.u_period());
    if (surface_.v_periodic()) gather_wires(boundary_, starts, 1, surface_.v_period());
    join_touching(boundary_, scale_);
    for (const InnerVertex& inner : face_.inner_vertices) {
      const int node = nodes_.vertex_nodes[inner.vertex];
      add_point(surface_.is_view() ? surface_.seen_at(nodes_.points[node])
                                   : enclosed(boundary_, surface_, inner.uv),
                node);
    }
    return std::move(boundary_);
  }

 private:
  struct Run {
    int first = -1, last = -1;  // point instances at the start and the end, in the wire's direction
    int first_segment = 0, end_segment = 0;
    bool after_gap = false;                       // the edges just before it became points
    Vector3 leaving{0, 0, 0}, arriving{0, 0, 0};  // tangents at start and end, in the wire's direction
  };

  void add_point_segment(int a, int b) {
    boundary_.segments.push_back({.a = a, .b = b, .edge = {}, .degenerate = true});
  }

  int add_point(const Vector2& uv, int node) { return boundary_.add(uv, nodes_.points[node], node); }

  /// First gives each coedge its own end points, then joins consecutive coedges.
  void walk_wire(const CadWire& wire) {
    std::vector<Run> runs;
    auto& firsts = boundary_.first_segments.emplace_back();
    bool gap = false;
    for (std::size_t i = 0; i < wire.coedges.size(); ++i) {
      const Coedge& coedge = wire.coedges[i];
      const CadEdge& edge = shape_.edges[coedge.edge];
      Run run = edge.degenerate ? walk_pole(wire, i, edge) : walk_edge(coedge);
      firsts.push_back(run.first >= 0 ? run.first_segment : -1);
      run.after_gap = gap;
      gap = run.first < 0 && !edge.degenerate;
      if (run.first >= 0) runs.push_back(run);
    }
    const std::size_t n = runs.size();
    if (gap && n > 0) runs[0].after_gap = true;
    for (std::size_t i = 1; i < n; ++i) unwrap(runs[i - 1], runs[i]);
    std::vector<int> target = numbers_to(boundary_.size());
    for (std::size_t i = 0; i < n; ++i) join(runs[i], runs[(i + 1) % n], target);
    unite_points(boundary_, target);
  }

  /// Moves a coedge by whole periods to the end of the one before it: in files they may be periods apart.
  void unwrap(const Run& previous, const Run& run) {
    if (boundary_.nodes[previous.last] != boundary_.nodes[run.first]) return;
    const Vector2 jump = boundary_.uv[run.first] - boundary_.uv[previous.last];
    Vector2 shift(0, 0);
    if (surface_.u_periodic()) shift.x() = surface_.u_period() * std::round(jump.x() / surface_.u_period());
    if (surface_.v_periodic()) shift.y() = surface_.v_period() * std::round(jump.y() / surface_.v_period());
    if (shift.isZero() || is_one_point(boundary_.uv[previous.last], boundary_.uv[run.first])) return;
    for (int point = run.first; point <= run.last; ++point) boundary_.uv[point] -= shift;
    for (int i = run.first_segment; i < run.end_segment; ++i) boundary_.segments[i].middle_uv -= shift;
  }

  /// Whether the line between two places in the parameter plane is a single point in space, a pole.
  bool is_one_point(const Vector2& from, const Vector2& to) const {
    const double reach = nearness * (to - from).cwiseProduct(scale_).norm();
    const Vector3 first = surface_.point(from);
    for (const double t : {0.25, 0.5, 0.75}) {
      if (!((surface_.point((1 - t) * from + t * to) - first).norm() <= reach)) return false;
    }
    return true;
  }

  /// Node i of an edge in the parameter plane. \param curve the edge's
  Vector2 place_of(const Coedge& coedge, const EdgeCurve& curve, const BoundaryNodes::Edge& edge,
                   int i) const {
    const Vector3& node = nodes_.points[edge.nodes[i]];
    if (surface_.is_view()) return surface_.seen_at(node);
    Vector2 uv = parametric_point(coedge, edge.parameters[i]);
    const CadEdge& cad = shape_.edges[coedge.edge];
    const VertexId end = i == 0 ? cad.first_vertex : i == edge.segments() ? cad.last_vertex : VertexId();
    if (!edge.borrows && !end.exists()) return uv;
    // A node that stands for suppressed features is not on the edge's own curve.
    constexpr double tolerances = 10;
    double tolerance = edge.borrows ? 0 : tolerances * std::max(face_.tolerance, cad.tolerance);
    if (end.exists()) tolerance = std::max(tolerance, 2 * shape_.vertex_tolerances[end]);
    if (!((curve.point(edge.parameters[i]) - node).norm() > tolerance)) return uv;
    Vector2 moved = uv;
    const double distance = (surface_.point(uv) - node).norm();
    return (surface_.project(moved, node).point - node).norm() < distance ? moved : uv;
  }

  Run walk_edge(const Coedge& coedge) {
    const BoundaryNodes::Edge& edge = nodes_.edges[coedge.edge];
    const int first = coedge.forward ? 0 : edge.segments();
    const int count = edge.segments() / boundary_.stride;
    if (count <= 0 || nodes_.left_out.contains({id_, coedge.edge})) return {};
    const EdgeCurve curve(shape_.edges[coedge.edge]);
    Run run;
    run.first_segment = static_cast<int>(boundary_.segments.size());
    for (int k = 0; k <= count; ++k) {
      const int i = first + boundary_.stride * (coedge.forward ? k : -k);
      const int point = add_point(place_of(coedge, curve, edge, i), edge.nodes[i]);
      if (k == 0) {
        run.first = point;
        continue;
      }
      FaceBoundary::Segment segment;
      segment.a = point - 1;
      segment.b = point;
      segment.edge = coedge.edge;
      segment.coedge = &coedge;
      segment.from = edge.parameters[i + (coedge.forward ? -boundary_.stride : boundary_.stride)];
      segment.to = edge.parameters[i];
      segment.internal = coedge.internal;
      if (boundary_.stride == 2) {
        const int middle = i + (coedge.forward ? -1 : 1);
        segment.middle_node = edge.nodes[middle];
        segment.middle_uv = place_of(coedge, curve, edge, middle);
        segment.middle_point = nodes_.points[segment.middle_node];
      }
      boundary_.segments.push_back(segment);
      run.last = point;
    }
    run.end_segment = static_cast<int>(boundary_.segments.size());
    const double sense = coedge.forward ? 1 : -1;
    run.leaving = sense * curve.derivative(edge.parameters[first]);
    run.arriving = sense * curve.derivative(boundary_.segments.back().to);
    for (int point = run.first + 1; point < run.last; ++point) boundary_.angles[point] = M_PI;
    return run;
  }

  Run walk_pole(const CadWire& wire, std::size_t at, const CadEdge& edge) {
    const Coedge& coedge = wire.coedges[at];
    const int node = edge.first_vertex.exists() ? nodes_.vertex_nodes[edge.first_vertex] : -1;
    const Coedge& next = wire.coedges[(at + 1) % wire.coedges.size()];
    if (node < 0 || surface_.is_view() || nodes_.left_out.contains({id_, next.edge})) return {};
    Vector2 from = parametric_point(coedge, edge.first), to = parametric_point(coedge, edge.last);
    // CAD translators also close wires with edges marked degenerate that are not poles.
    if (!is_one_point(from, to)) return {};
    if (!coedge.forward) std::swap(from, to);
    const int count = is_tip(wire, at) ? 1 : pole_segments;
    Run run;
    run.first_segment = static_cast<int>(boundary_.segments.size());
    run.first = add_point(from, node);
    for (int k = 1; k <= count; ++k) {
      const double t = static_cast<double>(k) / count;
      run.last = add_point((1 - t) * from + t * to, node);
      add_point_segment(run.last - 1, run.last);
    }
    run.end_segment = static_cast<int>(boundary_.segments.size());
    return run;
  }

  /// Whether the face is so narrow between the coedges beside a pole that no elements fit side by side.
  bool is_tip(const CadWire& wire, std::size_t at) const {
    constexpr double narrow = 0.35;  // radians
    const std::size_t n = wire.coedges.size();
    const Coedge &before = wire.coedges[(at + n - 1) % n], &after = wire.coedges[(at + 1) % n];
    const BoundaryNodes::Edge &arriving = nodes_.edges[before.edge], &leaving = nodes_.edges[after.edge];
    if (arriving.segments() < boundary_.stride || leaving.segments() < boundary_.stride) return false;
    const int from = before.forward ? arriving.segments() - boundary_.stride : boundary_.stride;
    const int to = after.forward ? boundary_.stride : leaving.segments() - boundary_.stride;
    const Vector2 a = place_of(before, EdgeCurve(shape_.edges[before.edge]), arriving, from),
                  b = place_of(after, EdgeCurve(shape_.edges[after.edge]), leaving, to);
    const Vector3 &pole = nodes_.points[leaving.nodes[after.forward ? 0 : leaving.segments()]],
                  &p = nodes_.points[arriving.nodes[from]], &q = nodes_.points[leaving.nodes[to]];
    double width = 0;
    constexpr int pieces = 8;
    for (int i = 0; i < pieces; ++i) {
      const double s = static_cast<double>(i) / pieces, t = static_cast<double>(i + 1) / pieces;
      width += (surface_.point((1 - t) * a + t * b) - surface_.point((1 - s) * a + s * b)).norm();
    }
    return width < narrow * std::min((p - pole).norm(), (q - pole).norm());
  }

  /// Merges the end of one coedge with the start of the next. A jump between them at the same node is a pole
  /// that the file does not mark. \param target gets the point that takes the place of the end
  void join(const Run& run, const Run& next, std::vector<int>& target) {
    const int a = run.last, b = next.first;
    if (a == b || boundary_.nodes[a] != boundary_.nodes[b]) return;
    const auto& last = boundary_.segments[run.end_segment - 1];
    const auto& first = boundary_.segments[next.first_segment];
    const double nearby = std::max(scaled_distance(boundary_, scale_, last.a, last.b),
                                   scaled_distance(boundary_, scale_, first.a, first.b));
    const double jump = scaled_distance(boundary_, scale_, a, b);
    if (jump > 0.5 * nearby && !next.after_gap) return add_point_segment(a, b);
    boundary_.uv[b] = 0.5 * (boundary_.uv[a] + boundary_.uv[b]);
    if (run.arriving.norm() * next.leaving.norm() > 0) {
      const Vector3 normal = surface_.normal(boundary_.uv[b]);
      boundary_.angles[b] =
          M_PI - std::atan2(run.arriving.cross(next.leaving).dot(normal), run.arriving.dot(next.leaving));
    }
    target[a] = b;
  }

  const CadShape& shape_;
  FaceId id_;
  const CadFace& face_;
  const FaceSurface& surface_;
  Vector2 scale_;
  const BoundaryNodes& nodes_;
  FaceBoundary boundary_;
};

}  // namespace

FaceBoundary face_boundary(const CadShape& shape, FaceId face, const CadFace& cad_face,
                           const FaceSurface& surface, const BoundaryNodes& nodes) {
  FaceBoundary boundary = BoundaryWalker(shape, face, cad_face, surface, nodes).walk();
  const std::string name = fmt::format("Face{}", face.number());
  if (boundary.segments.empty())
    throw failure(name, fmt::format("{} has no usable boundary in its parameter plane", name));
  constexpr double largest = 1e50;  // products of several must not overflow
  const auto finite = [&](const auto& p) { return p.cwiseAbs().maxCoeff() < largest; };
  if (!std::all_of(boundary.uv.begin(), boundary.uv.end(), finite) ||
      !std::all_of(boundary.points.begin(), boundary.points.end(), finite))
    throw failure(name, fmt::format("the boundary of {} runs to infinity: the file may be damaged", name));
  return boundary;
}

FaceBoundary halved(FaceBoundary boundary) {
  if (boundary.stride == 1) return boundary;
  boundary.stride = 1;
  std::vector<int> shift(boundary.segments.size() + 1, 0);
  std::vector<FaceBoundary::Segment> segments;
  for (std::size_t i = 0; i < boundary.segments.size(); ++i) {
    const FaceBoundary::Segment& whole = boundary.segments[i];
    shift[i] = static_cast<int>(segments.size());
    segments.push_back(whole);
    if (whole.degenerate || whole.middle_node == -1) continue;
    FaceBoundary::Segment second = whole, &first = segments.back();
    first.b = second.a = boundary.add(whole.middle_uv, whole.middle_point, whole.middle_node, M_PI);
    first.to = second.from = 0.5 * (whole.from + whole.to);
    first.middle_node = second.middle_node = -1;
    segments.push_back(second);
  }
  for (auto& wire : boundary.first_segments) {
    for (int& first : wire) first = first < 0 ? first : shift[first];
  }
  boundary.segments = std::move(segments);
  return boundary;
}

TrimmedDomain enclosed_domain(const FaceBoundary& boundary) {
  std::vector<TrimmedDomain::Segment> segments;
  segments.reserve(boundary.segments.size());
  for (const auto& segment : boundary.segments) {
    if (!segment.internal) segments.push_back({boundary.uv[segment.a], boundary.uv[segment.b]});
  }
  return TrimmedDomain(std::move(segments));
}

}  // namespace quadrille
