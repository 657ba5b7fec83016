/// Walks both edges out of a narrow corner to where they are one width apart, and merges their nodes there.

#include "mesher/edges/tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "geometry/base/nearest_on_segment.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// A tip is at least this many times as long as it is wide: an angle of 23 degrees between straight edges.
constexpr double least_slenderness = 2.5;
/// Directions at the tip farther apart than this are not looked at.
constexpr double least_cosine = 0.85;
/// Tips end on this share of their edges, so that those at the two ends of an edge do not meet.
constexpr double most_of_edge = 0.4;

/// The part of an edge near one of its ends, in samples that get sparser away from it.
struct Arm {
  std::vector<double> parameters;
  std::vector<Vector3> points;
};

struct Place {
  double distance = std::numeric_limits<double>::infinity();
  double parameter = 0;
  Vector3 point{0, 0, 0};
};

Place nearest_on(const Arm& arm, const Vector3& p) {
  Place result;
  for (std::size_t i = 0; i + 1 < arm.points.size(); ++i) {
    const double t = nearest_share(arm.points[i], arm.points[i + 1], p);
    const Vector3 point = arm.points[i] + t * (arm.points[i + 1] - arm.points[i]);
    const double distance = (p - point).norm();
    if (distance < result.distance)
      result = {distance, arm.parameters[i] + t * (arm.parameters[i + 1] - arm.parameters[i]), point};
  }
  return result;
}

class TipFinder {
 public:
  TipFinder(const CadShape& shape, const TinyFeatures& tiny, double width)
      : shape_(shape), tiny_(tiny), width_(width) {}

  void find(FaceId id) {
    std::vector<const Coedge*> arriving;
    std::multimap<VertexId, const Coedge*> leaving;  // wires may touch at a vertex
    for (const CadWire& wire : shape_.faces[id].wires) {
      for (const Coedge& coedge : wire.coedges) {
        if (!wire.ordered || tiny_.collapsed_edges[coedge.edge] || !may_end(id, coedge)) continue;
        arriving.push_back(&coedge);
        leaving.emplace(end_of(coedge, !coedge.forward), &coedge);
      }
    }
    for (const Coedge* before : arriving) {
      const auto [first, last] = leaving.equal_range(end_of(*before, before->forward));
      for (auto after = first; after != last; ++after) add(id, *before, *after->second);
    }
  }

  std::vector<Tip> take() { return std::move(found_); }

 private:
  bool may_end(FaceId id, const Coedge& coedge) const {
    const CadEdge& edge = shape_.edges[coedge.edge];
    return !coedge.internal && !edge.degenerate && edge.first_vertex.exists() && edge.last_vertex.exists() &&
           tiny_.edges[coedge.edge] == coedge.edge &&
           most_of_edge * edge.length > least_slenderness * width_ &&
           std::count(edge.faces.begin(), edge.faces.end(), id) == 1;
  }

  VertexId end_of(const Coedge& coedge, bool last) const {
    const CadEdge& edge = shape_.edges[coedge.edge];
    return tiny_.end(last ? edge.last_vertex : edge.first_vertex);
  }

  void add(FaceId id, const Coedge& before, const Coedge& after) {
    const std::pair arrival{before.edge, before.forward}, departure{after.edge, !after.forward};
    if (before.edge == after.edge || taken_.contains(arrival) || taken_.contains(departure)) return;
    const auto tip = tip_between(id, before, after);
    if (!tip) return;
    taken_.insert({arrival, departure});
    found_.push_back(*tip);
  }

  std::optional<Tip> tip_between(FaceId id, const Coedge& before, const Coedge& after) const {
    const CadEdge &a = shape_.edges[before.edge], &b = shape_.edges[after.edge];
    const EdgeCurve first(a), second(b);
    const Vector3 to = (before.forward ? -1 : 1) * first.derivative(before.forward ? a.last : a.first),
                  from = (after.forward ? 1 : -1) * second.derivative(after.forward ? b.first : b.last);
    if (!(to.dot(from) > least_cosine * to.norm() * from.norm())) return std::nullopt;
    const Arm one = arm_of(a, !before.forward, first), two = arm_of(b, after.forward, second);
    const auto end = width_reached(one, two, first);
    if (!end) return std::nullopt;
    const Place facing = nearest_on(two, end->point);
    const double least = least_slenderness * width_;
    const Vector3& tip = one.points.front();
    if (!((end->point - tip).norm() > least) || !((facing.point - tip).norm() > least)) return std::nullopt;
    if (!lies_between(id, before, first, *end, facing)) return std::nullopt;
    return Tip{
        id, {before.edge, before.forward, end->parameter}, {after.edge, !after.forward, facing.parameter}};
  }

  Arm arm_of(const CadEdge& edge, bool from_start, const EdgeCurve& curve) const {
    constexpr double finer = 0.1, growth = 1.15;
    Arm arm;
    const double range = (edge.last - edge.first) / edge.length;
    double s = 0, step = finer * width_;
    while (s < most_of_edge * edge.length) {
      arm.parameters.push_back(from_start ? edge.first + s * range : edge.last - s * range);
      arm.points.push_back(curve.point(arm.parameters.back()));
      s += step;
      step *= growth;
    }
    return arm;
  }

  /// The place on an arm where the other one is first as far away as the width.
  std::optional<Place> width_reached(const Arm& arm, const Arm& other, const EdgeCurve& curve) const {
    std::size_t i = 1;
    while (i < arm.points.size() && nearest_on(other, arm.points[i]).distance < width_) ++i;
    if (i >= arm.points.size()) return std::nullopt;
    double low = arm.parameters[i - 1], high = arm.parameters[i];
    constexpr int halvings = 12;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (nearest_on(other, curve.point(middle)).distance < width_ ? low : high) = middle;
    }
    return Place{width_, low, curve.point(low)};
  }

  /// Whether the face lies between the two places, to the left of its wire, rather than around them.
  bool lies_between(FaceId id, const Coedge& before, const EdgeCurve& curve, const Place& end,
                    const Place& facing) const {
    const FaceSurface surface(shape_.faces[id]);
    const Vector3 normal = surface.normal(parametric_point(before, end.parameter)),
                  along = (before.forward ? 1 : -1) * curve.derivative(end.parameter);
    return normal.cross(along).dot(facing.point - end.point) > 0;
  }

  const CadShape& shape_;
  const TinyFeatures& tiny_;
  double width_;
  std::set<std::pair<EdgeId, bool>> taken_;  // edge and whether at its last vertex
  std::vector<Tip> found_;
};

class TipEnder {
 public:
  TipEnder(const CadShape& shape, const TinyFeatures& tiny, BoundaryNodes& nodes)
      : shape_(shape), tiny_(tiny), nodes_(nodes) {}

  void end(const Tip& tip) {
    if (tiny_.merged_faces[tip.face] || !is_whole(tip.before) || !is_whole(tip.after)) return;
    const int count = std::min(segments_before(tip.before), segments_before(tip.after));
    if (count == 0 || !follow(tip.before, tip.after, count)) return;
    BoundaryNodes::Edge& follower = nodes_.edges[tip.after.edge];
    follower.borrowed[tip.after.at_end ? 1 : 0] = count;
    for (const Tip::Flank* side : {&tip.before, &tip.after})
      nodes_.unused[{tip.face, side->edge}][side->at_end ? 1 : 0] = count;
  }

 private:
  /// Whether the edge and the faces beside it are unchanged, and its nodes are not prescribed.
  bool is_whole(const Tip::Flank& side) const {
    const auto& faces = shape_.edges[side.edge].faces;
    const BoundaryNodes::Edge& edge = nodes_.edges[side.edge];
    return tiny_.edges[side.edge] == side.edge && !tiny_.collapsed_edges[side.edge] && !edge.divided &&
           !edge.kept && std::none_of(faces.begin(), faces.end(), [&](FaceId face) {
             return tiny_.merged_faces[face] != 0;
           });
  }

  /// The index of the node that is k segments from the tip.
  int at(const Tip::Flank& side, int k) const {
    return side.at_end ? nodes_.edges[side.edge].segments() - k : k;
  }

  /// The number of segments of an edge between its tip and the place where the face is wide enough: an even
  /// one, that leaves some.
  int segments_before(const Tip::Flank& side) const {
    constexpr int left = 4;
    const BoundaryNodes::Edge& edge = nodes_.edges[side.edge];
    int count = 0;
    while (count + 1 + left + edge.borrowed[side.at_end ? 0 : 1] <= edge.segments() &&
           (edge.parameters[at(side, count + 1)] - side.parameter) * (side.at_end ? 1 : -1) > 0)
      ++count;
    return count - count % 2;
  }

  /// Gives the first `count` nodes of one edge to the other one, and spreads the rest of its nodes.
  bool follow(const Tip::Flank& leader, const Tip::Flank& follower, int count) {
    const BoundaryNodes::Edge& from = nodes_.edges[leader.edge];
    BoundaryNodes::Edge& to = nodes_.edges[follower.edge];
    const EdgeCurve curve(shape_.edges[follower.edge]);
    const int last = to.segments() - to.borrowed[follower.at_end ? 0 : 1];
    const double start = to.parameters[at(follower, 0)], end = to.parameters[at(follower, last)];
    const double before = to.parameters[at(follower, count)];
    Arm arm;
    constexpr int samples = 8;
    for (int k = 0; k < count + 2; ++k) {
      const double a = to.parameters[at(follower, k)], b = to.parameters[at(follower, k + 1)];
      for (int i = 0; i < samples; ++i) {
        arm.parameters.push_back(a + (b - a) * i / samples);
        arm.points.push_back(curve.point(arm.parameters.back()));
      }
    }
    std::vector<double> parameters = to.parameters;
    for (int k = 1; k <= count; ++k)
      parameters[at(follower, k)] = nearest_on(arm, nodes_.points[from.nodes[at(leader, k)]]).parameter;
    const double now = parameters[at(follower, count)];
    // The remaining nodes must not be squeezed or stretched much.
    constexpr double most_stretch = 1.25;
    const double scale = (end - now) / (end - before);
    if (!(scale < most_stretch) || !(scale > 1 / most_stretch)) return false;
    for (int k = count + 1; k < last; ++k)
      parameters[at(follower, k)] = now + scale * (to.parameters[at(follower, k)] - before);
    for (int k = 0; k < last; ++k) {
      if (!((parameters[at(follower, k + 1)] - parameters[at(follower, k)]) * (end - start) > 0))
        return false;
    }
    to.parameters = parameters;
    for (int k = 1; k <= count; ++k) to.nodes[at(follower, k)] = from.nodes[at(leader, k)];
    for (int k = count + 1; k < last; ++k)
      nodes_.points[to.nodes[at(follower, k)]] = curve.point(parameters[at(follower, k)]);
    return true;
  }

  const CadShape& shape_;
  const TinyFeatures& tiny_;
  BoundaryNodes& nodes_;
};

}  // namespace

std::vector<Tip> find_tips(const CadShape& shape, const FaceFlags& used, const TinyFeatures& tiny,
                           double width) {
  if (!(width > 0)) return {};
  TipFinder finder(shape, tiny, width);
  for (const FaceId face : used.ids()) {
    if (used[face]) finder.find(face);
  }
  return finder.take();
}

void end_faces_at_tips(const CadShape& shape, const std::vector<Tip>& tips, const TinyFeatures& tiny,
                       BoundaryNodes& nodes) {
  TipEnder ender(shape, tiny, nodes);
  for (const Tip& tip : tips) ender.end(tip);
}

}  // namespace quadrille
