/// Tries each motion that maps one edge of the first face onto an edge of the second with the same length.
/// Based on: Kabsch, A solution for the best rotation to relate two sets of vectors (1976).

#include "mesher/edges/matching.hpp"

#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <ShapeAnalysis_Surface.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <Eigen/SVD>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

constexpr std::size_t samples_on_edge = 5;
/// The least tolerance, as a share of the model's diagonal: exchange formats round coordinates.
constexpr double least_tolerance = 1e-7;

/// Points on an edge at even steps of its arc length, both ends included.
using EdgeSamples = std::array<Vector3, samples_on_edge>;

EdgeSamples samples_of(const CadEdge& edge) {
  const BRepAdaptor_Curve curve(edge.edge);
  EdgeSamples result;
  for (std::size_t i = 0; i < samples_on_edge; ++i) {
    const double share = static_cast<double>(i) / (samples_on_edge - 1);
    double t = edge.first + share * (edge.last - edge.first);
    if (i > 0 && i + 1 < samples_on_edge && curve.GetType() != GeomAbs_Line) {
      const GCPnts_AbscissaPoint at(curve, share * edge.length, edge.first, t);
      if (at.IsDone()) t = at.Parameter();
    }
    result[i] = to_vector(curve.Value(t));
  }
  return result;
}

/// The edges of a face, or the pieces of an edge.
struct Outline {
  std::string name;
  FaceId face;  // none for an edge
  std::vector<EdgeId> edges;
  std::vector<EdgeSamples> samples;
  Vector3 centroid{0, 0, 0};  // of the samples
};

Outline outline_of(const CadShape& shape, int dimension, int number) {
  Outline result;
  result.name = fmt::format("{}{}", dimension == 2 ? "Face" : "Edge", number);
  std::set<EdgeId> edges;
  if (dimension == 2) {
    result.face = FaceId::from_number(number);
    for (const EdgeId edge : shape.faces[result.face].edges()) edges.insert(edge);
  } else {
    for (const EdgeId id : shape.edges.ids())
      if (shape.edges[id].number == number) edges.insert(id);
  }
  for (const EdgeId id : edges) {
    if (shape.edges[id].degenerate || shape.edges[id].length <= 0) continue;
    result.edges.push_back(id);
    result.samples.push_back(samples_of(shape.edges[id]));
    for (const Vector3& point : result.samples.back()) result.centroid += point / samples_on_edge;
  }
  if (result.edges.empty())
    throw usage_error("match", fmt::format("`match` names {}, which has no edges to match", result.name));
  result.centroid /= static_cast<double>(result.edges.size());
  return result;
}

Vector3 mean_of(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Whether points lie on a line, from the singular values of their covariance.
bool on_a_line(const Vector3& singular) {
  constexpr double hardly = 1e-10;
  return singular[1] <= hardly * singular[0];
}

class MotionSearch {
 public:
  MotionSearch(const CadShape& shape, Outline a, Outline b)
      : shape_(shape), a_(std::move(a)), b_(std::move(b)), tolerance_(least_tolerance * shape.diagonal()) {
    for (const Outline* outline : {&a_, &b_}) {
      for (const EdgeId id : outline->edges) {
        const CadEdge& edge = shape.edges[id];
        double own = edge.tolerance;
        for (const VertexId vertex : {edge.first_vertex, edge.last_vertex})
          if (vertex.exists()) own = std::max(own, shape.vertex_tolerances[vertex]);
        tolerance_ = std::max(tolerance_, 2 * own);
      }
    }
  }

  /// \return which entities the best motion maps onto each other.
  MatchLink run(const MatchedPair& pair) {
    if (a_.edges.size() != b_.edges.size())
      throw usage_error("match",
                        fmt::format("`match` {}={}: no motion maps one onto the other, since {} has {} "
                                    "edges and {} has {}",
                                    a_.name, b_.name, a_.name, a_.edges.size(), b_.name, b_.edges.size()));
    const std::size_t base = base_edge();
    for (std::size_t i = 0; i < b_.edges.size(); ++i) {
      if (!equally_long(base, i) && has_partner(base)) continue;
      for (const bool reversed : {false, true}) consider(base, i, reversed);
    }
    if (!best_)
      throw usage_error("match",
                        fmt::format("`match` {0}={1}: no translation or rotation maps {0} onto {1}: the "
                                    "best one leaves them {2} mm apart, more than their tolerance of {3}",
                                    a_.name, b_.name, number_text(nearest_), number_text(tolerance_)));
    MatchLink link;
    link.pair = pair;
    link.tolerance = tolerance_;
    link.found = std::move(*best_);
    return link;
  }

 private:
  bool equally_long(std::size_t a, std::size_t b) const {
    return std::abs(shape_.edges[a_.edges[a]].length - shape_.edges[b_.edges[b]].length) <= 4 * tolerance_;
  }

  bool has_partner(std::size_t a) const {
    for (std::size_t i = 0; i < b_.edges.size(); ++i)
      if (equally_long(a, i)) return true;
    return false;
  }

  /// The points of an edge that determine a motion: its samples and the middle of all edges.
  static std::vector<Vector3> points_of(const Outline& outline, std::size_t edge, bool reversed = false) {
    std::vector<Vector3> result(outline.samples[edge].begin(), outline.samples[edge].end());
    if (reversed) std::reverse(result.begin(), result.end());
    result.push_back(outline.centroid);
    return result;
  }

  /// The edge of the first face that fewest edges of the other may be the image of.
  std::size_t base_edge() const {
    std::size_t result = 0;
    std::pair<bool, std::size_t> least{true, std::numeric_limits<std::size_t>::max()};
    for (std::size_t i = 0; i < a_.edges.size(); ++i) {
      std::size_t partners = 0;
      for (std::size_t k = 0; k < b_.edges.size(); ++k) partners += equally_long(i, k);
      const std::pair cost(is_on_a_line(points_of(a_, i)), partners);
      if (!(cost < least)) continue;
      least = cost;
      result = i;
    }
    return result;
  }

  static bool is_on_a_line(const std::vector<Vector3>& points) {
    const Vector3 mean = mean_of(points);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vector3& p : points) spread += (p - mean) * (p - mean).transpose();
    return on_a_line(Eigen::JacobiSVD<Eigen::Matrix3d>(spread).singularValues());
  }

  void consider(std::size_t base, std::size_t other, bool reversed) {
    MatchedFace candidate;
    candidate.from = a_.face;
    candidate.to = b_.face;
    candidate.motion = fit_motion(points_of(a_, base), points_of(b_, other, reversed), tolerance_);
    if (!map_edges(candidate)) return;
    fit_to_all(candidate);
    if (!map_edges(candidate) || !map_surface(candidate)) return;
    const RigidMotion& motion = candidate.motion;
    constexpr double step = 1e-6;  // angles that differ by less are equal
    const Cost cost{motion.angle == 0              ? 0
                    : motion.translation.isZero(0) ? 1
                                                   : 2,
                    moved_of_shared(candidate), !candidate.flips, std::round(std::abs(motion.angle) / step)};
    if (best_ && !(cost < least_)) return;
    best_ = std::move(candidate);
    least_ = cost;
  }

  /// Improves the motion by all edges.
  void fit_to_all(MatchedFace& candidate) const {
    std::map<EdgeId, std::size_t> places;
    for (std::size_t i = 0; i < b_.edges.size(); ++i) places[b_.edges[i]] = i;
    std::vector<Vector3> from, to;
    for (std::size_t i = 0; i < a_.edges.size(); ++i) {
      EdgeSamples image = b_.samples[places.at(candidate.edges[i].to)];
      if (candidate.edges[i].reversed) std::reverse(image.begin(), image.end());
      from.insert(from.end(), a_.samples[i].begin(), a_.samples[i].end());
      to.insert(to.end(), image.begin(), image.end());
    }
    candidate.motion = fit_motion(from, to, tolerance_);
  }

  /// Finds the image of each edge. \return false if one has none.
  bool map_edges(MatchedFace& candidate) {
    candidate.edges.clear();
    std::vector<char> taken(b_.edges.size(), 0);
    for (std::size_t i = 0; i < a_.edges.size(); ++i) {
      EdgeSamples moved = a_.samples[i];
      for (Vector3& point : moved) point = candidate.motion(point);
      double nearest = std::numeric_limits<double>::infinity();
      std::size_t image = 0;
      bool against = false;
      for (std::size_t k = 0; k < b_.edges.size(); ++k) {
        if (taken[k]) continue;
        for (const bool reversed : {false, true}) {
          double apart = 0;
          for (std::size_t s = 0; s < samples_on_edge; ++s)
            apart =
                std::max(apart, (moved[s] - b_.samples[k][reversed ? samples_on_edge - 1 - s : s]).norm());
          if (!(apart < nearest)) continue;
          nearest = apart;
          image = k;
          against = reversed;
        }
      }
      if (!holds(nearest)) return false;
      taken[image] = 1;
      candidate.edges.push_back({a_.edges[i], b_.edges[image], against, candidate.motion});
    }
    return true;
  }

  /// Whether a distance is within the tolerance; notes it otherwise.
  bool holds(double distance) {
    if (distance <= tolerance_) return true;
    nearest_ = std::min(nearest_, distance);
    return false;
  }

  /// Whether points inside the first face go to the surface of the second.
  bool map_surface(MatchedFace& candidate) {
    if (!a_.face.exists()) return true;
    const CadFace &from = shape_.faces[a_.face], &to = shape_.faces[b_.face];
    const FaceSurface surface(from), other(to);
    ShapeAnalysis_Surface inverse(BRep_Tool::Surface(to.face));
    const Eigen::Matrix3d turn = candidate.motion.rotation();
    double apart = 0, along = 0;
    for (const Vector2& uv : points_inside(from)) {
      const Vector3 moved = candidate.motion(surface.point(uv));
      const gp_Pnt2d at = inverse.ValueOfUV(gp_Pnt(moved.x(), moved.y(), moved.z()), 0.01 * tolerance_);
      Vector2 there(at.X(), at.Y());
      apart = std::max(apart, (other.project(there, moved).point - moved).norm());
      along += (turn * surface.normal(uv)).dot(other.normal(there));
    }
    candidate.flips = (along < 0) != (from.reversed != to.reversed);
    return holds(apart);
  }

  /// Parameters of some points inside a face, from a grid as fine as needed.
  static std::vector<Vector2> points_inside(const CadFace& face) {
    BRepTopAdaptor_FClass2d inside(face.face, Precision::PConfusion());
    std::vector<Vector2> result;
    for (const int n : {5, 15, 45, 135}) {
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
          const double u = face.u_min + (i + 0.5) / n * (face.u_max - face.u_min),
                       v = face.v_min + (k + 0.5) / n * (face.v_max - face.v_min);
          if (inside.Perform(gp_Pnt2d(u, v)) == TopAbs_IN) result.emplace_back(u, v);
        }
      }
      if (!result.empty()) break;
    }
    return result;
  }

  /// The number of edges that both faces have and the motion moves.
  int moved_of_shared(const MatchedFace& candidate) const {
    int moved = 0;
    for (const MatchedEdge& edge : candidate.edges) {
      const bool shared = std::find(b_.edges.begin(), b_.edges.end(), edge.from) != b_.edges.end();
      moved += shared && (edge.to != edge.from || edge.reversed);
    }
    return moved;
  }

  const CadShape& shape_;
  Outline a_, b_;
  double tolerance_;
  double nearest_ = std::numeric_limits<double>::infinity();  // least distance that was too large
  using Cost = std::tuple<int, int, bool, double>;
  std::optional<MatchedFace> best_;
  Cost least_;  // of the best one
};

void turn_back(MatchedEdge& edge) {
  std::swap(edge.from, edge.to);
  edge.motion = edge.motion.inverse();
}
void turn_back(MatchedFace& face) {
  std::swap(face.from, face.to);
  face.motion = face.motion.inverse();
  for (MatchedEdge& edge : face.edges) turn_back(edge);
}

/// Orders copies so that each one starts from existing nodes, and drops those with a target copied before.
template <class Copy>
std::vector<Copy> in_order(const std::vector<Copy>& asked) {
  using Id = decltype(Copy::from);
  std::map<Id, std::vector<Copy>> at;
  std::vector<Id> starts;
  for (Copy copy : asked) {
    if (copy.from == copy.to) continue;
    starts.push_back(copy.from);
    at[copy.from].push_back(copy);
    turn_back(copy);
    at[copy.from].push_back(copy);
  }
  std::set<Id> reached;
  std::vector<Copy> result;
  for (const Id start : starts) {
    if (!reached.insert(start).second) continue;
    std::deque<Id> waiting{start};
    for (; !waiting.empty(); waiting.pop_front()) {
      for (const Copy& copy : at[waiting.front()]) {
        if (!reached.insert(copy.to).second) continue;
        result.push_back(copy);
        waiting.push_back(copy.to);
      }
    }
  }
  return result;
}

}  // namespace

RigidMotion fit_motion(const std::vector<Vector3>& from, const std::vector<Vector3>& to, double tolerance) {
  const Vector3 mean = mean_of(from), other = mean_of(to);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double reach = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    spread += (from[i] - mean) * (to[i] - other).transpose();
    reach = std::max(reach, (from[i] - mean).norm());
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn;
  if (on_a_line(parts.singularValues())) {
    turn = Eigen::Quaterniond::FromTwoVectors(parts.matrixU().col(0), parts.matrixV().col(0)).matrix();
  } else {
    Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
    mirror(2, 2) = (parts.matrixV() * parts.matrixU().transpose()).determinant() < 0 ? -1 : 1;
    turn = parts.matrixV() * mirror * parts.matrixU().transpose();
  }
  const Eigen::AngleAxisd about(turn);
  RigidMotion motion;
  if (std::abs(about.angle()) * reach <= 0.1 * tolerance) {
    motion.translation = other - mean;
    return motion;
  }
  motion.angle = about.angle();
  motion.axis = about.axis();
  const Vector3 offset = other - motion.rotation() * mean;
  const double slide = motion.axis.dot(offset);
  const Vector3 across = offset - slide * motion.axis;
  motion.center = 0.5 * (across + motion.axis.cross(across) / std::tan(0.5 * motion.angle));
  if (std::abs(slide) > tolerance) motion.translation = slide * motion.axis;
  return motion;
}

std::vector<VertexId> Matches::vertices(const CadShape& shape) const {
  std::set<VertexId> result;
  for (const MatchLink& link : links)
    for (const MatchedEdge& edge : link.found.edges)
      for (const EdgeId id : {edge.from, edge.to})
        result.insert({shape.edges[id].first_vertex, shape.edges[id].last_vertex});
  result.erase(VertexId());
  return {result.begin(), result.end()};
}

Matches find_matches(const CadShape& shape, const std::vector<MatchedPair>& pairs, const FaceFlags& used) {
  Matches result;
  result.copied_faces.assign(shape.faces.size(), 0);
  std::vector<MatchedEdge> edges;
  std::vector<MatchedFace> faces;
  for (const MatchedPair& pair : pairs) {
    Outline a = outline_of(shape, pair.dimension, pair.first),
            b = outline_of(shape, pair.dimension, pair.second);
    for (const Outline* outline : {&a, &b}) {
      const bool meshed = outline->face.exists() ? used[outline->face] != 0
                                                 : shape.edges[outline->edges.front()].is_used(used);
      if (!meshed)
        throw usage_error(
            "match", fmt::format("`match` names {}, which is not among the faces to mesh", outline->name));
    }
    MatchLink link = MotionSearch(shape, std::move(a), std::move(b)).run(pair);
    const MatchedFace& found = link.found;
    edges.insert(edges.end(), found.edges.begin(), found.edges.end());
    if (pair.dimension == 2) faces.push_back(found);
    result.links.push_back(std::move(link));
  }
  result.edges = in_order(edges);
  result.faces = in_order(faces);
  for (const MatchedFace& face : result.faces) result.copied_faces[face.to] = 1;
  return result;
}

}  // namespace quadrille
