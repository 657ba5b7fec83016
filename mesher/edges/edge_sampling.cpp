/// Equidistribution of 1 / size along the arc length; parity by a T-join (Edmonds & Johnson, Matching, Euler
/// tours and the Chinese postman, 1973), approximated by nearest pairs, and by a minimum-weight basis over
/// GF(2) in general.

#include "mesher/edges/edge_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// The wanted number of segments as a function of the parameter.
struct CountTable {
  std::vector<double> parameters;
  std::vector<double> counts;  // integral of ds / size from the start
  double turning = 0;          // total change of direction, radians
  double total() const { return counts.empty() ? 0 : counts.back(); }

  double parameter_at(double count) const {
    const auto it = std::lower_bound(counts.begin(), counts.end(), count);
    const std::size_t i = std::clamp<std::size_t>(it - counts.begin(), 1, counts.size() - 1);
    const double span = counts[i] - counts[i - 1];
    const double t = span > 0 ? std::clamp((count - counts[i - 1]) / span, 0.0, 1.0) : 0.5;
    return parameters[i - 1] + t * (parameters[i] - parameters[i - 1]);
  }
};

class EdgeTabulator {
 public:
  EdgeTabulator(const CadEdge& edge, SizingField::Sampler& size_at)
      : curve_(edge), size_at_(size_at), uniform_(curve_.straight() || curve_.circular()) {
    const int intervals = std::max(uniform_ ? 4 : 8, 2 * curve_.spans());
    add(edge.first, curve_.point(edge.first), 0);
    for (int i = 1; i <= intervals; ++i) {
      const double t = edge.first + (edge.last - edge.first) * i / intervals;
      split(t, curve_.point(t), 0);
    }
  }
  CountTable table;

 private:
  void split(double t, const Vector3& p, int depth) {
    const double chord = (p - point_).norm();
    if (depth < 14 && chord > 0.5 * std::min(size_, size_at_(p))) {
      const double middle = 0.5 * (table.parameters.back() + t);
      split(middle, curve_.point(middle), depth + 1);
      split(t, p, depth + 1);
      return;
    }
    add(t, p, arc(table.parameters.back(), t, chord));
  }

  void add(double t, const Vector3& p, double length) {
    const double size = size_at_(p);
    const Vector3 direction = curve_.derivative(t);
    if (table.parameters.empty()) {
      table.counts.push_back(0);
    } else {
      table.counts.push_back(table.counts.back() + 0.5 * length * (1 / size + 1 / size_));
      table.turning += angle_between(direction, direction_);
    }
    table.parameters.push_back(t);
    point_ = p;
    size_ = size;
    direction_ = direction;
  }

  /// Arc length by Simpson's rule on the speed.
  double arc(double a, double b, double chord) const {
    if (curve_.straight()) return chord;
    const double speeds = curve_.derivative(a).norm() + curve_.derivative(b).norm() +
                          4 * curve_.derivative(0.5 * (a + b)).norm();
    return std::max(chord, (b - a) * speeds / 6);
  }

  EdgeCurve curve_;
  SizingField::Sampler& size_at_;
  bool uniform_;
  Vector3 point_, direction_;
  double size_ = 0;
};

/// Fewest segments (of the mesh that is recombined) that keep the edge's shape and the face's loop open.
int least_segments(bool closed, double turning, bool shares_both_ends, bool inner, int stride) {
  // Holes and pins need more than fillets to keep their area.
  const double turning_a_segment = turning > 2.5 ? 1.3 : 1.8;
  int least = std::max(1, static_cast<int>(std::ceil(turning / turning_a_segment - 0.01)));
  if (shares_both_ends && turning > 1e-3) least = std::max(least, 2);
  if (inner) least = std::max(least, 2);  // the face is cut open between its ends
  if (closed) least = std::max(least, stride == 2 ? 3 : 4);
  return least;
}

/// Edges that have both end vertices in common with another one: as chords they would coincide.
std::vector<char> find_shared_ends(const CadShape& shape, const TinyFeatures& tiny) {
  std::map<std::pair<int, int>, int> count;
  const auto key = [&](const CadEdge& e) -> std::pair<int, int> {
    return std::minmax({tiny.end(e.first_vertex), tiny.end(e.last_vertex)});
  };
  std::vector<char> shared(shape.edges.size(), 0);
  const auto is_open = [&](std::size_t i) {
    return !shape.edges[i].degenerate && !tiny.closed(shape.edges[i]) && tiny.edges[i] == static_cast<int>(i);
  };
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (is_open(i)) ++count[key(shape.edges[i])];
  }
  for (std::size_t i = 0; i < shared.size(); ++i) {
    shared[i] = is_open(i) && count[key(shape.edges[i])] > 1;
  }
  return shared;
}

/// Edges that lie inside a face.
std::vector<char> find_inner_edges(const CadShape& shape) {
  std::vector<char> inner(shape.edges.size(), 0);
  for (const CadFace& face : shape.faces) {
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) inner[coedge.edge - 1] |= coedge.internal;
    }
  }
  return inner;
}

/// The faces used that have the edge an odd number of times.
std::vector<int> odd_uses(const CadEdge& edge, const std::vector<char>& used) {
  std::vector<int> faces;
  for (const int face : edge.faces) {
    if (!used[face - 1]) continue;
    if (!faces.empty() && faces.back() == face - 1) {
      faces.pop_back();
    } else {
      faces.push_back(face - 1);
    }
  }
  return faces;
}

/// The edges that have nodes: those of the faces used, and those that share theirs.
std::vector<char> find_used_edges(const CadShape& shape, const std::vector<char>& used,
                                  const TinyFeatures& tiny) {
  std::vector<char> result(shape.edges.size(), 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const CadEdge& edge = shape.edges[i];
    if (std::any_of(edge.faces.begin(), edge.faces.end(), [&](int face) { return used[face - 1]; }))
      result[i] = result[tiny.edges[i]] = 1;
  }
  return result;
}

/// Edges that get the same count, because they face each other across a face. A union-find structure.
class TiedEdges {
 public:
  explicit TiedEdges(const std::vector<double>& wanted)
      : parent_(wanted.size()), low_(wanted), high_(wanted) {
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<int>(i);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Ties two edges unless that would take some edge of either class too far from its wanted count.
  void tie(int a, int b, double largest_ratio = 1.5) {
    a = find(a);
    b = find(b);
    const double low = std::min(low_[a], low_[b]), high = std::max(high_[a], high_[b]);
    if (a == b || high > largest_ratio * low) return;
    parent_[b] = a;
    low_[a] = low;
    high_[a] = high;
  }

 private:
  std::vector<int> parent_;
  std::vector<double> low_, high_;
};

/// Two sides of a face that run along each other.
struct FacingSides {
  const Coedge *first, *second;
  double width;  ///< between them, at most, about
};

/// How far it is across the face from the middle of one coedge to that of another.
double distance_across(const CadShape& shape, const CadFace& face, const Coedge& a, const Coedge& b) {
  constexpr int steps = 8;
  const auto middle = [&](const Coedge& coedge) {
    const CadEdge& edge = shape.edges[coedge.edge - 1];
    return parametric_point(coedge, 0.5 * (edge.first + edge.last));
  };
  const FaceSurface surface(face);
  const Vector2 from = middle(a), to = middle(b);
  double length = 0;
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](int k) { return surface.point(from + (to - from) * k / steps); };
    length += (at(i + 1) - at(i)).norm();
  }
  return length;
}

bool has_unusual_edges(const CadShape& shape, const CadFace& face) {
  const auto& c = face.wires[0].coedges;
  return std::any_of(c.begin(), c.end(), [&](const Coedge& coedge) {
    return coedge.internal || shape.edges[coedge.edge - 1].degenerate;
  });
}

/// The sides that face each other: both pairs of a face of four edges, poles among them, the longer two of a
/// wedge of three, the two of a crescent.
std::vector<FacingSides> facing_sides(const CadShape& shape, const CadFace& face) {
  if (face.wires.size() != 1 || !face.wires[0].ordered) return {};
  const auto& c = face.wires[0].coedges;
  const auto edge = [&](std::size_t k) -> const CadEdge& { return shape.edges[c[k].edge - 1]; };
  if (c.size() == 4) {
    return {{&c[0], &c[2], std::max(edge(1).length, edge(3).length)},
            {&c[1], &c[3], std::max(edge(0).length, edge(2).length)}};
  }
  if (has_unusual_edges(shape, face)) return {};
  if (c.size() == 3) {
    std::size_t k = 0;
    for (const std::size_t other : {1, 2}) {
      if (edge(other).length < edge(k).length) k = other;
    }
    return {{&c[(k + 1) % 3], &c[(k + 2) % 3], edge(k).length}};
  }
  if (c.size() == 2 && c[0].edge != c[1].edge)
    return {{&c[0], &c[1], distance_across(shape, face, c[0], c[1])}};
  return {};
}

constexpr double narrow = 0.5;  // of a segment

/// A narrow face, one long side of which is one edge and the other several.
struct SplitStrip {
  int face;
  const Coedge* whole;
  std::vector<const Coedge*> parts;  ///< in the order of the wire
};

/// Length of an edge's segments, about.
double segment_length(const CadShape& shape, const std::vector<double>& wanted, int edge) {
  return shape.edges[edge].length / std::max(wanted[edge], 1.0);
}

/// Whether no part of a strip is as far as `limit` from its whole side.
bool is_narrower(const CadShape& shape, const SplitStrip& strip, double limit) {
  constexpr int places = 8, samples = 256;
  const CadEdge& whole = shape.edges[strip.whole->edge - 1];
  const EdgeCurve curve(whole);
  std::vector<Vector3> points;
  for (int i = 0; i <= samples; ++i)
    points.push_back(curve.point(whole.first + (whole.last - whole.first) * i / samples));
  for (const Coedge* part : strip.parts) {
    const CadEdge& edge = shape.edges[part->edge - 1];
    const EdgeCurve other(edge);
    for (int i = 0; i <= places; ++i) {
      const Vector3 p = other.point(edge.first + (edge.last - edge.first) * i / places);
      if (std::none_of(points.begin(), points.end(),
                       [&](const Vector3& q) { return (p - q).norm() < limit; }))
        return false;
    }
  }
  return true;
}

/// The strips of faces whose wire is two runs of long edges between short ones.
std::vector<SplitStrip> find_split_strips(const CadShape& shape, const std::vector<char>& used,
                                          const std::vector<double>& wanted) {
  constexpr double is_short = 0.1;  // of the longest edge
  std::vector<SplitStrip> strips;
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    const CadFace& face = shape.faces[i];
    if (!used[i] || face.wires.size() != 1 || !face.wires[0].ordered || face.wires[0].coedges.size() < 4)
      continue;
    const auto& c = face.wires[0].coedges;
    const std::size_t n = c.size();
    if (has_unusual_edges(shape, face)) continue;
    const auto length = [&](std::size_t k) { return shape.edges[c[k % n].edge - 1].length; };
    double longest = 0;
    for (std::size_t k = 0; k < n; ++k) longest = std::max(longest, length(k));
    std::size_t start = 0;
    while (start < n && length(start) >= is_short * longest) ++start;
    if (start == n) continue;
    std::vector<std::vector<const Coedge*>> runs;
    bool inside = false;
    for (std::size_t k = start; k < start + n; ++k) {
      const bool is_long = length(k) >= is_short * longest;
      if (is_long && !inside) runs.emplace_back();
      if (is_long) runs.back().push_back(&c[k % n]);
      inside = is_long;
    }
    if (runs.size() != 2) continue;
    if (runs[0].size() > 1) std::swap(runs[0], runs[1]);
    if (runs[0].size() != 1 || runs[1].size() < 2) continue;
    const SplitStrip strip{static_cast<int>(i), runs[0][0], runs[1]};
    if (is_narrower(shape, strip, narrow * segment_length(shape, wanted, strip.whole->edge - 1)))
      strips.push_back(strip);
  }
  return strips;
}

/// Sides that face each other: of faces with four always, of wedges and crescents where they are narrow.
/// \returns a flag for each face, whether it is a narrow wedge.
std::vector<char> tie_facing_sides(const CadShape& shape, const std::vector<char>& used,
                                   const std::vector<double>& wanted, TiedEdges& tied) {
  std::vector<char> is_wedge(shape.faces.size(), 0);
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    if (!used[i]) continue;
    const auto pairs = facing_sides(shape, shape.faces[i]);
    if (pairs.empty() || has_unusual_edges(shape, shape.faces[i])) continue;
    for (const FacingSides& sides : pairs) {
      const int a = sides.first->edge - 1, b = sides.second->edge - 1;
      const std::size_t count = shape.faces[i].wires[0].coedges.size();
      const bool is_narrow = sides.width < narrow * segment_length(shape, wanted, a);
      if (count == 4 || is_narrow) tied.tie(a, b);
      if (count == 3 && is_narrow) is_wedge[i] = 1;
    }
  }
  return is_wedge;
}

/// Whether one more or one fewer segment fits the wanted count better.
int change_of(int count, double wanted, int least) {
  return wanted >= count || count <= least ? 1 : -1;
}

double cost_of_change(int count, double wanted, int least) {
  const double ratio = (count + change_of(count, wanted, least)) / std::max(wanted, 0.5);
  return std::abs(std::log(ratio)) + 1e-6;
}

/// The counts of all edges: tied ones alike, rounded, and changed so that every face becomes even.
/// \param strips both sides of these get as many nodes; none where edges are not to be tied.
std::vector<int> choose_counts(const CadShape& shape, const std::vector<char>& used,
                               const std::vector<double>& wanted, const std::vector<int>& least,
                               const TinyFeatures& tiny, bool tie, const std::vector<SplitStrip>& strips,
                               int stride, std::vector<int>& odd_faces) {
  const int n = static_cast<int>(wanted.size());
  TiedEdges tied(wanted);
  for (int i = 0; i < n; ++i) {
    if (tiny.edges[i] != i) tied.tie(tiny.edges[i], i, std::numeric_limits<double>::infinity());
  }
  // One node more at the base of a wedge or the end of a strip would make elements far shorter than they are
  // wide; the triangle that is left is cut up by the subdivision.
  std::vector<char> may_be_odd(shape.faces.size(), 0);
  if (tie) {
    const std::vector<char> is_wedge = tie_facing_sides(shape, used, wanted, tied);
    if (stride == 2) may_be_odd = is_wedge;
  }
  for (const SplitStrip& strip : strips) may_be_odd[strip.face] = stride == 2;
  struct Class {
    double wanted = 0;
    int members = 0, least = 0, count = 0;
  };
  std::vector<Class> classes(n);
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    Class& c = classes[tied.find(i)];
    c.wanted += wanted[i];
    ++c.members;
    c.least = std::max(c.least, least[i]);
  }
  std::vector<ParityEdge> parity(n);
  std::vector<char> odd(shape.faces.size(), 0);
  for (int i = 0; i < n; ++i) {
    Class& c = classes[i];
    parity[i].cost = std::numeric_limits<double>::infinity();
    if (c.members == 0) continue;
    c.wanted /= c.members;
    c.count = std::max(c.least, static_cast<int>(std::lround(c.wanted)));
    parity[i].cost = c.members * cost_of_change(c.count, c.wanted, c.least);
  }
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    const int c = tied.find(i);
    for (const int face : odd_uses(shape.edges[i], used)) {
      if (may_be_odd[face]) continue;
      auto& faces = parity[c].faces;
      const auto it = std::find(faces.begin(), faces.end(), face);
      if (it == faces.end()) {
        faces.push_back(face);
      } else {
        faces.erase(it);
      }
      if (classes[c].count % 2 != 0) odd[face] ^= 1;
    }
  }
  odd_faces.clear();
  const std::vector<char> change = make_even(parity, odd, odd_faces);
  std::vector<int> counts(n, 0);
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    const int c = tied.find(i);
    counts[i] = classes[c].count;
    if (change[c]) counts[i] += change_of(classes[c].count, classes[c].wanted, classes[c].least);
  }
  const auto raise = [&](int edge, int by) {
    for (int i = 0; i < n; ++i) {
      if (counts[i] > 0 && tied.find(i) == tied.find(edge)) counts[i] += by;
    }
  };
  // A face that becomes odd by that keeps a triangle, which subdivision cuts up.
  for (const SplitStrip& strip : strips) {
    int more = -counts[strip.whole->edge - 1];
    int longest = strip.parts[0]->edge - 1;
    for (const Coedge* part : strip.parts) {
      more += counts[part->edge - 1];
      if (shape.edges[part->edge - 1].length > shape.edges[longest].length) longest = part->edge - 1;
    }
    if (more % 2 != 0 && stride == 1) continue;
    raise(more > 0 ? strip.whole->edge - 1 : longest, std::abs(more));
  }
  return counts;
}

double chord_of(const CadEdge& edge) {
  const EdgeCurve curve(edge);
  return (curve.point(edge.last) - curve.point(edge.first)).norm();
}

/// The parameter of node k of a curve that may have loops in it: where it comes nearest to a share of its
/// chord. \param before the parameters of the nodes 0 .. k - 1.
double parameter_near_chord(const CadEdge& edge, const EdgeCurve& curve, int k, int segments,
                            const std::vector<double>& before) {
  if (k == 0 || k == segments) return k == 0 ? edge.first : edge.last;
  constexpr int samples = 256;
  const double share = static_cast<double>(k) / segments;
  const Vector3 target = (1 - share) * curve.point(edge.first) + share * curve.point(edge.last);
  const double start = before.back(), reach = edge.last - start;
  double best = 0, nearest = std::numeric_limits<double>::infinity();
  for (int i = 1; i < samples; ++i) {
    // Room is left for the nodes that follow.
    const double t = start + reach * i / samples * (1 - 0.5 * share);
    const double distance = (curve.point(t) - target).norm();
    if (distance < nearest) {
      nearest = distance;
      best = t;
    }
  }
  return best;
}

/// Moves the nodes of one side of narrow faces to face those of the other: what shifts them by less than a
/// segment shears the quads between by more than a right angle where the face is far narrower than that, and
/// makes the sides of a wedge cross towards its tip.
class NarrowFaces {
 public:
  NarrowFaces(const CadShape& shape, const std::vector<char>& used, const std::vector<SplitStrip>& strips,
              BoundaryNodes& nodes)
      : shape_(shape), used_(used), strips_(strips), nodes_(nodes), settled_(shape.edges.size(), 0) {}

  void run() {
    for (std::size_t i = 0; i < shape_.faces.size(); ++i) {
      if (!used_[i]) continue;
      for (const FacingSides& sides : facing_sides(shape_, shape_.faces[i])) align(sides);
    }
    for (const SplitStrip& strip : strips_) align(strip);
  }

 private:
  void align(const FacingSides& sides) {
    const Coedge &first = *sides.first, &second = *sides.second;
    const int a = first.edge - 1, b = second.edge - 1;
    const CadEdge &edge_a = shape_.edges[a], &edge_b = shape_.edges[b];
    const int n = nodes_.edges[a].segments();
    if (a == b || n < 2 || nodes_.edges[b].segments() != n || first.internal || second.internal) return;
    if (edge_a.closed() || edge_b.closed() || nodes_.edges[a].borrowed || nodes_.edges[b].borrowed) return;
    if (!(sides.width < narrow * edge_a.length / n) || (settled_[a] && settled_[b])) return;
    // Both run round the face, one against the other.
    const bool against = first.forward == second.forward;
    const int leader = settled_[b] ? b : a;
    std::vector<int> targets = nodes_.edges[leader].nodes;
    if (against) std::reverse(targets.begin(), targets.end());
    follow(targets, leader == a ? b : a, false);
    settled_[a] = settled_[b] = 1;
  }

  /// The parts have nodes that cannot move, between them: the whole side follows.
  void align(const SplitStrip& strip) {
    const int whole = strip.whole->edge - 1;
    const CadEdge& edge = shape_.edges[whole];
    if (edge.closed() || nodes_.edges[whole].borrowed || settled_[whole]) return;
    std::vector<int> targets;
    for (const Coedge* part : strip.parts) {
      std::vector<int> nodes = nodes_.edges[part->edge - 1].nodes;
      if (nodes.empty()) return;
      if (!part->forward) std::reverse(nodes.begin(), nodes.end());
      targets.insert(targets.end(), nodes.begin() + (targets.empty() ? 0 : 1), nodes.end());
    }
    // The wire runs along the parts, and back along the whole side.
    if (strip.whole->forward) std::reverse(targets.begin(), targets.end());
    if (static_cast<int>(targets.size()) != nodes_.edges[whole].segments() + 1) return;
    if (follow(targets, whole, true)) settled_[whole] = 1;
  }

  /// Moves the nodes of an edge to where it is nearest to the targets, one for each node; false, and nothing
  /// is moved, if that would put two in one place.
  /// \param after_moved nodes come after where the one before has moved to, not after where it was.
  bool follow(const std::vector<int>& targets, int follower, bool after_moved) {
    BoundaryNodes::Edge& to = nodes_.edges[follower];
    const EdgeCurve curve(shape_.edges[follower]);
    const int n = to.segments();
    std::vector<double> parameters = to.parameters;
    const std::vector<double>& before = after_moved ? parameters : to.parameters;
    for (int k = 1; k < n; ++k) {
      const Vector3& target = nodes_.points[targets[k]];
      parameters[k] = nearest(curve, target, before[k - 1], to.parameters[k], to.parameters[k + 1]);
      if (!(parameters[k] > parameters[k - 1])) return false;
    }
    to.parameters = parameters;
    for (int k = 1; k < n; ++k) nodes_.points[to.nodes[k]] = curve.point(parameters[k]);
    return true;
  }

  /// The parameter nearest to a point by golden sections, no further than four fifths of the way to the nodes
  /// beside.
  static double nearest(const EdgeCurve& curve, const Vector3& target, double before, double at,
                        double after) {
    constexpr double golden = 0.61803398874989485, reach = 0.8;
    constexpr int sections = 40;
    double low = at - reach * (at - before), high = at + reach * (after - at);
    const auto distance = [&](double t) { return (curve.point(t) - target).squaredNorm(); };
    for (int i = 0; i < sections; ++i) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      if (distance(a) < distance(b))
        high = b;
      else
        low = a;
    }
    return 0.5 * (low + high);
  }

  const CadShape& shape_;
  const std::vector<char>& used_;
  const std::vector<SplitStrip>& strips_;
  BoundaryNodes& nodes_;
  std::vector<char> settled_;
};

}  // namespace

SamplingPlan::SamplingPlan(const CadShape& shape)
    : refine(shape.edges.size(), 1),
      bare(shape.edges.size(), 0),
      tiny(find_tiny_features(shape, std::vector<char>(shape.faces.size(), 1),
                              std::vector<Collapse>(shape.edges.size(), Collapse::no), 0)) {}

BoundaryNodes sample_edges(const CadShape& shape, const SizingField& field, int stride,
                           const std::vector<char>& used, const SamplingPlan& plan,
                           ExecutionContext& context) {
  const int n = static_cast<int>(shape.edges.size());
  BoundaryNodes result;
  result.stride = stride;
  result.vertex_nodes.assign(shape.vertices.size(), -1);
  result.edges.resize(n);

  SizingField::Sampler sampler(field);
  const std::vector<char> shared_ends = find_shared_ends(shape, plan.tiny);
  const std::vector<char> inner = find_inner_edges(shape);
  const std::vector<char> used_edges = find_used_edges(shape, used, plan.tiny);
  std::vector<CountTable> tables(n);
  std::vector<int> least(n, 0);
  std::vector<double> wanted(n, 0);
  for (int i = 0; i < n; ++i) {
    if (i % 256 == 0) context.report("sample", 0.5 * i / n);
    context.check();
    const CadEdge& edge = shape.edges[i];
    if (edge.degenerate || edge.length <= 0 || !used_edges[i] || plan.tiny.collapsed_edges[i]) continue;
    tables[i] = EdgeTabulator(edge, sampler).table;
    wanted[i] = tables[i].total() / result.stride;
    // A segment more where there would be one in any case.
    if (plan.refine[i] > 1) wanted[i] = std::max(wanted[i], 1.0) * plan.refine[i];
    if (plan.bare[i] && !plan.tiny.closed(edge)) wanted[i] *= chord_of(edge) / edge.length;
    least[i] = least_segments(plan.tiny.closed(edge), plan.bare[i] ? 0 : tables[i].turning, shared_ends[i],
                              inner[i], result.stride);
  }
  const std::vector<SplitStrip> strips = find_split_strips(shape, used, wanted);
  std::vector<int> counts =
      choose_counts(shape, used, wanted, least, plan.tiny, true, strips, result.stride, result.odd_faces);
  if (!result.odd_faces.empty()) {
    counts = choose_counts(shape, used, wanted, least, plan.tiny, false, {}, result.stride, result.odd_faces);
  }

  const auto vertex_node = [&](int vertex, const Vector3& fallback) {
    if (vertex == 0) {
      result.points.push_back(fallback);
      return static_cast<int>(result.points.size()) - 1;
    }
    const int end = plan.tiny.end(vertex);
    int& node = result.vertex_nodes[end - 1];
    if (node < 0) {
      node = static_cast<int>(result.points.size());
      result.points.push_back(shape.vertices[end - 1]);
    }
    return result.vertex_nodes[vertex - 1] = node;
  };
  // Vertices first, so that the numbering does not depend on the counts.
  for (int i = 0; i < n; ++i) {
    const CadEdge& edge = shape.edges[i];
    if (!used_edges[i]) continue;
    if (edge.first_vertex > 0) vertex_node(edge.first_vertex, Vector3::Zero());
    if (edge.last_vertex > 0) vertex_node(edge.last_vertex, Vector3::Zero());
  }
  for (std::size_t face = 0; face < shape.faces.size(); ++face) {
    if (!used[face]) continue;
    for (const InnerVertex& point : shape.faces[face].inner_vertices)
      vertex_node(point.vertex, Vector3::Zero());
  }
  context.check();
  SparseCheck check(context, 64);
  for (int i = 0; i < n; ++i) {
    if (counts[i] == 0) continue;
    const CadEdge& edge = shape.edges[i];
    const EdgeCurve curve(edge);
    BoundaryNodes::Edge& nodes = result.edges[i];
    const int segments = counts[i] * result.stride;
    const bool along_chord = plan.bare[i] && !plan.tiny.closed(edge);
    for (int k = 0; k <= segments; ++k) {
      check();
      double t = along_chord ? parameter_near_chord(edge, curve, k, segments, nodes.parameters)
                             : tables[i].parameter_at(tables[i].total() * k / segments);
      if (k == 0) t = edge.first;
      if (k == segments) t = edge.last;
      nodes.parameters.push_back(t);
      if (plan.tiny.edges[i] != i) continue;  // the nodes of another edge, below
      if (k == 0) {
        nodes.nodes.push_back(vertex_node(edge.first_vertex, curve.point(t)));
      } else if (k == segments) {
        nodes.nodes.push_back(plan.tiny.closed(edge) ? nodes.nodes.front()
                                                     : vertex_node(edge.last_vertex, curve.point(t)));
      } else {
        nodes.nodes.push_back(static_cast<int>(result.points.size()));
        result.points.push_back(curve.point(t));
      }
    }
  }
  NarrowFaces(shape, used, strips, result).run();
  for (int i = 0; i < n; ++i) {
    if (counts[i] == 0 || plan.tiny.edges[i] == i) continue;
    result.edges[i].nodes = result.edges[plan.tiny.edges[i]].nodes;
    result.edges[i].borrowed = true;
    if (plan.tiny.reversed_edges[i]) std::reverse(result.edges[i].nodes.begin(), result.edges[i].nodes.end());
  }
  return result;
}

namespace {

/// Dijkstra from one odd face to the nearest other odd face or to the outside; exchanges the path.
class NearestPairs {
 public:
  NearestPairs(const std::vector<ParityEdge>& edges, int faces)
      : edges_(edges), outside_(faces), adjacency_(faces + 1), change_(edges.size(), 0) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto& uses = edges[i].faces;
      if (!std::isfinite(edges[i].cost) || uses.empty() || uses.size() > 2) continue;
      const int a = uses[0], b = uses.size() == 2 ? uses[1] : outside_;
      adjacency_[a].push_back({b, static_cast<int>(i)});
      adjacency_[b].push_back({a, static_cast<int>(i)});
    }
  }

  /// \return false if no other odd face and no free edge can be reached.
  bool pair_up(int start, std::vector<char>& odd) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> distance(adjacency_.size(), infinity);
    std::vector<std::pair<int, int>> from(adjacency_.size(), {-1, -1});
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    distance[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [d, at] = queue.top();
      queue.pop();
      if (d > distance[at]) continue;
      if (at != start && (at == outside_ || odd[at])) {
        for (int node = at; node != start; node = from[node].first) change_[from[node].second] ^= 1;
        odd[start] = 0;
        if (at != outside_) odd[at] = 0;
        return true;
      }
      for (const auto& [to, edge] : adjacency_[at]) {
        const double next = d + (change_[edge] ? 0 : edges_[edge].cost);
        if (next < distance[to]) {
          distance[to] = next;
          from[to] = {at, edge};
          queue.push({next, to});
        }
      }
    }
    return false;
  }

  const std::vector<char>& change() const { return change_; }

 private:
  const std::vector<ParityEdge>& edges_;
  int outside_;
  std::vector<std::vector<std::pair<int, int>>> adjacency_;
  std::vector<char> change_;
};

using Bits = std::vector<std::uint64_t>;

void add_to(Bits& a, const Bits& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] ^= b[i];
}

int lowest_bit(const Bits& bits) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i]) return static_cast<int>(64 * i) + __builtin_ctzll(bits[i]);
  }
  return -1;
}

/// Solves for the odd faces with the cheapest basis of columns; whatever cannot be made even stays odd.
std::vector<char> eliminate(const std::vector<ParityEdge>& edges, std::vector<char>& odd) {
  struct Row {
    Bits faces, combination;
  };
  std::vector<int> order;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (std::isfinite(edges[i].cost) && !edges[i].faces.empty()) order.push_back(static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return edges[a].cost < edges[b].cost; });
  const std::size_t face_words = (odd.size() + 63) / 64, edge_words = (edges.size() + 63) / 64;
  std::map<int, Row> basis;  // by lowest bit
  for (const int edge : order) {
    Row row{Bits(face_words), Bits(edge_words)};
    for (const int face : edges[edge].faces) row.faces[face / 64] ^= std::uint64_t{1} << (face % 64);
    row.combination[edge / 64] |= std::uint64_t{1} << (edge % 64);
    for (int bit = lowest_bit(row.faces); bit >= 0; bit = lowest_bit(row.faces)) {
      const auto it = basis.find(bit);
      if (it == basis.end()) {
        basis.emplace(bit, std::move(row));
        break;
      }
      add_to(row.faces, it->second.faces);
      add_to(row.combination, it->second.combination);
    }
  }
  Row target{Bits(face_words), Bits(edge_words)};
  for (std::size_t face = 0; face < odd.size(); ++face) {
    if (odd[face]) target.faces[face / 64] |= std::uint64_t{1} << (face % 64);
  }
  std::fill(odd.begin(), odd.end(), 0);
  for (int bit = lowest_bit(target.faces); bit >= 0; bit = lowest_bit(target.faces)) {
    const auto it = basis.find(bit);
    if (it == basis.end()) {
      odd[bit] = 1;
      target.faces[bit / 64] ^= std::uint64_t{1} << (bit % 64);
      continue;
    }
    add_to(target.faces, it->second.faces);
    add_to(target.combination, it->second.combination);
  }
  std::vector<char> change(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) change[i] = target.combination[i / 64] >> (i % 64) & 1;
  return change;
}

}  // namespace

std::vector<char> make_even(const std::vector<ParityEdge>& edges, std::vector<char> odd,
                            std::vector<int>& left_odd) {
  const std::vector<char> start = odd;
  NearestPairs pairs(edges, static_cast<int>(odd.size()));
  bool solved = true;
  for (std::size_t face = 0; face < odd.size() && solved; ++face) {
    if (odd[face]) solved = pairs.pair_up(static_cast<int>(face), odd);
  }
  std::vector<char> change = pairs.change();
  if (!solved) {
    odd = start;
    change = eliminate(edges, odd);
  }
  for (std::size_t face = 0; face < odd.size(); ++face) {
    if (odd[face]) left_odd.push_back(static_cast<int>(face) + 1);
  }
  return change;
}

}  // namespace quadrille
