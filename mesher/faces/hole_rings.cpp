/// Offsets the hole's loop on the surface line by line, while there is room and segments keep their length.
/// Rows of given heights fit or do not.

#include "mesher/faces/hole_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/base/nearest_on_segment.hpp"
#include "mesher/faces/loop_rows.hpp"

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

double distance(const Vector3& p, const Vector3& a, const Vector3& b) {
  return (a + nearest_share(a, b, p) * (b - a) - p).norm();
}

/// The segments of all loops, and the vertices inside the face, sorted along an axis.
class Segments {
 public:
  struct Segment {
    Vector3 a, b;
    int loop;  // -1: a vertex inside the face
  };

  explicit Segments(std::vector<Segment> segments) : segments_(std::move(segments)) {
    Vector3 low = segments_.front().a, high = low;
    for (const Segment& segment : segments_) {
      low = low.cwiseMin(segment.a);
      high = high.cwiseMax(segment.a);
      longest_ = std::max(longest_, (segment.b - segment.a).norm());
    }
    (high - low).maxCoeff(&axis_);
    std::sort(segments_.begin(), segments_.end(),
              [this](const Segment& a, const Segment& b) { return a.a[axis_] < b.a[axis_]; });
  }

  /// Visits the segments that may lie within `reach` of p.
  template <class Visit>
  void near(const Vector3& p, double reach, Visit&& visit) const {
    const double from = p[axis_] - reach - longest_, to = p[axis_] + reach + longest_;
    auto it = std::lower_bound(segments_.begin(), segments_.end(), from,
                               [this](const Segment& segment, double x) { return segment.a[axis_] < x; });
    for (; it != segments_.end() && it->a[axis_] <= to; ++it) visit(*it);
  }

 private:
  std::vector<Segment> segments_;
  double longest_ = 0;
  int axis_ = 0;
};

class RingPlacer {
 public:
  RingPlacer(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain)
      : boundary_(boundary), surface_(surface), domain_(domain) {}

  HoleRings run(int rings, const std::function<std::vector<double>(EdgeId)>& heights) {
    find_loops();
    for (Loop& loop : loops_) find_heights(loop, heights);
    const bool any_rows = std::any_of(loops_.begin(), loops_.end(), has_rows);
    if (!any_rows && (loops_.size() < 2 || std::none_of(loops_.begin(), loops_.end(), is_hole))) return {};
    const Segments segments(all_segments());
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      if (has_rows(loops_[i])) {
        if (!add_rows(i, segments)) return std::move(result_);
      } else if (is_hole(loops_[i])) {
        add_rings(i, rings, segments);
      }
    }
    place_loops();
    return std::move(result_);
  }

 private:
  struct Loop {
    std::vector<int> segments;
    std::vector<HoleRings::Node> nodes;  // all nodes of the loop in the final mesh
    bool regular = true, smooth = true;
    bool outermost = false;
    std::vector<double> heights;  // of the rows asked for
    int hole = -1;                // index of its rings or rows in the result
  };
  using Line = std::vector<HoleRings::Node>;

  static bool has_rows(const Loop& loop) { return !loop.heights.empty(); }

  static bool is_hole(const Loop& loop) {
    return loop.regular && loop.smooth && !loop.outermost && loop.nodes.size() >= fewest_segments;
  }

  void find_loops() {
    std::vector<int> uses(boundary_.uv.size(), 0);
    int end = -1;
    for (std::size_t i = 0; i < boundary_.segments.size(); ++i) {
      const auto& segment = boundary_.segments[i];
      if (segment.a != end) loops_.emplace_back();
      Loop& loop = loops_.back();
      loop.segments.push_back(static_cast<int>(i));
      loop.regular = loop.regular && !segment.degenerate && !segment.internal;
      loop.smooth = loop.smooth && std::abs(boundary_.angles[segment.a] - M_PI) < largest_turn;
      loop.nodes.push_back({boundary_.uv[segment.a], boundary_.points[segment.a]});
      if (segment.middle_node >= 0) loop.nodes.push_back({segment.middle_uv, segment.middle_point});
      ++uses[segment.a];
      end = segment.b == boundary_.segments[loop.segments.front()].a ? -1 : segment.b;
    }
    double largest = 0;
    Loop* outermost = nullptr;
    for (Loop& loop : loops_) {
      loop.regular = loop.regular && boundary_.segments[loop.segments.back()].b ==
                                         boundary_.segments[loop.segments.front()].a;
      for (const int i : loop.segments) loop.regular = loop.regular && uses[boundary_.segments[i].a] == 1;
      const double area = area_of(loop);
      if (area > largest || outermost == nullptr) outermost = &loop;
      largest = std::max(largest, area);
    }
    if (outermost != nullptr) outermost->outermost = true;
  }

  /// Notes the heights of rows along a loop, if all its edges ask for the same.
  void find_heights(Loop& loop, const std::function<std::vector<double>(EdgeId)>& heights) const {
    if (!loop.regular) return;
    for (const int i : loop.segments) {
      std::vector<double> wanted = heights(boundary_.segments[i].edge);
      if (wanted.empty() || (i != loop.segments.front() && wanted != loop.heights))
        return loop.heights.clear();
      loop.heights = std::move(wanted);
    }
  }

  /// Adds rows along a loop. \return false if they do not fit.
  bool add_rows(std::size_t index, const Segments& segments) {
    Loop& loop = loops_[index];
    const double side = side_of(loop);
    auto rows = side == 0 ? std::nullopt : place_rows(loop.nodes, loop.heights, side, surface_, domain_);
    int misfit = rows ? -1 : 0;
    for (std::size_t j = 0; rows && j < rows->outer.size() && misfit < 0; ++j) {
      if (is_too_near(rows->points[rows->outer[j]].point, index, segments)) misfit = static_cast<int>(j);
    }
    if (misfit >= 0) {
      result_.unfit = boundary_.segments[loop.segments.front()].edge;
      return false;
    }
    result_.has_rows = true;
    keep(loop, std::move(*rows));
    return true;
  }

  /// Whether a point at the end of a loop's rows is nearer to a boundary than these are high.
  bool is_too_near(const Vector3& point, std::size_t index, const Segments& segments) const {
    constexpr double rounding = 0.9;  // rows are straight, loops are curved
    const auto& heights = loops_[index].heights;
    const double own = rounding * std::accumulate(heights.begin(), heights.end(), 0.0);
    double largest = own;
    for (const Loop& other : loops_)
      largest =
          std::max(largest, std::accumulate(other.heights.begin(), other.heights.end(), heights.back()));
    bool near = false;
    segments.near(point, largest, [&](const Segments::Segment& other) {
      double room = own;
      if (other.loop != static_cast<int>(index)) {
        room = heights.back();
        if (other.loop >= 0) {
          const auto& theirs = loops_[other.loop].heights;
          room = std::accumulate(theirs.begin(), theirs.end(), room);
        }
      }
      near = near || distance(point, other.a, other.b) < room;
    });
    return near;
  }

  /// Adds up to `rings` rings around a hole.
  void add_rings(std::size_t index, int rings, const Segments& segments) {
    Loop& loop = loops_[index];
    std::vector<Line> lines{loop.nodes};
    const double side = side_of(loop);
    for (int count = rings; count > 0 && lines.size() < 2; --count) {
      const std::vector<double> widths =
          side == 0 ? std::vector<double>{} : find_widths(index, count, side, segments);
      for (int k = 0; k < count && !widths.empty() && add_line(lines, widths, side); ++k) continue;
      if (static_cast<int>(lines.size()) < count + 1) lines.resize(1);
    }
    if (lines.size() > 1) keep(loop, joined(lines));
  }

  /// The quads between lines of as many nodes each.
  static HoleRings::Hole joined(const std::vector<Line>& lines) {
    HoleRings::Hole hole;
    const int n = static_cast<int>(lines.front().size()), count = static_cast<int>(lines.size());
    for (const Line& line : lines) hole.points.insert(hole.points.end(), line.begin(), line.end());
    for (int k = 0; k < n; ++k) hole.outer.push_back((count - 1) * n + k);
    for (int first = 0; first < (count - 1) * n; first += n) {
      for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        hole.quads.push_back({first + k, first + next, first + n + next, first + n + k});
      }
    }
    return hole;
  }

  static double area_of(const Loop& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
      const Vector2 &p = loop.nodes[i].uv, &q = loop.nodes[(i + 1) % loop.nodes.size()].uv;
      sum += p.x() * q.y() - p.y() * q.x();
    }
    return std::abs(sum);
  }

  std::vector<Segments::Segment> all_segments() const {
    std::vector<Segments::Segment> segments;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      const auto& nodes = loops_[i].nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        segments.push_back({nodes[k].point, nodes[(k + 1) % nodes.size()].point, static_cast<int>(i)});
    }
    std::vector<char> on_loop(boundary_.points.size(), 0);
    for (const auto& segment : boundary_.segments) on_loop[segment.a] = on_loop[segment.b] = 1;
    for (std::size_t i = 0; i < on_loop.size(); ++i)
      if (!on_loop[i]) segments.push_back({boundary_.points[i], boundary_.points[i], -1});
    return segments;
  }

  /// Unit vector tangent to the surface and normal to a line: to its left if side is 1, to its right if -1.
  Vector3 across(const std::vector<HoleRings::Node>& line, std::size_t i, double side) const {
    const std::size_t n = line.size();
    const Vector3 along = line[(i + 1) % n].point - line[(i + n - 1) % n].point;
    return side * surface_.normal(line[i].uv).cross(along).normalized();
  }

  static double spacing(const std::vector<HoleRings::Node>& line, std::size_t i) {
    const std::size_t n = line.size();
    return 0.5 * ((line[(i + 1) % n].point - line[i].point).norm() +
                  (line[(i + n - 1) % n].point - line[i].point).norm());
  }

  /// The side of the loop on which the face lies: 1 = left, -1 = right, 0 = not clear.
  double side_of(const Loop& loop) const {
    for (const double side : {1.0, -1.0}) {
      Vector2 uv = loop.nodes[0].uv;
      surface_.move(uv, loop.nodes[0].point + 0.3 * spacing(loop.nodes, 0) * across(loop.nodes, 0, side));
      if (domain_.inside(uv)) return side;
    }
    return 0;
  }

  /// The width of each of `count` rings at the nodes of a loop; empty if there is no room.
  std::vector<double> find_widths(std::size_t index, int count, double side, const Segments& segments) const {
    const auto& line = loops_[index].nodes;
    const std::size_t n = line.size();
    std::vector<double> widths(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3& p = line[i].point;
      const Vector3 outward = across(line, i, side);
      const double wanted = usual_width * spacing(line, i);
      widths[i] = wanted;
      segments.near(p, wanted * (2 * count + rows_beside), [&](const Segments::Segment& other) {
        const bool own = other.loop == static_cast<int>(index);
        if (own &&
            (0.5 * (other.a + other.b) - p).dot(outward) < 0.5 * (0.5 * (other.a + other.b) - p).norm())
          return;
        const bool ringed = other.loop >= 0 && is_hole(loops_[other.loop]);
        widths[i] =
            std::min(widths[i], distance(p, other.a, other.b) / ((ringed ? 2 : 1) * count + rows_beside));
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
  bool add_line(std::vector<Line>& lines, const std::vector<double>& widths, double side) const {
    const Line& last = lines.back();
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

  /// Adds a hole to the result.
  void keep(Loop& loop, HoleRings::Hole hole) {
    for (const int i : loop.segments) {
      const auto& segment = boundary_.segments[i];
      hole.nodes.push_back(boundary_.nodes[segment.a]);
      if (segment.middle_node >= 0) hole.nodes.push_back(segment.middle_node);
    }
    hole.first = next_;
    next_ += static_cast<int>(hole.outer.size());
    loop.hole = static_cast<int>(result_.holes.size());
    result_.holes.push_back(std::move(hole));
  }

  /// Moves the loops with rings or rows to their outermost lines, which may be longer.
  void place_loops() {
    if (result_.holes.empty()) return;
    FaceBoundary& inside = result_.inside;
    inside = boundary_;
    inside.segments.clear();
    for (const Loop& loop : loops_) {
      if (loop.hole >= 0)
        place_line(loop, result_.holes[loop.hole]);
      else
        for (const int i : loop.segments) inside.segments.push_back(boundary_.segments[i]);
    }
  }

  void place_line(const Loop& loop, const HoleRings::Hole& hole) {
    FaceBoundary& inside = result_.inside;
    const int count = static_cast<int>(hole.outer.size()), before = static_cast<int>(loop.segments.size());
    const bool has_middles = boundary_.segments[loop.segments.front()].middle_node >= 0;
    const int stride = has_middles ? 2 : 1, first_new = inside.size();
    const auto end = [&](int k) {
      k %= count / stride;
      return k < before ? boundary_.segments[loop.segments[k]].a : first_new + k - before;
    };
    for (int k = 0; k < count / stride; ++k) {
      const auto& node = hole.points[hole.outer[stride * k]];
      FaceBoundary::Segment segment = boundary_.segments[loop.segments[std::min(k, before - 1)]];
      segment.a = end(k);
      segment.b = end(k + 1);
      if (k >= before) {
        inside.nodes.push_back(-1);
        inside.uv.emplace_back();
        inside.points.emplace_back();
        inside.angles.push_back(0);
      }
      inside.nodes[segment.a] = HoleRings::node(hole.first + stride * k);
      inside.uv[segment.a] = node.uv;
      inside.points[segment.a] = node.point;
      inside.angles[segment.a] = loop.heights.empty() ? M_PI : 0;
      if (has_middles) {
        const auto& middle = hole.points[hole.outer[stride * k + 1]];
        segment.middle_node = HoleRings::node(hole.first + stride * k + 1);
        segment.middle_uv = middle.uv;
        segment.middle_point = middle.point;
      }
      inside.segments.push_back(segment);
    }
  }

  const FaceBoundary& boundary_;
  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  std::vector<Loop> loops_;
  HoleRings result_;
  int next_ = 0;
};

}  // namespace

HoleRings place_rings(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
                      int rings, const std::function<std::vector<double>(EdgeId)>& heights) {
  return RingPlacer(boundary, surface, domain).run(rings, heights);
}

}  // namespace quadrille
