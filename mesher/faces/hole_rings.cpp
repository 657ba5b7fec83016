/// Offsets the hole's loop on the surface line by line, while there is room and segments keep their length.
/// Rows of given heights fit or do not.

#include "mesher/faces/hole_rings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/base/vector.hpp"
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

/// The segments of all loops, and the vertices inside the face, sorted along an axis.
class Segments {
 public:
  struct Segment {
    Vector3 a, b;
    int loop;                // -1: a vertex inside the face
    std::size_t number = 0;  // in the loop
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

/// Consecutive segments of a loop whose place in the rest of the face an outer line takes.
struct Part {
  const RowLine* line = nullptr;  // null for rings
  std::size_t first = 0, count = 0;
  std::array<int, 2> heads{0, 0};  // segments at the start and at the end on which rows end
  int hole = -1;                   // index of its rings or rows in the result
  double reach() const { return line == nullptr ? 0 : sum_of(line->heights); }
  bool is_open() const { return line != nullptr && !line->is_closed(); }
};

struct Loop {
  std::vector<int> segments;
  std::vector<HoleRings::Node> nodes;  // all nodes of the loop in the final mesh
  bool regular = true, smooth = true;
  bool outermost = false;
  std::vector<Part> parts;
};

using RingLine = std::vector<HoleRings::Node>;

bool is_hole(const Loop& loop) {
  return loop.regular && loop.smooth && !loop.outermost && loop.nodes.size() >= fewest_segments;
}

const FaceBoundary::Segment& segment_of(const FaceBoundary& boundary, const Loop& loop, std::size_t k) {
  return boundary.segments[loop.segments[k % loop.segments.size()]];
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
  double largest = 0;
  Loop* outermost = nullptr;
  for (Loop& loop : loops) {
    loop.regular = loop.regular &&
                   boundary.segments[loop.segments.back()].b == boundary.segments[loop.segments.front()].a;
    for (const int i : loop.segments) loop.regular = loop.regular && uses[boundary.segments[i].a] == 1;
    const double area = area_of(loop);
    if (area > largest || outermost == nullptr) outermost = &loop;
    largest = std::max(largest, area);
  }
  if (outermost != nullptr) outermost->outermost = true;
  return loops;
}

/// Finds the segments of a line, and those on which its rows end. \return false if they are not there.
bool add_part(const FaceBoundary& boundary, const RowLine& line, std::vector<Loop>& loops) {
  const auto is_along = [&](const Loop& loop, std::size_t k) {
    const EdgeId edge = segment_of(boundary, loop, k).edge;
    return std::find(line.edges.begin(), line.edges.end(), edge) != line.edges.end();
  };
  for (Loop& loop : loops) {
    const std::size_t n = loop.segments.size();
    std::size_t along = 0, first = 0;
    for (std::size_t k = 0; k < n; ++k) along += is_along(loop, k) ? 1 : 0;
    if (along == 0) continue;
    Part part{&line, 0, along};
    if (part.is_open()) {
      while (first < n && (!is_along(loop, first) || is_along(loop, first + n - 1))) ++first;
      for (std::size_t k = 0; k < along; ++k)
        if (!is_along(loop, first + k)) return false;
      for (const int end : {0, 1})
        if (line.ends[end] == RowLine::End::meets) part.heads[end] = static_cast<int>(line.heights.size());
      part.first = (first + n - part.heads[0]) % n;
      part.count += part.heads[0] + part.heads[1];
    }
    if (!loop.regular || part.count > n || part.is_open() != (part.count < n)) return false;
    loop.parts.push_back(part);
    return true;
  }
  return false;
}

std::vector<Segments::Segment> all_segments(const FaceBoundary& boundary, const std::vector<Loop>& loops) {
  std::vector<Segments::Segment> segments;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto& nodes = loops[i].nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      segments.push_back({nodes[k].point, nodes[(k + 1) % nodes.size()].point, static_cast<int>(i),
                          k * loops[i].segments.size() / nodes.size()});
  }
  std::vector<char> on_loop(boundary.points.size(), 0);
  for (const auto& segment : boundary.segments) on_loop[segment.a] = on_loop[segment.b] = 1;
  for (std::size_t i = 0; i < on_loop.size(); ++i)
    if (!on_loop[i]) segments.push_back({boundary.points[i], boundary.points[i], -1});
  return segments;
}

RowPath path_of(const Loop& loop, const Part& part) {
  if (!part.is_open()) return {loop.nodes, true, {0, 0}};
  RowPath path{{}, false, part.heads};
  for (std::size_t k = part.first; k <= part.first + part.count; ++k)
    path.nodes.push_back(loop.nodes[k % loop.nodes.size()]);
  return path;
}

/// The quads between lines of as many nodes each.
HoleRings::Hole joined(const std::vector<RingLine>& lines) {
  HoleRings::Hole hole;
  const int n = static_cast<int>(lines.front().size()), count = static_cast<int>(lines.size());
  for (const RingLine& line : lines) hole.points.insert(hole.points.end(), line.begin(), line.end());
  for (int k = 0; k < n; ++k) hole.outer.push_back((count - 1) * n + k);
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

/// The points of the outer line take the place of the part's own, as far as there are as many.
void place_line(const FaceBoundary& boundary, const Loop& loop, const Part& part, const HoleRings::Hole& hole,
                FaceBoundary& inside) {
  const bool has_middles = segment_of(boundary, loop, 0).middle_node >= 0;
  const int stride = has_middles ? 2 : 1, first_new = inside.size(), covered = static_cast<int>(part.count),
            count = (static_cast<int>(hole.outer.size()) - (part.is_open() ? 1 : 0)) / stride;
  const auto end = [&](int k) {
    if (k == count) return segment_of(boundary, loop, part.first + (part.is_open() ? part.count : 0)).a;
    return k < covered ? segment_of(boundary, loop, part.first + k).a : first_new + k - covered;
  };
  const auto place = [&](int k) {
    if (end(k) == inside.size()) inside.add(Vector2::Zero(), Vector3::Zero(), -1);
    const auto& node = hole.points[hole.outer[stride * k]];
    inside.nodes[end(k)] = HoleRings::node(hole.first + stride * k);
    inside.uv[end(k)] = node.uv;
    inside.points[end(k)] = node.point;
    inside.angles[end(k)] = part.line == nullptr ? M_PI : 0;
  };
  for (int k = 0; k < count; ++k) {
    FaceBoundary::Segment segment = segment_of(boundary, loop, part.first + std::min(k, covered - 1));
    segment.a = end(k);
    segment.b = end(k + 1);
    place(k);
    if (has_middles) {
      const auto& middle = hole.points[hole.outer[stride * k + 1]];
      segment.middle_node = HoleRings::node(hole.first + stride * k + 1);
      segment.middle_uv = middle.uv;
      segment.middle_point = middle.point;
    }
    inside.segments.push_back(segment);
  }
  if (part.is_open()) place(count);
}

/// Moves the parts of loops with rings or rows to their outer lines, which may be longer.
FaceBoundary boundary_inside(const FaceBoundary& boundary, const std::vector<Loop>& loops,
                             const std::vector<HoleRings::Hole>& holes) {
  FaceBoundary inside = boundary;
  inside.segments.clear();
  for (const Loop& loop : loops) {
    const std::size_t n = loop.segments.size();
    const std::size_t start = loop.parts.empty() ? 0 : loop.parts.front().first;
    for (std::size_t k = start; k < start + n;) {
      const auto part = std::find_if(loop.parts.begin(), loop.parts.end(),
                                     [&](const Part& own) { return own.first == k % n; });
      if (part == loop.parts.end()) {
        inside.segments.push_back(segment_of(boundary, loop, k++));
      } else {
        place_line(boundary, loop, *part, holes[part->hole], inside);
        k += part->count;
      }
    }
  }
  // Drop the points that only rows use.
  std::vector<int> target(inside.size(), 0);
  for (const auto& segment : boundary.segments) target[segment.a] = target[segment.b] = -1;
  for (const auto& segment : inside.segments) target[segment.a] = target[segment.b] = 0;
  for (int i = 0; i < inside.size(); ++i) target[i] = target[i] < 0 ? -1 : i;
  unite_points(inside, target);
  return inside;
}

class RingPlacer {
 public:
  /// \param loops with the parts that have rows
  RingPlacer(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
             std::vector<Loop> loops)
      : boundary_(boundary),
        surface_(surface),
        domain_(domain),
        loops_(std::move(loops)),
        segments_(all_segments(boundary, loops_)) {}

  HoleRings run(int rings) && {
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      for (Part& part : loops_[i].parts)
        if (!add_rows(loops_[i], part)) return std::move(result_);
      if (loops_[i].parts.empty() && is_hole(loops_[i])) add_rings(i, rings);
    }
    if (!result_.holes.empty()) result_.inside = boundary_inside(boundary_, loops_, result_.holes);
    return std::move(result_);
  }

 private:
  /// Adds rows along a part of a loop. \return false if they do not fit.
  bool add_rows(const Loop& loop, Part& part) {
    const double side = side_of(loop);
    auto rows = side == 0 ? std::nullopt
                          : place_rows(path_of(loop, part), part.line->heights, side, surface_, domain_);
    const auto is_misfit = [&](int point) { return is_too_near(rows->points[point].point, loop, part); };
    // At its ends, a chain's outer line comes to the loop.
    const auto skipped = [&](int end) -> long {
      const RowLine& line = *part.line;
      return line.is_closed() ? 0 : line.ends[end] == RowLine::End::meets ? 1 : std::ssize(line.heights);
    };
    if (!rows || std::any_of(rows->outer.begin() + skipped(0), rows->outer.end() - skipped(1), is_misfit)) {
      result_.unfit = part.line->edges.front();
      return false;
    }
    result_.has_rows = true;
    keep(loop, part, std::move(*rows));
    return true;
  }

  /// The part of its loop that a segment belongs to, unless rows only end there; null if there is none.
  const Part* part_along(const Segments::Segment& segment) const {
    if (segment.loop < 0) return nullptr;
    const Loop& loop = loops_[segment.loop];
    const std::size_t n = loop.segments.size();
    for (const Part& part : loop.parts) {
      const std::size_t k = (segment.number + n - part.first) % n;
      if (k >= static_cast<std::size_t>(part.heads[0]) && k + part.heads[1] < part.count) return &part;
    }
    return nullptr;
  }

  /// Whether a point at the end of a part's rows is nearer to a boundary than these are high.
  bool is_too_near(const Vector3& point, const Loop& loop, const Part& part) const {
    constexpr double rounding = 0.9;  // rows are straight, loops are curved
    const double own = rounding * part.reach(), least = part.line->heights.back();
    double largest = own;
    for (const Loop& other : loops_)
      for (const Part& rows : other.parts) largest = std::max(largest, rows.reach() + least);
    const std::size_t n = loop.segments.size();
    const EdgeId before = segment_of(boundary_, loop, part.first + part.heads[0] + n - 1).edge,
                 after = segment_of(boundary_, loop, part.first + part.count - part.heads[1]).edge;
    bool near = false;
    segments_.near(point, largest, [&](const Segments::Segment& other) {
      const Part* along = part_along(other);
      if (along == nullptr && part.is_open() && other.loop >= 0) {
        const EdgeId edge = segment_of(boundary_, loops_[other.loop], other.number).edge;
        if (edge == before || edge == after) return;  // the rows end there
      }
      const double room = along == &part ? own : least + (along == nullptr ? 0 : along->reach());
      near = near || distance_to_segment(point, other.a, other.b) < room;
    });
    return near;
  }

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
    loop.parts.push_back({nullptr, 0, loop.segments.size()});
    keep(loop, loop.parts.back(), joined(lines));
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
    double most_reach = 0;
    for (const Loop& loop : loops_)
      for (const Part& part : loop.parts) most_reach = std::max(most_reach, part.reach());
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3& p = line[i].point;
      const Vector3 outward = across(line, i, side);
      const double wanted = usual_width * spacing(line, i);
      widths[i] = wanted;
      segments_.near(p, wanted * (2 * count + rows_beside) + most_reach, [&](const Segments::Segment& other) {
        const bool own = other.loop == static_cast<int>(index);
        if (own &&
            (0.5 * (other.a + other.b) - p).dot(outward) < 0.5 * (0.5 * (other.a + other.b) - p).norm())
          return;
        const bool ringed = other.loop >= 0 && is_hole(loops_[other.loop]);
        const Part* rows = own ? nullptr : part_along(other);
        const double room = distance_to_segment(p, other.a, other.b) - (rows == nullptr ? 0 : rows->reach());
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

  /// Adds a hole to the result.
  void keep(const Loop& loop, Part& part, HoleRings::Hole hole) {
    for (std::size_t k = part.first; k < part.first + part.count; ++k) {
      const auto& segment = segment_of(boundary_, loop, k);
      hole.nodes.push_back(boundary_.nodes[segment.a]);
      if (segment.middle_node >= 0) hole.nodes.push_back(segment.middle_node);
    }
    if (part.is_open())
      hole.nodes.push_back(boundary_.nodes[segment_of(boundary_, loop, part.first + part.count).a]);
    hole.first = next_;
    next_ += static_cast<int>(hole.outer.size());
    part.hole = static_cast<int>(result_.holes.size());
    result_.holes.push_back(std::move(hole));
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
                      int rings, const std::vector<RowLine>& lines) {
  std::vector<Loop> loops = boundary_loops(boundary);
  for (const RowLine& line : lines) {
    if (add_part(boundary, line, loops)) continue;
    HoleRings unfit;
    unfit.unfit = line.edges.front();
    return unfit;
  }
  if (lines.empty() && (loops.size() < 2 || std::none_of(loops.begin(), loops.end(), is_hole))) return {};
  return RingPlacer(boundary, surface, domain, std::move(loops)).run(rings);
}

}  // namespace quadrille
