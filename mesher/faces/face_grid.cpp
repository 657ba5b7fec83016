/// Based on: Gordon & Hall, Construction of curvilinear co-ordinate systems and applications to mesh
/// generation (1973), with shares of arc length as coordinates.

#include "mesher/faces/face_grid.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/base/whole_number.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

using Line = std::vector<int>;  // consecutive points

constexpr double least_jacobian = 0.3;  // scaled Jacobian of a cell

Line turned(Line line) {
  std::reverse(line.begin(), line.end());
  return line;
}

/// The boundary of a face: a grid that has no quads yet, and the points of each loop.
struct Outline {
  FaceGrid grid;
  std::vector<Line> loops;
};

/// The boundary's points and the middles of its segments, without quads, and its loops in the order of the
/// wires; nothing if the segments do not make closed loops.
std::optional<Outline> find_outline(const FaceBoundary& boundary) {
  Outline result{{boundary.uv, boundary.points, boundary.nodes, {}}, {}};
  auto& [grid, loops] = result;
  int end = -1;
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate || segment.internal) return std::nullopt;
    if (loops.empty() || segment.a != end) {
      if (!loops.empty() && loops.back().front() != end) return std::nullopt;
      loops.emplace_back();
    }
    loops.back().push_back(segment.a);
    end = segment.b;
    if (segment.middle_node < 0) continue;
    loops.back().push_back(static_cast<int>(grid.uv.size()));
    grid.uv.push_back(segment.middle_uv);
    grid.points.push_back(segment.middle_point);
    grid.nodes.push_back(segment.middle_node);
  }
  if (loops.empty() || loops.back().front() != end) return std::nullopt;
  std::size_t count = 0;
  for (const Line& loop : loops) count += loop.size();
  if (count != grid.nodes.size()) return std::nullopt;
  return result;
}

/// The sides of the outer loop, from corner to corner.
std::vector<Line> cut_loop(const FaceBoundary& boundary, const FaceSides& sides, const Line& loop) {
  const int n = static_cast<int>(loop.size());
  std::vector<Line> lines;
  std::vector<int> corners;
  for (const int start : sides.starts) {
    const int segment = boundary.first_segments[sides.outer][start];
    const auto it = std::find(loop.begin(), loop.end(), segment < 0 ? -1 : boundary.segments[segment].a);
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

/// The points around a block, counter-clockwise in cells.
Line outline_of(const std::vector<Line>& rows, const HoleBlock& block) {
  const int left = block.column, right = left + block.columns, low = block.row, high = low + block.rows;
  Line line;
  for (int i = left; i < right; ++i) line.push_back(rows[low][i]);
  for (int j = low; j < high; ++j) line.push_back(rows[j][right]);
  for (int i = right; i > left; --i) line.push_back(rows[high][i]);
  for (int j = high; j > low; --j) line.push_back(rows[j][left]);
  return line;
}

double cross(const FaceGrid& grid, int a, int b, int c) {
  const Vector2 p = grid.uv[b] - grid.uv[a], q = grid.uv[c] - grid.uv[a];
  return p.x() * q.y() - p.y() * q.x();
}

/// Twice the area that a closed line encloses in the parameter plane.
double area_of(const FaceGrid& grid, const Line& line) {
  double area = 0;
  for (std::size_t k = 1; k + 1 < line.size(); ++k) area += cross(grid, line[0], line[k], line[k + 1]);
  return area;
}

/// Removes the points inside that no quad uses.
void drop_unused(FaceGrid& grid) {
  std::vector<int> number(grid.uv.size(), -1);
  for (const auto& quad : grid.quads) {
    for (const int point : quad) number[point] = 0;
  }
  int kept = 0;
  for (int i = 0; i < static_cast<int>(number.size()); ++i) {
    if (i >= std::ssize(grid.nodes) && number[i] < 0) continue;
    grid.uv[kept] = grid.uv[i];
    grid.points[kept] = grid.points[i];
    number[i] = kept++;
  }
  grid.uv.resize(kept);
  grid.points.resize(kept);
  for (auto& quad : grid.quads) quad = with_numbers(quad, number);
}

/// Makes the quads counter-clockwise: a wire may run the wrong way around.
void turn_to_left(FaceGrid& grid, SparseCheck& check) {
  double area = 0;
  for (const auto& [a, b, c, d] : grid.quads) {
    check();
    area += cross(grid, a, b, c) + cross(grid, a, c, d);
  }
  if (area >= 0) return;
  for (auto& quad : grid.quads) std::swap(quad[1], quad[3]);
}

/// Whether all cells have a good shape in space and none is folded in the parameter plane.
bool is_good(const FaceGrid& grid, SparseCheck& check) {
  for (const auto& quad : grid.quads) {
    check();
    const auto& [a, b, c, d] = quad;
    if (quad_scaled_jacobian(grid.points, quad) < least_jacobian) return false;
    if (!(cross(grid, a, b, d) > 0) || !(cross(grid, c, d, b) > 0)) return false;
  }
  return true;
}

/// Whether at least nine tenths of the inner sides have about the wanted size. They may be as short as on
/// the boundary if that has more nodes than wanted, as around a thin tube.
bool follows_sizes(const FaceGrid& grid, const std::vector<Line>& loops, SizingField::Sampler& size_at,
                   SparseCheck& check) {
  const int boundary_count = static_cast<int>(grid.nodes.size());
  const auto length = [&](int a, int b) { return (grid.points[b] - grid.points[a]).norm(); };
  double shortest = std::numeric_limits<double>::infinity();
  for (const Line& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      shortest = std::min(shortest, length(loop[i], loop[(i + 1) % loop.size()]));
  }
  int inner = 0, off = 0;
  for (const auto& quad : grid.quads) {
    check();
    for (int k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      if (a < boundary_count || b < boundary_count || a > b) continue;
      const double wanted = size_at(0.5 * (grid.points[a] + grid.points[b]));
      ++inner;
      off += length(a, b) < 0.5 * std::min(wanted, shortest) || length(a, b) > 1.6 * wanted;
    }
  }
  return 10 * off <= inner;
}

/// Adds points and quads inside a boundary.
class GridMaker {
 public:
  /// \param outline the boundary's points
  GridMaker(FaceGrid outline, const FaceSurface& surface, SizingField::Sampler& size_at, SparseCheck& check)
      : grid_(std::move(outline)), surface_(surface), size_at_(size_at), check_(check) {}

  FaceGrid grid() && { return std::move(grid_); }

  /// Makes rows between two loops, rotated so that the distances between their nodes are smallest.
  bool make_ring(const Line& outer, Line inner) {
    if (outer.size() != inner.size()) return false;
    std::rotate(inner.begin(), inner.begin() + nearest_shift(outer, inner).first, inner.end());
    const std::size_t middle = outer.size() / 2;
    add_rings(outer, inner, rows_between(outer[middle], inner[middle]));
    return true;
  }

  /// Makes a grid between four sides, in which each hole replaces a block of cells, with rings of quads
  /// between hole and block.
  bool make_four(const std::vector<Line>& sides, const std::vector<Line>& loops, int outer,
                 const std::vector<HoleBlock>& blocks) {
    if (sides.size() != 4 || sides[0].size() != sides[2].size() || sides[1].size() != sides[3].size())
      return false;
    const std::vector<Line> rows = rows_inside(sides[0], sides[1], turned(sides[2]), turned(sides[3]));
    const int columns = static_cast<int>(sides[0].size()) - 1,
              row_count = static_cast<int>(sides[1].size()) - 1;
    std::vector<char> covered(static_cast<std::size_t>(columns) * row_count, 0);
    auto block = blocks.begin();
    for (std::size_t i = 0; i < loops.size(); ++i) {
      if (static_cast<int>(i) == outer) continue;
      if (block->around() != static_cast<int>(loops[i].size())) return false;
      for (int j = block->row; j < block->row + block->rows; ++j)
        std::fill_n(covered.begin() + static_cast<long>(j) * columns + block->column, block->columns, 1);
      join_hole(outline_of(rows, *block++), loops[i]);
    }
    for (int j = 0; j < row_count; ++j) {
      for (int i = 0; i < columns; ++i) {
        if (!covered[static_cast<std::size_t>(j) * columns + i]) add_cell(rows, i, j);
      }
    }
    return true;
  }

 private:
  /// The places of rows between two points by the sizing field, as shares of the line in the parameter plane.
  std::vector<double> rows_between(int from, int to) {
    constexpr int steps_on_line = 32;
    std::vector<double> counts{0};
    Vector3 before = grid_.points[from];
    for (int i = 1; i <= steps_on_line; ++i) {
      const double t = static_cast<double>(i) / steps_on_line;
      const Vector3 here = surface_.point((1 - t) * grid_.uv[from] + t * grid_.uv[to]);
      counts.push_back(counts.back() + (here - before).norm() / size_at_(0.5 * (here + before)));
      before = here;
    }
    const int rows = std::max(1, round_to_int(counts.back()));
    std::vector<double> shares{0};
    for (int k = 1; k < rows; ++k) {
      const auto [cell, part] = place_in(counts, counts.back() * k / rows);
      shares.push_back((static_cast<double>(cell) + part) / steps_on_line);
    }
    shares.push_back(1);
    return shares;
  }

  int add_point(const Vector2& uv) {
    check_();
    grid_.uv.push_back(uv);
    grid_.points.push_back(surface_.point(uv));
    return static_cast<int>(grid_.uv.size()) - 1;
  }

  std::vector<double> shares_of(const Line& line) const {
    std::vector<Vector3> places;
    for (const int point : line) places.push_back(grid_.points[point]);
    return shares_along(places);
  }

  void add_cell(const std::vector<Line>& rows, std::size_t i, std::size_t j) {
    check_();
    grid_.quads.push_back({rows[j][i], rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]});
  }

  /// The points of a grid between four lines, row by row, including the lines, which run in the direction of
  /// growing columns or rows.
  std::vector<Line> rows_inside(const Line& bottom, const Line& right, const Line& top, const Line& left) {
    const std::size_t m = bottom.size() - 1, n = left.size() - 1;
    const std::vector<double> b = shares_of(bottom), t = shares_of(top), l = shares_of(left),
                              r = shares_of(right);
    const auto& uv = grid_.uv;
    std::vector<Line> rows{bottom};
    for (std::size_t j = 1; j < n; ++j) {
      Line& row = rows.emplace_back();
      row.push_back(left[j]);
      for (std::size_t i = 1; i < m; ++i) {
        // The crossing of the lines between opposite shares.
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
    return rows;
  }

  /// Makes rings of quads between the outline of a block and a hole with the same number of nodes.
  void join_hole(const Line& outline, Line hole) {
    const std::size_t n = hole.size();
    if (area_of(grid_, hole) * area_of(grid_, outline) < 0) hole = turned(hole);
    const auto [shift, way] = nearest_shift(outline, hole);
    std::rotate(hole.begin(), hole.begin() + shift, hole.end());
    double length = 0;
    for (std::size_t k = 0; k < n; ++k) {
      length += 0.5 * (grid_.points[outline[(k + 1) % n]] - grid_.points[outline[k]]).norm() +
                0.5 * (grid_.points[hole[(k + 1) % n]] - grid_.points[hole[k]]).norm();
    }
    const int rings = std::max(1, round_to_int(way / length));
    grid_.rings = grid_.rings == 0 ? rings : std::min(grid_.rings, rings);
    std::vector<double> shares;
    for (int ring = 0; ring <= rings; ++ring) shares.push_back(static_cast<double>(ring) / rings);
    add_rings(outline, hole, shares);
  }

  /// Adds points and rings of quads between two closed lines, with lines at shares of the way from 0 to 1.
  void add_rings(const Line& outer, const Line& inner, const std::vector<double>& shares) {
    Line line = outer;
    for (std::size_t k = 1; k < shares.size(); ++k) {
      const Line before = std::exchange(line, inner);
      for (std::size_t i = 0; i < line.size() && k + 1 < shares.size(); ++i)
        line[i] = add_point((1 - shares[k]) * grid_.uv[outer[i]] + shares[k] * grid_.uv[inner[i]]);
      for (std::size_t i = 0; i < line.size(); ++i) {
        const std::size_t next = (i + 1) % line.size();
        grid_.quads.push_back({before[i], before[next], line[next], line[i]});
      }
    }
  }

  /// The number of places by which to rotate a closed line so that its points are nearest to those of another
  /// one, and the approximate sum of the distances then.
  std::pair<int, double> nearest_shift(const Line& outer, const Line& inner) {
    const int n = static_cast<int>(outer.size()), step = std::max(1, n / 32);
    int best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (int shift = 0; shift < n; ++shift) {
      check_();
      double sum = 0;
      for (int i = 0; i < n; i += step)
        sum += (grid_.points[outer[i]] - grid_.points[inner[(i + shift) % n]]).norm() * step;
      if (sum < shortest) {
        shortest = sum;
        best = shift;
      }
    }
    return {best, shortest};
  }

  FaceGrid grid_;
  const FaceSurface& surface_;
  SizingField::Sampler& size_at_;
  SparseCheck& check_;
};

}  // namespace

std::optional<FaceGrid> make_grid(const FaceBoundary& boundary, const FacePlan& plan,
                                  const FaceSurface& surface, SizingField::Sampler& size_at,
                                  const ExecutionContext& context) {
  const GridKind kind = plan.sides.kind;
  std::optional<Outline> outline = kind == GridKind::other ? std::nullopt : find_outline(boundary);
  if (!outline) return std::nullopt;
  const auto& loops = outline->loops;
  const int outer = plan.sides.outer;
  SparseCheck check(context);
  GridMaker maker(std::move(outline->grid), surface, size_at, check);
  bool is_made = false;
  if (kind == GridKind::ring) {
    is_made = loops.size() == 2 && maker.make_ring(loops[0], turned(loops[1]));
  } else {
    is_made = loops.size() == boundary.first_segments.size() && loops.size() == plan.hole_blocks.size() + 1 &&
              maker.make_four(cut_loop(boundary, plan.sides, loops[outer]), loops, outer, plan.hole_blocks);
  }
  if (!is_made) return std::nullopt;
  FaceGrid grid = std::move(maker).grid();
  const bool has_holes = kind == GridKind::holed;
  if (has_holes) drop_unused(grid);
  turn_to_left(grid, check);
  // With holes, the shape can be judged only after nodes have been moved.
  if (!has_holes && !is_good(grid, check)) return std::nullopt;
  if (!follows_sizes(grid, loops, size_at, check)) return std::nullopt;
  return grid;
}

}  // namespace quadrille
