/// Offsets the hole's loop on the surface line by line, while there is room and segments keep their length.

#include "mesher/faces/hole_rings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/base/vector.hpp"

namespace quadrille {

namespace {

/// Width of a ring over the length of the loop's segments: wanted and least.
constexpr double usual_width = 0.8, least_width = 0.45;
/// Rows of a ring's width that must fit into a gap beside the rings.
constexpr int rows_beside = 2;
/// Largest change of the width along the loop, over the distance.
constexpr double steepest = 0.25;
/// Limits for loops with rings: turn at each vertex (radians), and number of segments of the final mesh.
constexpr double largest_turn = 0.6;
constexpr std::size_t fewest_segments = 6;
/// Limits of the length of a segment on a line around a hole over that on the line before.
constexpr double shortest_segment = 0.5, longest_segment = 2.3;

/// The segments of all loops, and the vertices inside the face, sorted along an axis.
class Segments {
 public:
  struct Segment {
    Vector3 a, b;
    int loop;  // -1: a vertex inside the face
  };

  explicit Segments(const std::vector<Segment>& segments) {
    Eigen::AlignedBox3d box;
    for (const Segment& segment : segments) {
      box.extend(segment.a);
      longest_ = std::max(longest_, (segment.b - segment.a).norm());
    }
    box.sizes().maxCoeff(&axis_);
    for (const Segment& segment : segments) by_place_.emplace(segment.a[axis_], segment);
  }

  /// Visits the segments that may lie within `reach` of p.
  template <class Visit>
  void near(const Vector3& p, double reach, Visit&& visit) const {
    const auto last = by_place_.upper_bound(p[axis_] + reach + longest_);
    for (auto it = by_place_.lower_bound(p[axis_] - reach - longest_); it != last; ++it) visit(it->second);
  }

 private:
  std::multimap<double, Segment> by_place_;  // on the axis
  double longest_ = 0;
  int axis_ = 0;
};

struct Loop {
  std::vector<int> segments;
  std::vector<HoleRings::Node> nodes;  // all nodes of the loop in the final mesh
  bool regular = true, smooth = true;
  bool outermost = false;
  int hole = -1;  // index of its rings in the result
};

using RingLine = std::vector<HoleRings::Node>;

bool is_hole(const Loop& loop) {
  return loop.regular && loop.smooth && !loop.outermost && loop.nodes.size() >= fewest_segments;
}

double area_of(const Loop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
    const Vector2 &p = loop.nodes[i].uv, &q = loop.nodes[(i + 1) % loop.nodes.size()].uv;
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return std::abs(sum);
}

std::vector<Loop> boundary_loops(const FaceBoundary& boundary) {
  std::vector<Loop> loops;
  std::vector<int> uses(boundary.uv.size(), 0);
  int end = -1;
  for (std::size_t i = 0; i < boundary.segments.size(); ++i) {
    const auto& segment = boundary.segments[i];
    if (segment.a != end) loops.emplace_back();
    Loop& loop = loops.back();
    loop.segments.push_back(static_cast<int>(i));
    loop.regular = loop.regular && !segment.degenerate && !segment.internal;
    loop.smooth = loop.smooth && std::abs(boundary.angles[segment.a] - M_PI) < largest_turn;
    loop.nodes.push_back({boundary.uv[segment.a], boundary.points[segment.a]});
    if (segment.middle_node >= 0) loop.nodes.push_back({segment.middle_uv, segment.middle_point});
    ++uses[segment.a];
    end = segment.b == boundary.segments[loop.segments.front()].a ? -1 : segment.b;
  }
  for (Loop& loop : loops) {
    loop.regular = loop.regular &&
                   boundary.segments[loop.segments.back()].b == boundary.segments[loop.segments.front()].a;
    for (const int i : loop.segments) loop.regular = loop.regular && uses[boundary.segments[i].a] == 1;
  }
  const auto outermost = std::max_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return area_of(a) < area_of(b); });
  if (outermost != loops.end()) outermost->outermost = true;
  return loops;
}

std::vector<Segments::Segment> all_segments(const FaceBoundary& boundary, const std::vector<Loop>& loops) {
  std::vector<Segments::Segment> segments;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto& nodes = loops[i].nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      segments.push_back({nodes[k].point, nodes[(k + 1) % nodes.size()].point, static_cast<int>(i)});
  }
  std::vector<char> on_loop(boundary.points.size(), 0);
  for (const auto& segment : boundary.segments) on_loop[segment.a] = on_loop[segment.b] = 1;
  for (std::size_t i = 0; i < on_loop.size(); ++i)
    if (!on_loop[i]) segments.push_back({boundary.points[i], boundary.points[i], -1});
  return segments;
}

/// The quads between lines of as many nodes each.
HoleRings::Hole joined(const std::vector<RingLine>& lines) {
  HoleRings::Hole hole;
  const int n = static_cast<int>(lines.front().size()), count = static_cast<int>(lines.size());
  for (const RingLine& line : lines) hole.points.insert(hole.points.end(), line.begin(), line.end());
  for (int first = 0; first < (count - 1) * n; first += n) {
    for (int k = 0; k < n; ++k) {
      const int next = (k + 1) % n;
      hole.quads.push_back({first + k, first + next, first + n + next, first + n + k});
    }
  }
  return hole;
}

double spacing(const std::vector<HoleRings::Node>& line, std::size_t i) {
  const std::size_t n = line.size();
  return 0.5 * ((line[(i + 1) % n].point - line[i].point).norm() +
                (line[(i + n - 1) % n].point - line[i].point).norm());
}

/// Moves the loops with rings to their outermost lines.
FaceBoundary boundary_inside(const FaceBoundary& boundary, const std::vector<Loop>& loops,
                             const std::vector<HoleRings::Hole>& holes) {
  FaceBoundary inside = boundary;
  inside.segments.clear();
  for (const Loop& loop : loops) {
    std::size_t j = 0;
    for (const int k : loop.segments) {
      FaceBoundary::Segment& segment = inside.segments.emplace_back(boundary.segments[k]);
      if (loop.hole < 0) continue;
      const HoleRings::Hole& hole = holes[loop.hole];
      const auto next = [&](int& node, Vector2& uv, Vector3& point) {
        node = HoleRings::node(hole.first + static_cast<int>(j));
        uv = hole.points[hole.outer(j)].uv;
        point = hole.points[hole.outer(j++)].point;
      };
      next(inside.nodes[segment.a], inside.uv[segment.a], inside.points[segment.a]);
      inside.angles[segment.a] = M_PI;
      if (segment.middle_node >= 0) next(segment.middle_node, segment.middle_uv, segment.middle_point);
    }
  }
  return inside;
}

class RingPlacer {
 public:
  RingPlacer(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
             std::vector<Loop> loops)
      : boundary_(boundary),
        surface_(surface),
        domain_(domain),
        loops_(std::move(loops)),
        segments_(all_segments(boundary, loops_)) {}

  HoleRings run(int rings) && {
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (is_hole(loops_[i])) add_rings(i, rings);
    if (!result_.holes.empty()) result_.inside = boundary_inside(boundary_, loops_, result_.holes);
    return std::move(result_);
  }

 private:
  /// Adds up to `rings` rings around a hole.
  void add_rings(std::size_t index, int rings) {
    Loop& loop = loops_[index];
    std::vector<RingLine> lines{loop.nodes};
    const double side = side_of(loop);
    for (int count = rings; count > 0 && lines.size() < 2; --count) {
      const std::vector<double> widths = side == 0 ? std::vector<double>{} : find_widths(index, count, side);
      for (int k = 0; k < count && !widths.empty() && add_line(lines, widths, side); ++k) continue;
      if (static_cast<int>(lines.size()) < count + 1) lines.resize(1);
    }
    if (lines.size() < 2) return;
    HoleRings::Hole hole = joined(lines);
    for (const int k : loop.segments) {
      const auto& segment = boundary_.segments[k];
      hole.nodes.push_back(boundary_.nodes[segment.a]);
      if (segment.middle_node >= 0) hole.nodes.push_back(segment.middle_node);
    }
    hole.first = next_;
    next_ += static_cast<int>(hole.nodes.size());
    loop.hole = static_cast<int>(result_.holes.size());
    result_.holes.push_back(std::move(hole));
  }

  /// Unit vector tangent to the surface and normal to a line: to its left if side is 1, to its right if -1.
  Vector3 across(const std::vector<HoleRings::Node>& line, std::size_t i, double side) const {
    const std::size_t n = line.size();
    const Vector3 along = line[(i + 1) % n].point - line[(i + n - 1) % n].point;
    return side * surface_.normal(line[i].uv).cross(along).normalized();
  }

  /// The side of the loop on which the face lies: 1 = left, -1 = right, 0 = not clear. Looks beside the
  /// longest segment, since at a corner the face may be narrow.
  double side_of(const Loop& loop) const {
    constexpr double beside = 0.2;
    const std::size_t n = loop.nodes.size();
    std::size_t longest = 0;
    const auto along = [&](std::size_t k) -> Vector3 {
      return loop.nodes[(k + 1) % n].point - loop.nodes[k].point;
    };
    for (std::size_t k = 1; k < n; ++k)
      if (along(k).squaredNorm() > along(longest).squaredNorm()) longest = k;
    const Vector2 start = loop.nodes[longest].uv;
    const Vector3 to_middle = 0.5 * along(longest), normal = surface_.normal(start).cross(along(longest));
    for (const double side : {1.0, -1.0}) {
      Vector2 uv = start;
      surface_.move(uv, loop.nodes[longest].point + to_middle + beside * side * normal);
      if (domain_.inside(uv)) return side;
    }
    return 0;
  }

  /// The width of each of `count` rings at the nodes of a loop; empty if there is no room.
  std::vector<double> find_widths(std::size_t index, int count, double side) const {
    const auto& line = loops_[index].nodes;
    const std::size_t n = line.size();
    std::vector<double> widths(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3& p = line[i].point;
      const Vector3 outward = across(line, i, side);
      const double wanted = usual_width * spacing(line, i);
      widths[i] = wanted;
      segments_.near(p, wanted * (2 * count + rows_beside), [&](const Segments::Segment& other) {
        const Vector3 way = 0.5 * (other.a + other.b) - p;
        const bool own = other.loop == static_cast<int>(index);
        if (own && way.dot(outward) < 0.5 * way.norm()) return;
        const bool ringed = other.loop >= 0 && is_hole(loops_[other.loop]);
        const double room = distance_to_segment(p, other.a, other.b);
        widths[i] = std::min(widths[i], room / ((ringed ? 2 : 1) * count + rows_beside));
      });
    }
    for (std::size_t k = 1; k < 4 * n; ++k) {  // twice around forward, then twice backward
      const std::size_t i = k < 2 * n ? k % n : n - 1 - k % n,
                        before = k < 2 * n ? (i + n - 1) % n : (i + 1) % n;
      widths[i] =
          std::min(widths[i], widths[before] + steepest * (line[i].point - line[before].point).norm());
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!(widths[i] > least_width * spacing(line, i))) return {};
    }
    return widths;
  }

  /// Adds the next line around a hole; false if it would leave the face or make bad quads.
  bool add_line(std::vector<RingLine>& lines, const std::vector<double>& widths, double side) const {
    const RingLine& last = lines.back();
    const std::size_t n = last.size();
    std::vector<HoleRings::Node> line(n);
    for (std::size_t i = 0; i < n; ++i) {
      line[i].uv = last[i].uv;
      line[i].point = surface_.move(line[i].uv, last[i].point + widths[i] * across(last, i, side)).point;
      if (!line[i].point.allFinite() || !domain_.inside(line[i].uv)) return false;
      const double width = (line[i].point - last[i].point).norm();
      if (!(width > 0.8 * widths[i]) || !(width < 1.2 * widths[i])) return false;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3 before = last[(i + 1) % n].point - last[i].point,
                    now = line[(i + 1) % n].point - line[i].point;
      const double ratio = now.dot(before) / before.squaredNorm();
      if (!(ratio > shortest_segment) || !(ratio < longest_segment)) return false;
    }
    lines.push_back(std::move(line));
    return true;
  }

  const FaceBoundary& boundary_;
  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  std::vector<Loop> loops_;
  const Segments segments_;
  HoleRings result_;
  int next_ = 0;
};

}  // namespace

HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings) {
  std::vector<Loop> loops = boundary_loops(boundary);
  if (loops.size() < 2 || std::none_of(loops.begin(), loops.end(), is_hole)) return {};
  return RingPlacer(boundary, surface, domain, std::move(loops)).run(rings);
}

}  // namespace quadrille
