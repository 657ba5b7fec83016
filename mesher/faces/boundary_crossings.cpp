/// Finds candidates by box intersection (Zomorodian & Edelsbrunner, Fast software for box intersections,
/// 2002, as in CGAL), then applies exact predicates.

// CGAL first: OpenCASCADE defines a macro named Handle.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include "mesher/faces/boundary_crossings.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"

namespace quadrille {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;

Point to_point(const Vector2& p) {
  return {p.x(), p.y()};
}

/// Whether two segments meet anywhere but at a common end.
bool cross(const Segment& s, const Segment& t) {
  if (s == t || s == t.opposite()) return false;
  if (s.is_degenerate() || t.is_degenerate() || !CGAL::do_intersect(s, t)) return false;
  for (const int i : {0, 1}) {
    for (const int k : {0, 1}) {
      if (s.vertex(i) != t.vertex(k)) continue;
      // With a common end, they cross only if one lies on the other.
      const Point &at = s.vertex(i), &a = s.vertex(1 - i), &b = t.vertex(1 - k);
      return CGAL::orientation(at, a, b) == CGAL::COLLINEAR &&
             !CGAL::collinear_are_strictly_ordered_along_line(a, at, b);
    }
  }
  return true;
}

/// A segment of the boundary in the parameter plane, divided into pieces along its parametric curve.
std::vector<Point> refined(const FaceBoundary& boundary, const FaceBoundary::Segment& segment, int pieces) {
  const Vector2 &a = boundary.uv[segment.a], &b = boundary.uv[segment.b];
  std::vector<Point> line{to_point(a)};
  const auto on_curve = [&](double t) { return parametric_point(*segment.coedge, t); };
  for (int k = 1; k < pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    // The ends may have been moved by periods, or to the start of the next edge.
    const Vector2 moved = (1 - share) * (a - on_curve(segment.from)) + share * (b - on_curve(segment.to));
    line.push_back(to_point(on_curve(segment.from + share * (segment.to - segment.from)) + moved));
  }
  line.push_back(to_point(b));
  return line;
}

bool cross(const std::vector<Point>& a, const std::vector<Point>& b) {
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    for (std::size_t k = 0; k + 1 < b.size(); ++k) {
      if (cross(Segment(a[i], a[i + 1]), Segment(b[k], b[k + 1]))) return true;
    }
  }
  return false;
}

/// The chords of segments, and lines that bulge out three times as far as the middles of the curves.
struct Span {
  std::vector<Point> chords, bulges;

  /// \param line the ends of the segments, with the middles of the curves between them.
  explicit Span(const std::vector<Point>& line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i % 2 == 0) chords.push_back(line[i]);
      bulges.push_back(i % 2 == 0 ? line[i]
                                  : line[i] + 2 * (line[i] - CGAL::midpoint(line[i - 1], line[i + 1])));
    }
  }
};

/// Whether the gap between curves is narrower than they bulge from their chords. Triangles between them then
/// leave no room for the nodes in the middle.
bool crowd(const Span& a, const Span& b) {
  return cross(a.chords, b.bulges) || cross(a.bulges, b.chords) || cross(a.bulges, b.bulges);
}

/// The number of pieces of each of two segments from which on they neither cross nor crowd each other; 0 =
/// none found. Always 0 for a view from above, since the parametric curves do not lie in its plane.
int pieces_apart(const FaceBoundary& boundary, const FaceSurface& surface, const std::pair<int, int>& pair) {
  constexpr int max_pieces = 32;
  const auto &s = boundary.segments[pair.first], &t = boundary.segments[pair.second];
  if (s.degenerate || t.degenerate || surface.is_view()) return 0;
  for (int pieces = 2; pieces <= max_pieces; pieces *= 2) {
    if (cross(refined(boundary, s, pieces), refined(boundary, t, pieces))) continue;
    const bool need_room = boundary.stride == 2 && !boundary.touch(s, t);
    if (!need_room || !crowd(Span(refined(boundary, s, 2 * pieces)), Span(refined(boundary, t, 2 * pieces))))
      return pieces;
  }
  return 0;
}

EdgeStretch stretch_of(const FaceBoundary::Segment& segment, int pieces) {
  return {segment.edge, std::min(segment.from, segment.to), std::max(segment.from, segment.to), pieces};
}

/// The name of a segment's edge, and the part of the edge.
std::string name_of(const CadShape& shape, const FaceBoundary::Segment& segment) {
  if (!segment.edge.exists()) return "a pole";
  const auto [low, high] = std::minmax(segment.from, segment.to);
  return fmt::format("Edge{} (parameters {} to {})", shape.edges[segment.edge].number, number_text(low, high),
                     number_text(high, low));
}

/// The pairs (i < j, ascending) of segments that meet anywhere but at common ends. Segments that coincide are
/// the two sides of a slit and do not count. Exact. Time: O(n log n + pairs) if the segments are spread out.
std::vector<std::pair<int, int>> crossing_segments(const FaceBoundary& boundary) {
  std::vector<Box> boxes;
  boxes.reserve(boundary.segments.size());
  const auto ends = [&](int i) {
    const auto& segment = boundary.segments[i];
    return Segment(to_point(boundary.uv[segment.a]), to_point(boundary.uv[segment.b]));
  };
  for (int i = 0; i < static_cast<int>(boundary.segments.size()); ++i) boxes.emplace_back(ends(i).bbox(), i);
  std::vector<std::pair<int, int>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (cross(ends(a.info()), ends(b.info()))) pairs.push_back(std::minmax(a.info(), b.info()));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The pairs of segments that crowd() each other, without those that share a node.
std::vector<std::pair<int, int>> crowding_segments(const FaceBoundary& boundary) {
  std::vector<std::pair<int, int>> pairs;
  if (boundary.stride != 2) return pairs;
  std::map<int, Span> spans;
  std::vector<Box> boxes;
  for (int i = 0; i < static_cast<int>(boundary.segments.size()); ++i) {
    const auto& segment = boundary.segments[i];
    if (segment.degenerate || segment.middle_node < 0) continue;
    const std::vector line{to_point(boundary.uv[segment.a]), to_point(segment.middle_uv),
                           to_point(boundary.uv[segment.b])};
    const auto& bulge = spans.emplace(i, line).first->second.bulges;
    boxes.emplace_back(bulge[0].bbox() + bulge[1].bbox() + bulge[2].bbox(), i);
  }
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const auto &s = boundary.segments[a.info()], &t = boundary.segments[b.info()];
    if (!boundary.touch(s, t) && crowd(spans.at(a.info()), spans.at(b.info())))
      pairs.push_back(std::minmax(a.info(), b.info()));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

double largest_stray(const FaceBoundary& boundary, const FaceSurface& surface) {
  double largest = 0;
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate) continue;
    const double length = (boundary.points[segment.b] - boundary.points[segment.a]).norm();
    for (const int i : {segment.a, segment.b}) {
      const double off = (surface.point(boundary.uv[i]) - boundary.points[i]).norm();
      largest = std::max(largest, off / std::max(length, 1e-300));
    }
  }
  return largest;
}

std::optional<FaceProblem> crossing_problem(FaceId face, const CadShape& shape, const FaceBoundary& boundary,
                                            const FaceSurface& surface) {
  constexpr double stray = 0.5;  // in segment lengths
  const auto pairs = crossing_segments(boundary);
  if (pairs.empty()) return std::nullopt;
  std::vector<EdgeStretch> stretches;
  std::pair<int, int> worst = pairs.front();
  Cause cause = Cause::coarse_segments;
  for (const auto& pair : pairs) {
    const auto &s = boundary.segments[pair.first], &t = boundary.segments[pair.second];
    if (const int pieces = pieces_apart(boundary, surface, pair)) {
      for (const auto* segment : {&s, &t}) stretches.push_back(stretch_of(*segment, pieces));
    } else if (cause == Cause::coarse_segments) {
      cause = s.edge == t.edge && s.edge.exists() ? Cause::looped_edge : Cause::crossing_curves;
      worst = pair;
    }
  }
  if (cause == Cause::crossing_curves && largest_stray(boundary, surface) > stray)
    cause = Cause::stray_curves;
  const auto &s = boundary.segments[worst.first], &t = boundary.segments[worst.second];
  const Vector3& near = boundary.points[s.a];
  FaceProblem problem(cause, face,
                      fmt::format("the boundary of Face{} crosses or touches itself near {}, "
                                  "where {} meets {}",
                                  face.number(), place_text(near), name_of(shape, s), name_of(shape, t)));
  for (const EdgeId edge : std::set{s.edge, t.edge}) {
    if (edge.exists()) problem.edges.push_back(edge);
  }
  problem.stretches = std::move(stretches);
  return problem;
}

std::optional<FaceProblem> crowding_problem(FaceId face, const FaceBoundary& boundary,
                                            const FaceSurface& surface) {
  std::vector<EdgeStretch> stretches;
  const Vector3* near = nullptr;
  for (const auto& pair : crowding_segments(boundary)) {
    const int pieces = pieces_apart(boundary, surface, pair);
    if (pieces == 0) continue;
    for (const int i : {pair.first, pair.second})
      stretches.push_back(stretch_of(boundary.segments[i], pieces));
    if (near == nullptr) near = &boundary.segments[pair.first].middle_point;
  }
  if (stretches.empty()) return std::nullopt;
  FaceProblem problem(Cause::narrow_gaps, face,
                      fmt::format("Face{} is narrower near {} than its edges bulge between nodes",
                                  face.number(), place_text(*near)));
  problem.stretches = std::move(stretches);
  return problem;
}

}  // namespace quadrille
