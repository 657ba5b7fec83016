/// Based on: Gordon & Hall, Construction of curvilinear co-ordinate systems and applications to mesh
/// generation (1973), with shares of arc length as coordinates.

#include "mesher/faces/face_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

using Outline = FaceSides::Outline;
using Line = std::vector<int>;  // points in a row

constexpr double least_jacobian = 0.3;  // of a cell

Line turned(Line line) {
  std::reverse(line.begin(), line.end());
  return line;
}

class GridMaker {
 public:
  GridMaker(const FaceBoundary& boundary, const FaceSides& sides, const FaceSurface& surface,
            SizingField::Sampler& size_at, const ExecutionContext& context)
      : boundary_(boundary), sides_(sides), surface_(surface), size_at_(size_at), check_(context) {}

  std::optional<FaceGrid> run() {
    if (sides_.outline == Outline::other || !find_loops()) return std::nullopt;
    switch (sides_.outline) {
      case Outline::four:
        if (!make_four()) return std::nullopt;
        break;
      case Outline::ring:
        if (!make_ring()) return std::nullopt;
        break;
      case Outline::odd:
        if (!make_odd()) return std::nullopt;
        break;
      case Outline::other:
        return std::nullopt;
    }
    if (!is_good() || !follows_sizes()) return std::nullopt;
    return std::move(grid_);
  }

 private:
  /// The boundary's loops, in the order of the wires, with the points in the middle of the segments.
  bool find_loops() {
    grid_.uv = boundary_.uv;
    grid_.points = boundary_.points;
    grid_.nodes = boundary_.nodes;
    for (const auto& segment : boundary_.segments) {
      if (segment.degenerate || segment.internal) return false;
      if (loops_.empty() || segment.a != end_) {
        if (!loops_.empty() && loops_.back().front() != end_) return false;
        loops_.emplace_back();
      }
      loops_.back().push_back(segment.a);
      end_ = segment.b;
      if (segment.middle_node < 0) continue;
      loops_.back().push_back(static_cast<int>(grid_.uv.size()));
      grid_.uv.push_back(segment.middle_uv);
      grid_.points.push_back(segment.middle_point);
      grid_.nodes.push_back(segment.middle_node);
    }
    if (loops_.empty() || loops_.back().front() != end_) return false;
    boundary_count_ = static_cast<int>(grid_.uv.size());
    std::size_t count = 0;
    for (const Line& loop : loops_) count += loop.size();
    return static_cast<int>(count) == boundary_count_;
  }

  /// The sides of the only loop, from corner to corner.
  std::vector<Line> cut_loop() const {
    const Line& loop = loops_.front();
    const int n = static_cast<int>(loop.size());
    std::vector<Line> lines;
    std::vector<int> corners;
    for (const int start : sides_.starts) {
      const int segment = boundary_.first_segments[0][start];
      const auto it = std::find(loop.begin(), loop.end(), segment < 0 ? -1 : boundary_.segments[segment].a);
      if (it == loop.end()) return {};
      corners.push_back(static_cast<int>(it - loop.begin()));
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      Line& line = lines.emplace_back();
      for (int i = corners[k];; i = (i + 1) % n) {
        line.push_back(loop[i]);
        if (i == corners[(k + 1) % corners.size()]) break;
      }
    }
    return lines;
  }

  bool make_four() {
    const std::vector<Line> sides = cut_loop();
    if (loops_.size() != 1 || sides.size() != 4) return false;
    if (sides[0].size() != sides[2].size() || sides[1].size() != sides[3].size()) return false;
    fill(sides[0], sides[1], turned(sides[2]), turned(sides[3]));
    return true;
  }

  /// Rows between two loops, from each node of one to that of the other which makes the way shortest.
  bool make_ring() {
    if (loops_.size() != 2 || loops_[0].size() != loops_[1].size()) return false;
    Line outer = loops_[0], inner = turned(loops_[1]);
    const int n = static_cast<int>(outer.size());
    const auto way = [&](int shift) {
      double sum = 0;
      for (int i = 0; i < n; i += std::max(1, n / 32))
        sum += (grid_.points[outer[i]] - grid_.points[inner[(i + shift) % n]]).norm();
      return sum;
    };
    int best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int shift = 0; shift < n; ++shift) {
      check_();
      const double sum = way(shift);
      if (sum < shortest) {
        shortest = sum;
        best = shift;
      }
    }
    std::rotate(inner.begin(), inner.begin() + best, inner.end());
    const int mid = n / 2;
    const std::vector<double> shares = rows_between(outer[mid], inner[mid]);
    std::vector<Line> rows{outer};
    for (std::size_t k = 1; k + 1 < shares.size(); ++k) {
      Line& row = rows.emplace_back();
      for (int i = 0; i < n; ++i) row.push_back(add_between(outer[i], inner[i], shares[k]));
    }
    rows.push_back(inner);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      for (int i = 0; i < n; ++i) {
        const int next = (i + 1) % n;
        grid_.quads.push_back({rows[k][i], rows[k][next], rows[k + 1][next], rows[k + 1][i]});
      }
    }
    return true;
  }

  /// Where rows lie between two points, as shares of the way in the parameter plane, by the sizes there.
  std::vector<double> rows_between(int from, int to) {
    constexpr int samples = 32;
    std::vector<double> counts{0};
    Vector3 before = grid_.points[from];
    for (int i = 1; i <= samples; ++i) {
      const double t = static_cast<double>(i) / samples;
      const Vector3 here = surface_.point((1 - t) * grid_.uv[from] + t * grid_.uv[to]);
      counts.push_back(counts.back() + (here - before).norm() / size_at_(0.5 * (here + before)));
      before = here;
    }
    const int rows = std::max(1, static_cast<int>(std::lround(counts.back())));
    std::vector<double> shares{0};
    int cell = 0;
    for (int k = 1; k < rows; ++k) {
      const double target = counts.back() * k / rows;
      while (cell + 1 < samples && counts[cell + 1] < target) ++cell;
      shares.push_back((cell + (target - counts[cell]) / (counts[cell + 1] - counts[cell])) / samples);
    }
    shares.push_back(1);
    return shares;
  }

  /// An odd number of corners: as many grids round one point, each with a corner of the face. Side i is cut
  /// in two, f_i and g_i segments, and the lines across have f_{i+1} = g_{i-1} of them.
  bool make_odd() {
    const std::vector<Line> sides = cut_loop();
    const int k = static_cast<int>(sides.size());
    if (loops_.size() != 1 || (k != 3 && k != 5)) return false;
    std::vector<int> count(k), first(k);
    for (int i = 0; i < k; ++i) count[i] = static_cast<int>(sides[i].size()) - 1;
    // count_i = f_i + f_{i+2}: going round by twos, an odd number of them.
    for (int i = 0; i < k; ++i) {
      int twice = 0;
      for (int j = 0, sign = 1; j < k; ++j, sign = -sign) twice += sign * count[(i + 2 * j) % k];
      if (twice <= 0 || twice % 2 != 0) return false;
      first[i] = twice / 2;
    }
    Vector2 middle(0, 0);
    std::vector<int> feet;
    for (int i = 0; i < k; ++i) {
      feet.push_back(sides[i][first[i]]);
      middle += grid_.uv[feet.back()] / k;
    }
    const int center = add_point(middle);
    std::vector<Line> spokes;  // from the sides to the center
    for (int i = 0; i < k; ++i) {
      const int n = first[(i + 1) % k];
      Line line{feet[i]};
      for (int j = 1; j < n; ++j) line.push_back(add_between(feet[i], center, static_cast<double>(j) / n));
      line.push_back(center);
      spokes.push_back(line);
    }
    for (int i = 0; i < k; ++i) {
      const int before = (i + k - 1) % k;
      const Line bottom(sides[i].begin(), sides[i].begin() + first[i] + 1);
      const Line left = turned(Line(sides[before].begin() + first[before], sides[before].end()));
      if (bottom.size() != spokes[before].size() || left.size() != spokes[i].size()) return false;
      fill(bottom, spokes[i], spokes[before], left);
    }
    return true;
  }

  int add_point(const Vector2& uv) {
    check_();
    grid_.uv.push_back(uv);
    grid_.points.push_back(surface_.point(uv));
    return static_cast<int>(grid_.uv.size()) - 1;
  }

  int add_between(int a, int b, double t) { return add_point((1 - t) * grid_.uv[a] + t * grid_.uv[b]); }

  std::vector<double> shares_of(const Line& line) const {
    std::vector<double> shares{0};
    for (std::size_t i = 1; i < line.size(); ++i)
      shares.push_back(shares.back() + (grid_.points[line[i]] - grid_.points[line[i - 1]]).norm());
    for (double& share : shares) share /= std::max(shares.back(), std::numeric_limits<double>::min());
    return shares;
  }

  /// A grid between four lines, each in the direction of its coordinate.
  void fill(const Line& bottom, const Line& right, const Line& top, const Line& left) {
    const std::size_t m = bottom.size() - 1, n = left.size() - 1;
    const std::vector<double> b = shares_of(bottom), t = shares_of(top), l = shares_of(left),
                              r = shares_of(right);
    const auto& uv = grid_.uv;
    std::vector<Line> rows{bottom};
    for (std::size_t j = 1; j < n; ++j) {
      Line& row = rows.emplace_back();
      row.push_back(left[j]);
      for (std::size_t i = 1; i < m; ++i) {
        // Where the lines between the shares cross.
        const double x = (b[i] + l[j] * (t[i] - b[i])) / (1 - (t[i] - b[i]) * (r[j] - l[j]));
        const double y = l[j] + x * (r[j] - l[j]);
        const Vector2 across = (1 - x) * uv[left[j]] + x * uv[right[j]];
        const Vector2 along = (1 - y) * uv[bottom[i]] + y * uv[top[i]];
        const Vector2 corners = (1 - x) * ((1 - y) * uv[bottom[0]] + y * uv[top[0]]) +
                                x * ((1 - y) * uv[bottom[m]] + y * uv[top[m]]);
        row.push_back(add_point(across + along - corners));
      }
      row.push_back(right[j]);
    }
    rows.push_back(top);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < m; ++i) {
        check_();
        grid_.quads.push_back({rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]});
      }
    }
  }

  /// No cell is folded, in space or in the parameter plane.
  bool is_good() {
    double area = 0;
    const auto cross = [&](int a, int b, int c) {
      const Vector2 p = grid_.uv[b] - grid_.uv[a], q = grid_.uv[c] - grid_.uv[a];
      return p.x() * q.y() - p.y() * q.x();
    };
    for (const auto& [a, b, c, d] : grid_.quads) {
      check_();
      area += cross(a, b, c) + cross(a, c, d);
    }
    for (auto& quad : grid_.quads) {
      check_();
      if (area < 0) std::swap(quad[1], quad[3]);  // a wire that runs the wrong way round
      const auto& [a, b, c, d] = quad;
      const auto& p = grid_.points;
      if (quad_scaled_jacobian(p[a], p[b], p[c], p[d]) < least_jacobian) return false;
      if (!(cross(a, b, d) > 0) || !(cross(c, d, b) > 0)) return false;
    }
    return true;
  }

  /// Whether nearly all inner sides are of about the size wanted, or of that of the boundary where this has
  /// more nodes than wanted, as round a thin tube.
  bool follows_sizes() {
    const auto length = [&](int a, int b) { return (grid_.points[b] - grid_.points[a]).norm(); };
    double shortest = std::numeric_limits<double>::infinity();
    for (const Line& loop : loops_) {
      for (std::size_t i = 0; i < loop.size(); ++i)
        shortest = std::min(shortest, length(loop[i], loop[(i + 1) % loop.size()]));
    }
    int inner = 0, off = 0;
    for (const auto& quad : grid_.quads) {
      check_();
      for (int k = 0; k < 4; ++k) {
        const int a = quad[k], b = quad[(k + 1) % 4];
        if (a < boundary_count_ || b < boundary_count_ || a > b) continue;
        const double wanted = size_at_(0.5 * (grid_.points[a] + grid_.points[b]));
        ++inner;
        off += length(a, b) < 0.5 * std::min(wanted, shortest) || length(a, b) > 1.6 * wanted;
      }
    }
    return 10 * off <= inner;
  }

  const FaceBoundary& boundary_;
  const FaceSides& sides_;
  const FaceSurface& surface_;
  SizingField::Sampler& size_at_;
  SparseCheck check_;
  FaceGrid grid_;
  std::vector<Line> loops_;
  int end_ = -1;
  int boundary_count_ = 0;
};

}  // namespace

std::optional<FaceGrid> make_grid(const FaceBoundary& boundary, const FaceSides& sides,
                                  const FaceSurface& surface, SizingField::Sampler& size_at,
                                  const ExecutionContext& context) {
  return GridMaker(boundary, sides, surface, size_at, context).run();
}

}  // namespace quadrille
