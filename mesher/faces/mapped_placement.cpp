/// Based on: Gordon & Hall, Construction of curvilinear co-ordinate systems and applications to mesh
/// generation (1973).

#include "mesher/faces/mapped_placement.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

constexpr double corner_turning = 0.8;  // radians; a right-angled corner turns by pi / 2
constexpr double smooth_turning = 0.6;  // what other boundary points may turn
constexpr double least_jacobian = 0.3;  // of a grid cell

/// The boundary as one loop of points, in the order of the wire; empty if it is not one loop.
std::vector<int> single_loop(const FaceBoundary& boundary) {
  std::vector<int> next(boundary.size(), -1);
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate || segment.internal || next[segment.a] >= 0) return {};
    next[segment.a] = segment.b;
  }
  std::vector<int> loop;
  int at = boundary.segments.front().a;
  for (int k = 0; k < boundary.size(); ++k) {
    loop.push_back(at);
    at = next[at];
    if (at < 0) return {};
    if (at == loop.front()) break;
  }
  return static_cast<int>(loop.size()) == boundary.size() && at == loop.front() ? loop : std::vector<int>{};
}

/// Positions in the loop of the four corners; fewer or more if there are not just four.
std::vector<int> find_corners(const FaceBoundary& boundary, const FaceSurface& surface,
                              const std::vector<int>& loop) {
  std::vector<int> corners;
  const int n = static_cast<int>(loop.size());
  double sense = 0;
  std::vector<double> turnings(n);
  for (int i = 0; i < n; ++i) {
    const Vector3& p = boundary.points[loop[i]];
    const Vector3 normal = surface.normal(boundary.uv[loop[i]]);
    // In the tangent plane: round a tube of four segments the sides themselves turn by right angles.
    const auto tangential = [&](const Vector3& v) { return Vector3(v - v.dot(normal) * normal); };
    const Vector3 in = tangential(p - boundary.points[loop[(i + n - 1) % n]]),
                  out = tangential(boundary.points[loop[(i + 1) % n]] - p);
    turnings[i] = std::atan2(in.cross(out).dot(normal), in.dot(out));
    sense += turnings[i];
  }
  for (int i = 0; i < n; ++i) {
    const double turning = sense < 0 ? -turnings[i] : turnings[i];
    if (turning > corner_turning) {
      corners.push_back(i);
    } else if (std::abs(turning) > smooth_turning) {
      return {};
    }
  }
  return corners;
}

class Grid {
 public:
  /// \param sides point instances of the four sides, ends included, each in the direction of its grid
  /// coordinate.
  Grid(const FaceBoundary& boundary, const FaceSurface& surface, std::array<std::vector<int>, 4> sides,
       const ExecutionContext& context)
      : columns_(static_cast<int>(sides[0].size())),
        rows_(static_cast<int>(sides[1].size())),
        checked_(context) {
    uv_.resize(static_cast<std::size_t>(columns_) * rows_);
    points_.resize(uv_.size());
    const auto& [bottom, right, top, left] = sides;
    const auto place = [&](int i, int j, int instance) {
      uv_[index(i, j)] = boundary.uv[instance];
      points_[index(i, j)] = boundary.points[instance];
    };
    for (int i = 0; i < columns_; ++i) {
      place(i, 0, bottom[i]);
      place(i, rows_ - 1, top[i]);
    }
    for (int j = 0; j < rows_; ++j) {
      place(0, j, left[j]);
      place(columns_ - 1, j, right[j]);
    }
    for (int j = 1; j + 1 < rows_; ++j) {
      for (int i = 1; i + 1 < columns_; ++i) {
        checked_();
        uv_[index(i, j)] = interpolate(i, j);
        points_[index(i, j)] = surface.point(uv_[index(i, j)]);
      }
    }
  }

  PlacedPoints inner_points() const {
    PlacedPoints result;
    for (int j = 1; j + 1 < rows_; ++j) {
      for (int i = 1; i + 1 < columns_; ++i) {
        result.uv.push_back(uv_[index(i, j)]);
        result.points.push_back(points_[index(i, j)]);
      }
    }
    return result;
  }

  bool cells_are_good() const {
    for (int j = 0; j + 1 < rows_; ++j) {
      for (int i = 0; i + 1 < columns_; ++i) {
        checked_();
        if (quad_scaled_jacobian(points_[index(i, j)], points_[index(i + 1, j)], points_[index(i + 1, j + 1)],
                                 points_[index(i, j + 1)]) < least_jacobian) {
          return false;
        }
        // Not folded in the parameter plane either.
        const Vector2 a = uv_[index(i + 1, j)] - uv_[index(i, j)],
                      b = uv_[index(i, j + 1)] - uv_[index(i, j)];
        const Vector2 c = uv_[index(i, j + 1)] - uv_[index(i + 1, j + 1)];
        const Vector2 d = uv_[index(i + 1, j)] - uv_[index(i + 1, j + 1)];
        const double first = a.x() * b.y() - a.y() * b.x(), last = c.x() * d.y() - c.y() * d.x();
        if (!(first * orientation() > 0) || !(last * orientation() > 0)) return false;
      }
    }
    return true;
  }

  /// Whether nearly all inner sides are of about the size wanted, or of that of the boundary where this has
  /// more nodes than wanted, as round a thin tube.
  bool follows(SizingField::Sampler& size_at, double scale) const {
    int sides = 0, off = 0;
    const auto length = [&](int a, int b) { return (points_[b] - points_[a]).norm(); };
    const auto check = [&](int a, int b, double at_boundary) {
      const double wanted = scale * size_at(0.5 * (points_[a] + points_[b]));
      ++sides;
      off += length(a, b) < 0.55 * std::min(wanted, at_boundary) || length(a, b) > 1.5 * wanted;
    };
    const int last_row = rows_ - 1, last_column = columns_ - 1;
    for (int j = 1; j < last_row; ++j) {
      for (int i = 1; i < last_column; ++i) {
        checked_();
        check(index(i, j), index(i + 1, j),
              std::max(length(index(i, 0), index(i + 1, 0)),
                       length(index(i, last_row), index(i + 1, last_row))));
        check(index(i, j), index(i, j + 1),
              std::max(length(index(0, j), index(0, j + 1)),
                       length(index(last_column, j), index(last_column, j + 1))));
      }
    }
    return 10 * off <= sides;
  }

 private:
  int index(int i, int j) const { return j * columns_ + i; }

  double orientation() const {
    const Vector2 a = uv_[index(columns_ - 1, 0)] - uv_[index(0, rows_ - 1)];
    const Vector2 b = uv_[index(columns_ - 1, rows_ - 1)] - uv_[index(0, 0)];
    return a.x() * b.y() - a.y() * b.x() > 0 ? 1 : -1;
  }

  /// The Coons patch in the parameter plane.
  Vector2 interpolate(int i, int j) const {
    const double s = static_cast<double>(i) / (columns_ - 1), t = static_cast<double>(j) / (rows_ - 1);
    const int m = columns_ - 1, n = rows_ - 1;
    const Vector2 across = (1 - s) * uv_[index(0, j)] + s * uv_[index(m, j)];
    const Vector2 along = (1 - t) * uv_[index(i, 0)] + t * uv_[index(i, n)];
    const Vector2 corners = (1 - s) * ((1 - t) * uv_[index(0, 0)] + t * uv_[index(0, n)]) +
                            s * ((1 - t) * uv_[index(m, 0)] + t * uv_[index(m, n)]);
    return across + along - corners;
  }

  int columns_, rows_;
  std::vector<Vector2> uv_;
  std::vector<Vector3> points_;
  mutable SparseCheck checked_;
};

}  // namespace

std::optional<PlacedPoints> place_mapped(const FaceBoundary& boundary, const FaceSurface& surface,
                                         const TrimmedDomain& domain, SizingField::Sampler& size_at,
                                         double scale, const ExecutionContext& context) {
  const std::vector<int> loop = single_loop(boundary);
  if (loop.size() < 4) return std::nullopt;
  const std::vector<int> corners = find_corners(boundary, surface, loop);
  if (corners.size() != 4) return std::nullopt;
  const int n = static_cast<int>(loop.size());
  std::array<std::vector<int>, 4> sides;
  for (int k = 0; k < 4; ++k) {
    const int from = corners[k], to = corners[(k + 1) % 4];
    for (int i = from;; i = (i + 1) % n) {
      sides[k].push_back(loop[i]);
      if (i == to) break;
    }
  }
  if (sides[0].size() != sides[2].size() || sides[1].size() != sides[3].size()) return std::nullopt;
  // The loop runs round; the grid's coordinates run from left to right and from bottom to top.
  for (const int k : {2, 3}) sides[k] = {sides[k].rbegin(), sides[k].rend()};
  const Grid grid(boundary, surface, std::move(sides), context);
  if (!grid.cells_are_good() || !grid.follows(size_at, scale)) return std::nullopt;
  PlacedPoints placed = grid.inner_points();
  SparseCheck check(context);
  for (const Vector2& uv : placed.uv) {
    check();
    if (!domain.inside(uv)) return std::nullopt;
  }
  return placed;
}

}  // namespace quadrille
