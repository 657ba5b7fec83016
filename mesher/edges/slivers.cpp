/// Based on: Sheffer, Bercovier, Blacker & Clements, Virtual topology operators for meshing (2000): a narrow
/// face is given to its neighbors.

#include "mesher/edges/slivers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/base/vector.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/edge_division.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// Faces with more edges than this are not narrow in practice.
constexpr std::size_t most_edges = 40;

/// A long edge of a face, with samples in the direction of the wire.
struct LongEdge : CurveSamples {
  EdgeId edge;
  bool forward = true;
  VertexId from, to;  // vertices, in the direction of the wire
  int next = 0;       // index of the long edge that follows in the wire
  double slack = 0;   // how far the curve may be from the line through the samples
};

/// The place of a chain that is nearest to a point.
struct Nearest : CurvePlace {
  int edge = 0;  // index of the long edge
};

/// Finds faces that lie along their seams.
struct TubeFinder {
  const CadShape& shape;
  const FaceFlags& used;
  double width;

  /// A face that lies along its seam, between ends that are small.
  std::optional<Sliver> find(FaceId id) const {
    const CadFace& face = shape.faces[id];
    Sliver tube;
    tube.face = id;
    EdgeId seam;
    bool has_neighbor = false;
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) {
        const CadEdge& edge = shape.edges[coedge.edge];
        if (coedge.internal || !has_ends(edge)) return std::nullopt;
        if (is_small(edge, width)) {
          tube.rims.push_back(coedge.edge);
          has_neighbor |=
              std::ranges::any_of(edge.faces, [&](FaceId other) { return other != id && is_large(other); });
        } else if (!seam.exists() || seam == coedge.edge) {
          seam = coedge.edge;
        } else {
          return std::nullopt;
        }
      }
    }
    const bool is_seam = seam.exists() && shape.edges[seam].faces == std::vector<FaceId>{id, id};
    if (!is_seam || !has_neighbor || !lies_along(face, shape.edges[seam])) return std::nullopt;
    return tube;
  }

  bool is_large(FaceId face) const {
    const auto edges = shape.faces[face].edges();
    return used[face] &&
           !std::ranges::all_of(edges, [&](EdgeId edge) { return is_small(shape.edges[edge], width); });
  }

  /// Whether a face stays within the width of an edge, at samples all over it.
  bool lies_along(const CadFace& face, const CadEdge& edge) const {
    constexpr int places = 32, samples = 8;
    const std::vector<Vector3> on_edge = points_along(edge, places * samples);
    const double spacing = edge.length / (places * samples);
    const FaceSurface surface(face);
    const auto is_near = [&](const Vector3& point) {
      return std::ranges::any_of(
          on_edge, [&](const Vector3& other) { return (point - other).norm() < width + spacing; });
    };
    for (int i = 0; i <= samples; ++i) {
      for (int k = 0; k <= samples; ++k) {
        const double u = static_cast<double>(i) / samples, v = static_cast<double>(k) / samples;
        const Vector2 uv((1 - u) * face.u_min + u * face.u_max, (1 - v) * face.v_min + v * face.v_max);
        if (!is_near(surface.point(uv))) return false;
      }
    }
    return true;
  }
};

/// The indices from one up to another in a ring of `n`.
std::vector<int> range(int from, int to, int n) {
  std::vector<int> result;
  for (int i = from; i < to; ++i) result.push_back(i % n);
  return result;
}

/// Finds out whether a face is narrow between chains of its long edges. Junction i lies before long edge i.
class SliverFinder {
 public:
  SliverFinder(const CadShape& shape, const FaceFlags& used, double width, FaceId id)
      : shape_(shape), used_(used), width_(width), id_(id) {}

  std::optional<Sliver> find(std::vector<EdgeCut>& cuts) && {
    const CadFace& face = shape_.faces[id_];
    std::size_t first_wire = 0;
    constexpr int coarse = 8, fine = 256;
    for (const CadWire& wire : face.wires) {
      if (!add_wire(wire)) return std::nullopt;
      if (&wire == &face.wires.front()) first_wire = edges_.size();
    }
    if (edges_.size() < 2 || first_wire == 0 || !has_neighbors()) return std::nullopt;
    for (LongEdge& edge : edges_) sample(edge, coarse);
    if (!may_be_narrow()) return std::nullopt;
    for (LongEdge& edge : edges_) sample(edge, fine);
    const int n = static_cast<int>(edges_.size());
    if (face.wires.size() == 2) {
      if (first_wire == edges_.size()) return std::nullopt;
      return zip(range(0, static_cast<int>(first_wire), n), range(static_cast<int>(first_wire), n, n), cuts);
    }
    for (int first = 0; first < n; ++first) {
      for (int second = first + 1; second < n; ++second) {
        if (auto sliver = zip(range(first, second, n), range(second, n + first, n), cuts)) return sliver;
        if (!cuts.empty()) return std::nullopt;
      }
    }
    return std::nullopt;
  }

 private:
  bool add_wire(const CadWire& wire) {
    if (!wire.ordered || wire.coedges.size() > most_edges) return false;
    const std::size_t first = edges_.size();
    for (const Coedge& coedge : wire.coedges) {
      const CadEdge& edge = shape_.edges[coedge.edge];
      if (coedge.internal || !has_ends(edge)) return false;
      if (is_small(edge, width_)) continue;
      LongEdge& added = edges_.emplace_back();
      added.edge = coedge.edge;
      added.forward = coedge.forward;
      added.from = shape_.start_of(coedge);
      added.to = shape_.end_of(coedge);
      added.next = static_cast<int>(edges_.size());
    }
    if (edges_.size() == first) return false;
    edges_.back().next = static_cast<int>(first);
    return true;
  }

  /// Whether no edge is a seam and at least one of them belongs to another face.
  bool has_neighbors() const {
    bool any = false;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        if (edges_[i].edge == edges_[k].edge) return false;
      }
      any |= shape_.edges[edges_[i].edge].is_used_beside(id_, used_);
    }
    return any;
  }

  void sample(LongEdge& to, int intervals) const {
    const CadEdge& edge = shape_.edges[to.edge];
    const EdgeCurve curve(edge);
    if (curve.straight()) intervals = std::min(intervals, 16);
    to.parameters.clear();
    to.points.clear();
    to.slack = 0;
    for (int i = 0; i <= intervals; ++i) {
      const double share = static_cast<double>(i) / intervals;
      to.parameters.push_back(edge.first + (to.forward ? share : 1 - share) * (edge.last - edge.first));
      to.points.push_back(curve.point(to.parameters.back()));
    }
    if (curve.straight()) return;
    // A curve of length s between points at distance c is nowhere farther from them than this; by parameter
    // the pieces are not equally long, which the factor allows for.
    const double s = 1.5 * edge.length / intervals;
    for (int i = 0; i < intervals; ++i) {
      const double c = (to.points[i + 1] - to.points[i]).norm();
      to.slack = std::max(to.slack, 0.5 * std::sqrt(std::max(0.0, s * s - c * c)));
    }
  }

  Nearest nearest(const Vector3& p, const std::vector<int>& chain) const {
    Nearest result;
    for (const int i : chain) {
      const CurvePlace place = edges_[i].nearest(p);
      if (place.distance < result.distance) result = {place, i};
    }
    return result;
  }

  /// Whether the middle of the longest edge is near another one.
  bool may_be_narrow() const {
    const auto longest = std::ranges::max_element(
        edges_, {}, [&](const LongEdge& edge) { return shape_.edges[edge.edge].length; });
    const Vector3 middle = longest->points[longest->points.size() / 2];
    return std::ranges::any_of(edges_, [&](const LongEdge& edge) {
      return &edge != &*longest && edge.nearest(middle).distance < width_ + edge.slack;
    });
  }

  double length_of(const std::vector<int>& chain) const {
    double length = 0;
    for (const int i : chain) length += shape_.edges[edges_[i].edge].length;
    return length;
  }

  bool lies_along(const std::vector<int>& chain, const std::vector<int>& other, double reach) const {
    constexpr std::array<int, 7> eighths{4, 1, 2, 3, 5, 6, 7};  // what fails mostly fails in the middle
    for (const int eighth : eighths) {
      for (const int i : chain) {
        const auto& points = edges_[i].points;
        if (!(nearest(points[(points.size() - 1) * eighth / 8], other).distance < reach)) return false;
      }
    }
    return true;
  }

  /// Pairs the edges of two chains that lie along each other.
  std::optional<Sliver> zip(const std::vector<int>& chain, const std::vector<int>& other,
                            std::vector<EdgeCut>& cuts) const {
    const double length = std::min(length_of(chain), length_of(other));
    const double reach = std::min(width_, length / least_slenderness);
    if (std::abs(length_of(chain) - length_of(other)) > 0.2 * length + 2 * width_) return std::nullopt;
    if (!lies_along(chain, other, reach) || !lies_along(other, chain, reach)) return std::nullopt;
    std::map<int, int> match;  // junctions of the two chains, both ways
    const int start = chain.front(), end = edges_[chain.back()].next;
    if (start != end) match = {{start, start}, {end, end}};  // not a ring
    std::vector<EdgeCut> found;
    if (!match_junctions(chain, other, match, found) || !match_junctions(other, chain, match, found))
      return std::nullopt;
    if (!found.empty()) {
      cuts = std::move(found);
      return std::nullopt;
    }
    return paired(chain, other, match);
  }

  /// Finds the junction of the other chain that faces each junction, or the place to divide an edge at.
  bool match_junctions(const std::vector<int>& chain, const std::vector<int>& other,
                       std::map<int, int>& match, std::vector<EdgeCut>& cuts) const {
    for (const int junction : chain) {
      if (match.contains(junction)) continue;
      const Vector3& p = edges_[junction].points.front();
      const Nearest place = nearest(p, other);
      if (!(place.distance < width_)) return false;
      const LongEdge& edge = edges_[place.edge];
      const double to_start = (edge.points.front() - place.point).norm(),
                   to_end = (edge.points.back() - place.point).norm();
      if (std::min(to_start, to_end) < width_) {
        const int there = to_start < to_end ? place.edge : edge.next;
        if (match.contains(there)) return false;
        match[junction] = there;
        match[there] = junction;
      } else {
        cuts.push_back({edge.edge, place.parameter, place.point});
      }
    }
    return true;
  }

  std::optional<Sliver> paired(const std::vector<int>& chain, const std::vector<int>& other,
                               const std::map<int, int>& match) const {
    if (chain.size() != other.size()) return std::nullopt;
    Sliver sliver;
    sliver.face = id_;
    for (const int i : chain) {
      const LongEdge& edge = edges_[i];
      const int facing = match.at(edge.next);
      const LongEdge& across = edges_[facing];
      if (std::ranges::find(other, facing) == other.end() || across.next != match.at(i)) return std::nullopt;
      const bool lends = shape_.edges[edge.edge].is_used_beside(id_, used_);
      sliver.pairs.push_back(
          {lends ? edge.edge : across.edge, lends ? across.edge : edge.edge, edge.forward == across.forward});
      if (match.at(i) != i) sliver.ties.push_back({edge.from, across.to});
    }
    for (const LongEdge& edge : edges_) sliver.joints.push_back({edge.to, edges_[edge.next].from});
    return sliver;
  }

  const CadShape& shape_;
  const FaceFlags& used_;
  double width_;
  FaceId id_;
  std::vector<LongEdge> edges_;
};

/// \param cuts gets the places that have to be divided first, if the face is a sliver otherwise or has spikes
std::vector<Sliver> find_slivers_of(const CadShape& shape, const FaceFlags& used, double width, FaceId id,
                                    EdgeEnds& taken, std::vector<EdgeCut>& cuts) {
  const CadFace& face = shape.faces[id];
  if (!face.wires.empty() && face.wires.size() <= 2 && face.inner_vertices.empty()) {
    if (auto tube = TubeFinder{shape, used, width}.find(id)) return {std::move(*tube)};
    if (auto sliver = SliverFinder(shape, used, width, id).find(cuts)) return {std::move(*sliver)};
  }
  return cuts.empty() ? find_spikes(shape, used, id, width, taken, cuts) : std::vector<Sliver>();
}

/// A copy of the shape with edges divided. Of cuts no farther apart than `nearest`, the first counts.
std::shared_ptr<const CadShape> divided(const CadShape& shape, std::vector<EdgeCut> cuts, double nearest) {
  auto result = std::make_shared<CadShape>(shape);
  std::ranges::stable_sort(cuts, {}, [](const EdgeCut& cut) { return std::pair(cut.edge, cut.parameter); });
  for (std::size_t i = 0; i < cuts.size();) {
    std::vector<double> parameters;
    Vector3 last = Vector3::Zero();
    const EdgeId edge = cuts[i].edge;
    for (; i < cuts.size() && cuts[i].edge == edge; ++i) {
      if (!parameters.empty() && (cuts[i].point - last).norm() <= nearest) continue;
      parameters.push_back(cuts[i].parameter);
      last = cuts[i].point;
    }
    divide_edge(*result, edge, parameters);
  }
  return result;
}

/// The slivers of all faces. \param cuts gets the places that have to be divided first
std::vector<Sliver> find_slivers_and_cuts(const CadShape& shape, const FaceFlags& used, double width,
                                          std::vector<EdgeCut>& cuts) {
  std::vector<Sliver> result;
  if (!(width > 0)) return result;
  EdgeEnds taken;
  for (const FaceId face : used.ids()) {
    std::vector<EdgeCut> own;
    if (!used[face]) continue;
    for (Sliver& sliver : find_slivers_of(shape, used, width, face, taken, own))
      result.push_back(std::move(sliver));
    cuts.insert(cuts.end(), own.begin(), own.end());
  }
  return result;
}

}  // namespace

CurvePlace CurveSamples::nearest(const Vector3& p) const {
  CurvePlace result;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double t = nearest_share(points[i], points[i + 1], p);
    const Vector3 point = points[i] + t * (points[i + 1] - points[i]);
    const double distance = (p - point).norm();
    if (distance < result.distance)
      result = {distance, parameters[i] + t * (parameters[i + 1] - parameters[i]), point};
  }
  return result;
}

std::vector<Sliver> find_slivers(const CadShape& shape, const FaceFlags& used, double width) {
  std::vector<EdgeCut> cuts;
  return find_slivers_and_cuts(shape, used, width, cuts);
}

std::shared_ptr<const CadShape> divided_at_slivers(const CadShape& shape, const FaceFlags& used,
                                                   double width) {
  constexpr int most_passes = 6;  // a cut passes from sliver to sliver
  std::shared_ptr<const CadShape> result;
  for (int pass = 0; pass < most_passes; ++pass) {
    const CadShape& now = result ? *result : shape;
    std::vector<EdgeCut> cuts;
    find_slivers_and_cuts(now, used, width, cuts);
    if (cuts.empty()) break;
    result = divided(now, std::move(cuts), width);
  }
  return result;
}

}  // namespace quadrille
