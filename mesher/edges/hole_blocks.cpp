/// Chooses the counts that fit a hole's cells to its place among the rows, by cost.

#include "mesher/edges/hole_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/base/whole_number.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

namespace {

/// Cells beside a hole, both sides together: wanted number, and its limits.
constexpr double wanted_beside = 1, least_beside = 0.2, most_beside = 3;
/// Holes at least this many cells across bend the grid too much.
constexpr double largest_hole = 8;
/// Limits of the segment length at a hole over that on the sides. Beyond them, sizes change too much.
constexpr double least_hole_ratio = 0.8, largest_hole_ratio = 1.5;

bool has_room(double extent, int cells) {
  return cells >= extent + least_beside && cells <= extent + most_beside;
}

/// Cells across a block in one direction, and the cost of that number: infinite for holes that are too large.
struct Across {
  int cells = 0;
  double cost = 0;
};

Across across(double low, double high, bool even) {
  constexpr double off_the_vertex = 0.8, no_room = 10;
  if (!(high - low < largest_hole)) return {0, std::numeric_limits<double>::infinity()};
  const double wanted = high - low + wanted_beside;
  Across best{0, std::numeric_limits<double>::infinity()};
  for (int cells = to_int(std::floor(wanted)) - 1; cells <= wanted + 2; ++cells) {
    const double start = 0.5 * (low + high) - 0.5 * cells, off_center = std::abs(start - std::round(start));
    const double cost = std::abs(cells - wanted) + off_center +
                        (even && cells % 2 != 0 ? off_the_vertex : 0) +
                        (has_room(high - low, cells) ? 0 : no_room);
    if (cost < best.cost - 1e-6) best = {cells, cost};
  }
  return best;
}

/// The first cell of a block centered on the hole. Of two equally good cells, the one that moves the block
/// towards the center of the grid, so that mirrored holes have mirrored blocks.
int start_of(double low, double high, int cells, int of) {
  const double middle = 0.5 * (low + high), bias = middle < 0.5 * of ? 1e-3 : -1e-3;
  return round_to_int(middle - 0.5 * cells + bias);
}

class HoleFitter {
 public:
  HoleFitter(const CadShape& shape, const EdgeCounts& chosen, const IdVector<EdgeId, CountTable>& tables,
             CountTargets& targets)
      : shape_(shape), chosen_(chosen), tables_(tables), targets_(targets) {}

  /// \return whether the wanted counts of the face's edges changed
  bool fit(const CadFace& face, const FaceSides& sides) {
    const GridSize now{count_of(sides, 0), count_of(sides, 1)};
    if (now.columns < 3 || now.rows < 3 || sides.starts.size() != 4) return false;
    std::vector<const CadWire*> holes;
    for (const CadWire& wire : face.wires) holes.push_back(&wire);
    holes.erase(holes.begin() + sides.outer);
    const double side = length_of(shape_, face.wires[sides.outer]) / (2 * (now.columns + now.rows));
    if (!std::ranges::all_of(holes, [&](const CadWire* hole) { return has_size_of(*hole, side); }))
      return false;
    std::vector<HolePlace> shares;
    for (const HoleShares& hole : shares_of_holes(shape_, face, sides))
      shares.push_back(place_of(hole, [](const Vector2& share) { return share; }));
    if (shares.empty()) return false;
    const GridSize grid{best_count(shares, 0, now.columns), best_count(shares, 1, now.rows)};
    std::vector<HoleBlock> blocks;
    for (const HolePlace& share : shares) {
      const Vector2 scale(grid.columns, grid.rows);
      const Eigen::AlignedBox2d box(share.box.min().cwiseProduct(scale), share.box.max().cwiseProduct(scale));
      const auto block = block_of({box, share.even}, 0, grid);
      if (!block) return false;
      blocks.push_back(*block);
    }
    if (!keep_apart(blocks, grid)) return false;
    bool any = scale_counts(sides.facing[0], static_cast<double>(grid.columns) / now.columns);
    any |= scale_counts(sides.facing[1], static_cast<double>(grid.rows) / now.rows);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const double length = length_of(shape_, *holes[i]);
      for (const Coedge& coedge : holes[i]->coedges)
        any |= want(coedge.edge, shape_.edges[coedge.edge].length / length * blocks[i].around());
    }
    return any;
  }

 private:
  /// Segments along the facing sides 0 and 2 (`which` = 0) or 1 and 3 (1); 0 if sides are cut into parts.
  int count_of(const FaceSides& sides, std::size_t which) const {
    return sides.facing.size() == 2 ? sum_over(sides.facing[which].first, chosen_.counts) : 0;
  }

  /// The count near `now` that suits the holes best. \param axis 0 = columns, 1 = rows
  int best_count(const std::vector<HolePlace>& shares, int axis, int now) const {
    constexpr double of_change = 2;
    constexpr int fewest = 3, step = 2;  // an even step keeps the parity of the faces
    int best = now;
    double least = std::numeric_limits<double>::infinity();
    for (int count = now - step; count <= now + step; count += step) {
      if (count < fewest) continue;
      double cost = of_change * std::abs(std::log(static_cast<double>(count) / now));
      for (const HolePlace& share : shares) {
        cost += across(share.box.min()[axis] * count, share.box.max()[axis] * count, share.even).cost /
                static_cast<double>(shares.size());
      }
      if (cost >= least) continue;
      least = cost;
      best = count;
    }
    return best;
  }

  bool has_size_of(const CadWire& wire, double side) const {
    double segments = 0;
    for (const Coedge& coedge : wire.coedges) segments += tables_[coedge.edge].total();
    const double ratio = length_of(shape_, wire) / std::max(segments, 1.0) / side;
    return ratio > least_hole_ratio && ratio < largest_hole_ratio;
  }

  /// \return whether that is another number
  bool want(EdgeId edge, double segments) {
    double& wanted = targets_.wanted[edge];
    const bool changes = std::abs(wanted * targets_.stride - segments) > 0.5;
    wanted = segments / targets_.stride;
    return changes;
  }

  bool scale_counts(const FacingPair& pair, double factor) {
    bool any = false;
    for (const SideEdge& edge : pair.edges())
      any |= factor != 1 && want(edge.edge, factor * chosen_.counts[edge.edge]);
    return any;
  }

  const CadShape& shape_;
  const EdgeCounts& chosen_;
  const IdVector<EdgeId, CountTable>& tables_;
  CountTargets& targets_;
};

}  // namespace

std::vector<HoleShares> shares_of_holes(const CadShape& shape, const CadFace& face, const FaceSides& sides) {
  const Vector2 scale = FaceSurface(face).mean_scale();
  const auto place = [&](const Coedge& coedge, double share) -> Vector2 {
    const CadEdge& edge = shape.edges[coedge.edge];
    const double t = edge.first + (edge.last - edge.first) * (coedge.forward ? share : 1 - share);
    return parametric_point(coedge, t).cwiseProduct(scale);
  };
  std::array<Vector2, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = place(face.wires[sides.outer].coedges[sides.starts[k]], 0);
  const Vector2 along = 0.5 * (corners[1] - corners[0] + corners[2] - corners[3]),
                up = 0.5 * (corners[3] - corners[0] + corners[2] - corners[1]);
  const double area = along.x() * up.y() - along.y() * up.x();
  constexpr double least_sine = 0.1;  // below, the sides are not a frame to measure places in
  if (!(std::abs(area) > least_sine * along.norm() * up.norm())) return {};
  const auto share_of = [&](const Vector2& at) {
    const Vector2 p = at - corners[0];
    return Vector2((p.x() * up.y() - p.y() * up.x()) / area, (along.x() * p.y() - along.y() * p.x()) / area);
  };
  std::vector<HoleShares> result;
  for (std::size_t wire = 0; wire < face.wires.size(); ++wire) {
    if (static_cast<int>(wire) == sides.outer) continue;
    HoleShares& hole = result.emplace_back();
    for (const Coedge& coedge : face.wires[wire].coedges) {
      hole.vertices.push_back(share_of(place(coedge, 0)));
      for (int i = 0; i < steps_of_edge; ++i)
        hole.points.push_back(share_of(place(coedge, static_cast<double>(i) / steps_of_edge)));
    }
  }
  return result;
}

std::optional<HoleBlock> block_of(const HolePlace& hole, int nodes, const GridSize& grid) {
  const Vector2 &low = hole.box.min(), &high = hole.box.max();
  const Vector2 extent = hole.box.sizes(), middle = hole.box.center();
  const bool is_inside =
      middle.x() > 0 && middle.y() > 0 && middle.x() < grid.columns && middle.y() < grid.rows;
  if (nodes % 2 != 0 || !is_inside || !(extent.maxCoeff() < largest_hole)) return std::nullopt;
  HoleBlock block;
  block.columns = across(low.x(), high.x(), hole.even).cells;
  block.rows = across(low.y(), high.y(), hole.even).cells;
  if (nodes > 0) {
    // Spread the excess or shortage over both directions.
    const int excess = nodes / 2 - block.columns - block.rows;
    block.columns += excess / 2;
    block.rows = nodes / 2 - block.columns;
  }
  if (!has_room(extent.x(), block.columns) || !has_room(extent.y(), block.rows)) return std::nullopt;
  block.column = start_of(low.x(), high.x(), block.columns, grid.columns);
  block.row = start_of(low.y(), high.y(), block.rows, grid.rows);
  return block;
}

bool keep_apart(const std::vector<HoleBlock>& blocks, const GridSize& grid) {
  const auto apart = [](int a, int a_count, int b, int b_count) {
    return a + a_count < b || b + b_count < a;
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const HoleBlock& one = blocks[i];
    if (one.column < 1 || one.row < 1 || one.column + one.columns >= grid.columns ||
        one.row + one.rows >= grid.rows)
      return false;
    for (std::size_t k = 0; k < i; ++k) {
      const HoleBlock& other = blocks[k];
      if (!apart(one.column, one.columns, other.column, other.columns) &&
          !apart(one.row, one.rows, other.row, other.rows))
        return false;
    }
  }
  return true;
}

bool fit_holes_to_grids(const CadShape& shape, const FaceOutlines& sides, const EdgeCounts& chosen,
                        const IdVector<EdgeId, CountTable>& tables, CountTargets& targets) {
  HoleFitter fitter(shape, chosen, tables, targets);
  bool any = false;
  for (const FaceId face : sides.ids())
    any |= sides[face].has_holes() && fitter.fit(shape.faces[face], sides[face]);
  return any;
}

}  // namespace quadrille
