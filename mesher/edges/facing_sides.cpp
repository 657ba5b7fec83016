/// Pairs edges of faces with two to four of them; strips are recognized by short ends and runs of long edges.

#include "mesher/edges/facing_sides.hpp"

#include <algorithm>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// The distance across the face between the middles of two coedges.
double distance_across(const CadShape& shape, const CadFace& face, const Coedge& a, const Coedge& b) {
  constexpr int steps = 8;
  const auto middle = [&](const Coedge& coedge) {
    const CadEdge& edge = shape.edges[coedge.edge];
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

/// Whether all parts of a strip lie closer than `limit` to its whole side.
bool is_narrower(const CadShape& shape, const SplitStrip& strip, double limit) {
  constexpr int places = 8, samples = 256;
  const CadEdge& whole = shape.edges[strip.whole->edge];
  const EdgeCurve curve(whole);
  std::vector<Vector3> points;
  for (int i = 0; i <= samples; ++i)
    points.push_back(curve.point(whole.first + (whole.last - whole.first) * i / samples));
  for (const Coedge* part : strip.parts) {
    const CadEdge& edge = shape.edges[part->edge];
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

}  // namespace

double segment_length(const CadShape& shape, const IdVector<EdgeId, double>& wanted, EdgeId edge) {
  return shape.edges[edge].length / std::max(wanted[edge], 1.0);
}

bool has_unusual_edges(const CadShape& shape, const CadFace& face) {
  const auto& c = face.wires[0].coedges;
  return std::any_of(c.begin(), c.end(), [&](const Coedge& coedge) {
    return coedge.internal || shape.edges[coedge.edge].degenerate;
  });
}

std::vector<FacingSides> facing_sides(const CadShape& shape, const CadFace& face) {
  if (face.wires.size() != 1 || !face.wires[0].ordered) return {};
  const auto& c = face.wires[0].coedges;
  const auto edge = [&](std::size_t k) -> const CadEdge& { return shape.edges[c[k].edge]; };
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

std::vector<SplitStrip> find_split_strips(const CadShape& shape, const FaceFlags& used,
                                          const IdVector<EdgeId, double>& wanted) {
  constexpr double is_short = 0.1;  // length over that of the longest edge
  std::vector<SplitStrip> strips;
  for (const FaceId id : shape.faces.ids()) {
    const CadFace& face = shape.faces[id];
    if (!used[id] || face.wires.size() != 1 || !face.wires[0].ordered || face.wires[0].coedges.size() < 4)
      continue;
    const auto& c = face.wires[0].coedges;
    const std::size_t n = c.size();
    if (has_unusual_edges(shape, face)) continue;
    const auto length = [&](std::size_t k) { return shape.edges[c[k % n].edge].length; };
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
    const SplitStrip strip{id, runs[0][0], runs[1]};
    if (is_narrower(shape, strip, narrow * segment_length(shape, wanted, strip.whole->edge)))
      strips.push_back(strip);
  }
  return strips;
}

}  // namespace quadrille
