/// Walks both edges out of a narrow corner to where they are one width apart, or to where the shorter one
/// ends.

#include "mesher/edges/slivers.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// Directions at the corner farther apart than this are not looked at.
constexpr double least_cosine = 0.85;

/// An edge from the corner to its other end, in samples that get sparser.
struct Arm : CurveSamples {
  EdgeCurve curve;
};

/// The place on an arm where the other one is first as far away as the limit; none if it is nowhere.
std::optional<CurvePlace> limit_reached(const Arm& arm, const Arm& other, double limit) {
  std::size_t i = 1;
  while (i < arm.points.size() && other.nearest(arm.points[i]).distance < limit) ++i;
  if (i >= arm.points.size()) return std::nullopt;
  double low = arm.parameters[i - 1], high = arm.parameters[i];
  constexpr int halvings = 12;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (other.nearest(arm.curve.point(middle)).distance < limit ? low : high) = middle;
  }
  return CurvePlace{limit, low, arm.curve.point(low)};
}

class SpikeFinder {
 public:
  SpikeFinder(const CadShape& shape, const FaceFlags& used, FaceId id, double width, EdgeEnds& taken,
              std::vector<EdgeCut>& cuts)
      : shape_(shape), used_(used), id_(id), width_(width), taken_(taken), cuts_(cuts) {}

  std::vector<Sliver> run() && {
    std::vector<const Coedge*> arriving;
    std::multimap<VertexId, const Coedge*> leaving;  // wires may touch at a vertex
    for (const CadWire& wire : shape_.faces[id_].wires) {
      if (!wire.ordered) continue;
      std::vector<const Coedge*> coedges;
      for (const Coedge& coedge : wire.coedges)
        if (!is_small(shape_.edges[coedge.edge], width_)) coedges.push_back(&coedge);
      for (std::size_t i = 0; i < coedges.size(); ++i) {
        leaving.emplace(shape_.start_of(*coedges[i]), coedges[i]);
        arriving.push_back(coedges[i]);
        add(*coedges[i], *coedges[(i + 1) % coedges.size()]);
      }
    }
    for (const Coedge* before : arriving) {
      const auto [first, last] = leaving.equal_range(shape_.end_of(*before));
      for (auto after = first; after != last; ++after) add(*before, *after->second);
    }
    return std::move(found_);
  }

 private:
  bool may_narrow(const Coedge& coedge) const {
    const CadEdge& edge = shape_.edges[coedge.edge];
    return !coedge.internal && has_ends(edge) && std::ranges::count(edge.faces, id_) == 1;
  }

  void add(const Coedge& before, const Coedge& after) {
    const std::pair arrival{before.edge, before.forward}, departure{after.edge, !after.forward};
    if (before.edge == after.edge || taken_.contains(arrival) || taken_.contains(departure)) return;
    const bool has_neighbor = shape_.edges[before.edge].is_used_beside(id_, used_) ||
                              shape_.edges[after.edge].is_used_beside(id_, used_);
    if (has_neighbor && may_narrow(before) && may_narrow(after) && look_between(before, after))
      taken_.insert({arrival, departure});
  }

  /// \return whether there is a spike, or will be one once edges are divided.
  bool look_between(const Coedge& before, const Coedge& after) {
    const CadEdge &a = shape_.edges[before.edge], &b = shape_.edges[after.edge];
    EdgeCurve first(a), second(b);
    const Vector3 to = (before.forward ? -1 : 1) * first.derivative(before.forward ? a.last : a.first),
                  from = (after.forward ? 1 : -1) * second.derivative(after.forward ? b.first : b.last);
    if (!(to.dot(from) > least_cosine * to.norm() * from.norm())) return false;
    const Arm one = arm_of(a, !before.forward, std::move(first)),
              two = arm_of(b, after.forward, std::move(second));
    const double narrow = std::min(a.length, b.length) / least_slenderness, close = std::min(width_, narrow);
    const Vector3 &last = one.points.back(), &other_last = two.points.back();
    if ((last - other_last).norm() < width_ && !limit_reached(one, two, close) &&
        !limit_reached(two, one, close)) {
      if (!lies_between(before, one.parameters.back(), one.curve, other_last)) return false;
      // Vertices that share a node have it where the first of them lies: on the edge that keeps its nodes.
      const VertexId end = shape_.start_of(before), other_end = shape_.end_of(after);
      const auto [edge, other] = std::minmax({std::pair(end, before.edge), std::pair(other_end, after.edge)});
      found_.push_back({.face = id_,
                        .pairs = {{edge.second, other.second, before.forward == after.forward}},
                        .ties = {{end, other_end}},
                        .joints = {{shape_.end_of(before), shape_.start_of(after)}},
                        .rims = {},
                        .is_spike = true});
      return true;
    }
    // Once divided there, the edges are closer than the width from end to end.
    constexpr double below = 0.9;
    const double limit = std::min(below * width_, narrow);
    const std::optional<CurvePlace> end = limit_reached(one, two, limit),
                                    other = limit_reached(two, one, limit);
    const CurvePlace facing = two.nearest(end ? end->point : last);
    if (!lies_between(before, end ? end->parameter : one.parameters.back(), one.curve, facing.point))
      return false;
    const auto may_cut = [&](const Arm& arm, const CurvePlace& place) {
      return (place.point - arm.points.front()).norm() > least_slenderness * limit &&
             (place.point - arm.points.back()).norm() > width_;
    };
    // An edge that stays close to the other one up to its end stays whole.
    const CurvePlace place = end && !other ? one.nearest(other_last) : end.value_or(CurvePlace());
    if ((end && !may_cut(one, place)) || ((other || !end) && !may_cut(two, facing))) return false;
    if (end) cuts_.push_back({before.edge, place.parameter, place.point});
    if (other || !end) cuts_.push_back({after.edge, facing.parameter, facing.point});
    return true;
  }

  Arm arm_of(const CadEdge& edge, bool from_start, EdgeCurve curve) const {
    constexpr double finer = 0.1, growth = 1.15;
    Arm arm{{}, std::move(curve)};
    const double range = (edge.last - edge.first) / edge.length;
    const auto add = [&](double s) {
      arm.parameters.push_back(from_start ? edge.first + s * range : edge.last - s * range);
      arm.points.push_back(arm.curve.point(arm.parameters.back()));
    };
    double s = 0, step = finer * width_;
    while (s < edge.length) {
      add(s);
      s += step;
      step *= growth;
    }
    add(edge.length);
    return arm;
  }

  /// Whether the face lies between the two places, to the left of its wire, rather than around them.
  bool lies_between(const Coedge& before, double parameter, const EdgeCurve& curve,
                    const Vector3& facing) const {
    const FaceSurface surface(shape_.faces[id_]);
    const Vector3 normal = surface.normal(parametric_point(before, parameter)),
                  along = (before.forward ? 1 : -1) * curve.derivative(parameter);
    return normal.cross(along).dot(facing - curve.point(parameter)) > 0;
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  FaceId id_;
  double width_;
  EdgeEnds& taken_;
  std::vector<EdgeCut>& cuts_;
  std::vector<Sliver> found_;
};

}  // namespace

std::vector<Sliver> find_spikes(const CadShape& shape, const FaceFlags& used, FaceId face, double width,
                                EdgeEnds& taken, std::vector<EdgeCut>& cuts) {
  if (!(width > 0)) return {};
  return SpikeFinder(shape, used, face, width, taken, cuts).run();
}

}  // namespace quadrille
