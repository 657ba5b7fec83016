/// Based on: Remacle et al., A frontal Delaunay quad mesh generator using the L-infinity norm (2013), for the
/// frontal idea and the norm. Here all points are placed first, with a hash grid in space, and triangulated
/// in bulk afterwards.

#include "mesher/faces/point_placement.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/place_text.hpp"

namespace quadrille {

namespace {

/// Points in buckets by cell and size level. Each point is entered on its own and on neighboring levels, so a
/// search visits few cells of one level. Buckets may hold points of other cells: the caller tests distances.
class PointGrid {
 public:
  PointGrid(std::size_t expected, const ExecutionContext& context) : check_(context) { rebuild(expected); }

  /// \param index what the caller knows the point by
  void insert(const Vector3& place, double size, int index) {
    constexpr int levels_near = 2;
    points_.push_back({place, index});
    const int level = level_of(size);
    for (int k = level - levels_near; k <= level + levels_near; ++k) {
      if (4 * (entries_.size() + 1) > 3 * heads_.size()) rebuild(2 * heads_.size());
      entries_.push_back({static_cast<int>(points_.size()) - 1, k, -1});
      link(static_cast<int>(entries_.size()) - 1);
    }
  }

  /// Whether `visit(place, index)` is true for a point of about `size` that may lie within `radius` of p.
  template <class Visit>
  bool any_near(const Vector3& p, double radius, double size, Visit&& visit) const {
    const int level = level_of(size);
    const double inverse = inverse_width(level);
    const std::array<long, 3> low = cell_of(p - Vector3::Constant(radius), inverse);
    const std::array<long, 3> high = cell_of(p + Vector3::Constant(radius), inverse);
    for (long z = low[2]; z <= high[2]; ++z) {
      for (long y = low[1]; y <= high[1]; ++y) {
        for (long x = low[0]; x <= high[0]; ++x) {
          for (int i = heads_[bucket({x, y, z}, level)]; i >= 0; i = entries_[i].next) {
            const Point& point = points_[entries_[i].point];
            if (entries_[i].level == level && visit(point.place, point.index)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  struct Point {
    Vector3 place;
    int index;
  };
  struct Entry {
    int point;
    int level;
    int next;
  };

  static int level_of(double size) { return std::ilogb(size); }
  static double inverse_width(int level) { return std::ldexp(1.0, -level - 1); }
  static std::array<long, 3> cell_of(const Vector3& p, double inverse) {
    return {std::lround(std::floor(p.x() * inverse)), std::lround(std::floor(p.y() * inverse)),
            std::lround(std::floor(p.z() * inverse))};
  }
  std::size_t bucket(const std::array<long, 3>& cell, int level) const {
    std::uint64_t h = static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15ULL;
    h ^= static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4FULL + (h >> 29);
    h ^= static_cast<std::uint64_t>(cell[2]) * 0x165667B19E3779F9ULL + (h >> 31);
    h ^= static_cast<std::uint64_t>(level) * 0x27D4EB2F165667C5ULL;
    return (h ^ (h >> 32)) & (heads_.size() - 1);
  }
  void link(int i) {
    Entry& entry = entries_[i];
    int& head = heads_[bucket(cell_of(points_[entry.point].place, inverse_width(entry.level)), entry.level)];
    entry.next = head;
    head = i;
  }
  void rebuild(std::size_t buckets) {
    heads_.assign(std::bit_ceil(std::max<std::size_t>(buckets, 64)), -1);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      check_();
      link(static_cast<int>(i));
    }
  }

  SparseCheck check_;
  std::vector<Point> points_;
  std::vector<Entry> entries_;  ///< one for each level that a point is entered on
  std::vector<int> heads_;
};

/// A limit for damaged files, whose faces may be unbounded.
constexpr std::size_t most_points = 20'000'000;

/// Boundary segments are shorter or longer than the size in the field where edges share their counts with
/// others. Sizes start as those of the segments, at least `least_ratio` and at most `most_ratio` times the
/// field's. Each step away from the boundary reduces the difference to the field by the factor `ratio_decay`.
constexpr double least_ratio = 0.4, most_ratio = 1.2, ratio_decay = 0.7;

/// A point of the front.
struct FrontPoint {
  Vector2 uv;
  SurfacePoint at;
  Vector3 normal;
  Vector3 direction{0, 0, 0};  // unit tangent: one of the four directions of the cross
  double size = 0;
  double ratio = 1;  // size over that of the sizing field there
  bool proposes = true;
};

/// The mean of two tangents as crosses (4-fold symmetric), in the plane with this normal.
Vector3 cross_mean(const Vector3& a, const Vector3& b, const Vector3& normal) {
  const Vector3 e1 = (a - a.dot(normal) * normal).normalized();
  const Vector3 e2 = normal.cross(e1);
  const double angle = std::atan2(b.dot(e2), b.dot(e1));
  const double fourfold = std::remainder(angle, M_PI / 2);
  return (std::cos(fourfold / 2) * e1 + std::sin(fourfold / 2) * e2).normalized();
}

class Placer {
 public:
  Placer(const FaceBoundary& boundary, const FaceSurface& surface, const TrimmedDomain& domain,
         SizingField::Sampler& size_at, const PlacementOptions& options, ExecutionContext& context)
      : boundary_(boundary),
        surface_(surface),
        domain_(domain),
        size_at_(size_at),
        options_(options),
        context_(context),
        grid_(4 * boundary.uv.size(), context) {}

  PlacedPoints run() {
    add_boundary();
    const std::size_t first = front_.size();
    for (std::size_t i = 0; i < front_.size(); ++i) {
      if (i % 256 == 0) {
        context_.check();
        if (front_.size() > most_points)
          throw failure("", fmt::format("it would take more than {} points at this size", most_points));
      }
      if (front_[i].proposes) propose_neighbors(i);
    }
    context_.check();
    PlacedPoints result;
    for (std::size_t i = first; i < front_.size(); ++i) {
      result.uv.push_back(front_[i].uv);
      result.points.push_back(front_[i].at.point);
    }
    return result;
  }

 private:
  void add_boundary() {
    const int n = boundary_.size();
    for (int i = 0; i < n; ++i) {
      FrontPoint point;
      point.uv = boundary_.uv[i];
      point.at = surface_.evaluate(point.uv);
      point.normal = surface_.normal(point.at, point.uv);
      point.size = options_.scale * size_at_.across(size_at_(boundary_.points[i]), surface_, boundary_.uv[i]);
      front_.push_back(point);
    }
    follow_segments();
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate) {
        front_[segment.a].proposes = front_[segment.b].proposes = false;  // a pole
        continue;
      }
      const Vector3 along = (boundary_.points[segment.b] - boundary_.points[segment.a]).normalized();
      for (const int i : {segment.a, segment.b}) {
        Vector3& tangent = front_[i].direction;
        tangent = tangent.isZero() ? along : cross_mean(tangent, along, front_[i].normal);
      }
    }
    for (int i = 0; i < n; ++i) {
      FrontPoint& point = front_[i];
      const Vector3 flat = point.direction - point.direction.dot(point.normal) * point.normal;
      point.proposes &= flat.norm() > 1e-6;
      point.direction = point.proposes ? flat.normalized() : Vector3::Zero();
      grid_.insert(boundary_.points[i], point.size, i);
    }
    add_blockers();
  }

  /// Gives the boundary's points the size of their segments. The wanted length of a segment is the mean of
  /// the sizes at its ends.
  void follow_segments() {
    std::vector<double> ratio(boundary_.size(), 0);
    std::vector<int> count(boundary_.size(), 0);
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate) continue;
      const double length = (boundary_.points[segment.b] - boundary_.points[segment.a]).norm();
      const double own = 2 * length / (front_[segment.a].size + front_[segment.b].size);
      for (const int i : {segment.a, segment.b}) ratio[i] += (own - ratio[i]) / ++count[i];
    }
    for (int i = 0; i < boundary_.size(); ++i) {
      if (count[i] > 0) front_[i].ratio = std::clamp(ratio[i], least_ratio, most_ratio);
      front_[i].size *= front_[i].ratio;
    }
  }

  /// Adds blockers inside long boundary segments: they refuse placed points nearby.
  void add_blockers() {
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate) continue;
      const Vector3& a = boundary_.points[segment.a];
      const Vector3& b = boundary_.points[segment.b];
      const double length = (b - a).norm(), size = front_[segment.a].size;
      if (length < 1.1 * size) continue;
      const double pieces = std::ceil(length / (0.6 * size));
      if (!(pieces + static_cast<double>(blockers_.size()) < static_cast<double>(most_points)))
        throw failure("", fmt::format("a segment of its boundary is {} long where sizes are {}: the file "
                                      "may be damaged",
                                      number_text(length), number_text(size)));
      for (int k = 1; k < static_cast<int>(pieces); ++k) {
        grid_.insert(a + (b - a) * k / pieces, size, -1 - static_cast<int>(blockers_.size()));
        blockers_.push_back(boundary_.uv[segment.a] +
                            (boundary_.uv[segment.b] - boundary_.uv[segment.a]) * k / pieces);
      }
    }
  }

  void propose_neighbors(std::size_t i) {
    const FrontPoint from = front_[i];
    const Vector3 across = from.normal.cross(from.direction);
    for (const Vector3& direction : {across, Vector3(-across), from.direction, Vector3(-from.direction)})
      propose(from, direction);
  }

  void propose(const FrontPoint& from, const Vector3& direction) {
    FrontPoint to;
    double length = from.size;
    if (!step(from, direction, length, to)) return;
    to.ratio = 1 + (from.ratio - 1) * ratio_decay;
    const double size = to.ratio * options_.scale * size_at_.across(size_at_(to.at.point), surface_, to.uv);
    const double wanted = 0.5 * (from.size + size);
    if (std::abs(wanted - length) > 0.05 * length) {
      length = wanted;
      if (!step(from, direction, length, to)) return;
    }
    to.size = size;
    to.normal = surface_.normal(to.at, to.uv);
    const Vector3 flat = from.direction - from.direction.dot(to.normal) * to.normal;
    if (flat.squaredNorm() < 0.01) return;
    to.direction = flat.normalized();
    if (refused(to)) return;
    grid_.insert(to.at.point, to.size, static_cast<int>(front_.size()));
    front_.push_back(to);
  }

  /// Makes one step on the surface, and corrects its length in space once. False if it leaves the face.
  bool step(const FrontPoint& from, const Vector3& direction, double length, FrontPoint& to) const {
    Vector2 change = FaceSurface::parameter_step(from.at, length * direction);
    to.uv = from.uv + change;
    to.at = surface_.evaluate(to.uv);
    if (!surface_.planar()) {
      const double reached = (to.at.point - from.at.point).norm();
      if (!(reached > 1e-3 * length)) return false;
      if (std::abs(reached - length) > 0.02 * length) {
        to.uv = from.uv + change * (length / reached);
        to.at = surface_.evaluate(to.uv);
      }
    }
    return domain_.inside(to.uv);
  }

  /// The approximate distance between two places along the surface, by the derivatives at one point.
  double way_along(const SurfacePoint& at, const Vector2& from, const Vector2& to) const {
    Vector2 change = to - from;
    if (surface_.u_periodic()) change.x() = std::remainder(change.x(), surface_.u_period());
    if (surface_.v_periodic()) change.y() = std::remainder(change.y(), surface_.v_period());
    return (change.x() * at.du + change.y() * at.dv).norm();
  }

  /// Whether another point on the same sheet is too near. A rolled face has other sheets nearby.
  bool refused(const FrontPoint& p) const {
    constexpr double same_sheet = 4;
    const Vector3 across = p.normal.cross(p.direction);
    const double limit = options_.refusal * p.size;
    const double reach = limit * M_SQRT2;
    return grid_.any_near(p.at.point, reach, p.size, [&](const Vector3& place, int i) {
      const Vector3 d = place - p.at.point;
      if (i < 0) {
        return d.squaredNorm() < 0.36 * p.size * p.size &&
               way_along(p.at, p.uv, blockers_[-1 - i]) < same_sheet * reach;
      }
      if (d.squaredNorm() > reach * reach || front_[i].normal.dot(p.normal) < -0.2) return false;
      if (std::min(way_along(p.at, p.uv, front_[i].uv), way_along(front_[i].at, p.uv, front_[i].uv)) >
          same_sheet * reach)
        return false;
      return std::abs(d.dot(p.direction)) < limit && std::abs(d.dot(across)) < limit;
    });
  }

  const FaceBoundary& boundary_;
  const FaceSurface& surface_;
  const TrimmedDomain& domain_;
  SizingField::Sampler& size_at_;
  const PlacementOptions& options_;
  ExecutionContext& context_;
  std::vector<FrontPoint> front_;
  PointGrid grid_;                 // by the index of the front point, or -1 - blocker
  std::vector<Vector2> blockers_;  // (blockers) parameters
};

}  // namespace

PlacedPoints place_points(const FaceBoundary& boundary, const FaceSurface& surface,
                          const TrimmedDomain& domain, SizingField::Sampler& size_at,
                          const PlacementOptions& options, ExecutionContext& context) {
  return Placer(boundary, surface, domain, size_at, options, context).run();
}

}  // namespace quadrille
