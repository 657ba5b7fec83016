#include "mesher/edges/hole_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Cells beside a hole, both sides together: what is wanted, and what may be.
constexpr double wanted_beside = 1, least_beside = 0.2, most_beside = 3;
/// Holes that take more cells across bend the grid too much.
constexpr double largest_hole = 8;
/// Segments at a hole over those of the sides, by the sizing field: beyond, sizes change too much.
constexpr double least_ratio = 0.8, largest_ratio = 1.5;

/// How far a block of so many cells would have its middle from that of the hole.
double off_center(double low, double high, int cells) {
  const double start = 0.5 * (low + high) - 0.5 * cells;
  return std::abs(start - std::round(start));
}

bool has_room(double extent, int cells) {
  return cells >= extent + least_beside && cells <= extent + most_beside;
}

/// Cells across the hole in one direction.
int cells_across(double low, double high) {
  const double wanted = high - low + wanted_beside;
  const int few = static_cast<int>(std::floor(wanted)), many = few + 1;
  const auto cost = [&](int cells) {
    return std::abs(cells - wanted) + off_center(low, high, cells) + (has_room(high - low, cells) ? 0 : 10);
  };
  return cost(few) < cost(many) ? few : many;
}

class HoleFitter {
 public:
  HoleFitter(const CadShape& shape, const EdgeCounts& chosen, const std::vector<CountTable>& tables)
      : shape_(shape), chosen_(chosen), tables_(tables) {}

  /// Segments round each hole (of the final mesh), by wire, 0 for the outer one; empty where the face is to
  /// be left alone.
  std::vector<int> counts(const CadFace& face, const FaceSides& sides) const {
    const int columns = count_of(sides, 0), rows = count_of(sides, 1);
    if (columns < 3 || rows < 3 || sides.starts.size() != 4) return {};
    const Vector2 scale = FaceSurface(face).mean_scale();
    std::array<Vector2, 4> corners;
    const auto& outline = face.wires[sides.outer].coedges;
    double length = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Coedge& start = outline[sides.starts[k]];
      const CadEdge& edge = shape_.edges[start.edge - 1];
      corners[k] = parametric_point(start, start.forward ? edge.first : edge.last).cwiseProduct(scale);
    }
    for (const Coedge& coedge : outline) length += shape_.edges[coedge.edge - 1].length;
    const double side = length / (2 * (columns + rows));
    const Vector2 along = 0.5 * (corners[1] - corners[0] + corners[2] - corners[3]),
                  up = 0.5 * (corners[3] - corners[0] + corners[2] - corners[1]);
    const double area = along.x() * up.y() - along.y() * up.x();
    if (!(std::abs(area) > 0)) return {};
    std::vector<int> result;
    std::vector<HoleBlock> blocks;
    for (std::size_t wire = 0; wire < face.wires.size(); ++wire) {
      result.push_back(0);
      if (static_cast<int>(wire) == sides.outer) continue;
      if (!has_size_of(face.wires[wire], side)) return {};
      HolePlace place{Vector2::Constant(std::numeric_limits<double>::infinity()),
                      Vector2::Constant(-std::numeric_limits<double>::infinity())};
      for (const Vector2& uv : points_along(face.wires[wire])) {
        const Vector2 p = uv.cwiseProduct(scale) - corners[0];
        const Vector2 cell(columns * (p.x() * up.y() - p.y() * up.x()) / area,
                           rows * (along.x() * p.y() - along.y() * p.x()) / area);
        place.low = place.low.cwiseMin(cell);
        place.high = place.high.cwiseMax(cell);
      }
      const auto block = block_of(place, 0);
      if (!block) return {};
      blocks.push_back(*block);
      result.back() = block->around();
    }
    if (!keep_apart(blocks, columns, rows)) return {};
    return result;
  }

 private:
  /// Segments along facing sides: 0 and 2, or 1 and 3.
  int count_of(const FaceSides& sides, std::size_t which) const {
    // Pairs of the first two sides come first.
    if (sides.facing.size() != 2) return 0;
    int sum = 0;
    for (const SideEdge& edge : sides.facing[which].first) sum += chosen_.counts[edge.edge];
    return sum;
  }

  bool has_size_of(const CadWire& wire, double side) const {
    double length = 0, segments = 0;
    for (const Coedge& coedge : wire.coedges) {
      length += shape_.edges[coedge.edge - 1].length;
      segments += tables_[coedge.edge - 1].total();
    }
    const double ratio = length / std::max(segments, 1.0) / side;
    return ratio > least_ratio && ratio < largest_ratio;
  }

  std::vector<Vector2> points_along(const CadWire& wire) const {
    constexpr int samples = 32;
    std::vector<Vector2> points;
    for (const Coedge& coedge : wire.coedges) {
      const CadEdge& edge = shape_.edges[coedge.edge - 1];
      for (int i = 0; i <= samples; ++i)
        points.push_back(parametric_point(coedge, edge.first + (edge.last - edge.first) * i / samples));
    }
    return points;
  }

  const CadShape& shape_;
  const EdgeCounts& chosen_;
  const std::vector<CountTable>& tables_;
};

}  // namespace

std::optional<HoleBlock> block_of(const HolePlace& hole, int nodes) {
  const Vector2 extent = hole.high - hole.low;
  if (nodes % 2 != 0 || !(extent.maxCoeff() < largest_hole)) return std::nullopt;
  HoleBlock block;
  block.columns = cells_across(hole.low.x(), hole.high.x());
  block.rows = cells_across(hole.low.y(), hole.high.y());
  if (nodes > 0) {
    // As much too many or too few each way.
    const int excess = nodes / 2 - block.columns - block.rows;
    block.columns += excess / 2;
    block.rows = nodes / 2 - block.columns;
  }
  if (!has_room(extent.x(), block.columns) || !has_room(extent.y(), block.rows)) return std::nullopt;
  block.column = static_cast<int>(std::lround(0.5 * (hole.low.x() + hole.high.x() - block.columns)));
  block.row = static_cast<int>(std::lround(0.5 * (hole.low.y() + hole.high.y() - block.rows)));
  return block;
}

bool keep_apart(const std::vector<HoleBlock>& blocks, int columns, int rows) {
  const auto apart = [](int a, int a_count, int b, int b_count) {
    return a + a_count < b || b + b_count < a;
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const HoleBlock& one = blocks[i];
    if (one.column < 1 || one.row < 1 || one.column + one.columns >= columns || one.row + one.rows >= rows)
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

bool fit_holes_to_grids(const CadShape& shape, const std::vector<FaceSides>& sides, const EdgeCounts& chosen,
                        const std::vector<CountTable>& tables, CountWishes& wishes) {
  const HoleFitter fitter(shape, chosen, tables);
  bool any = false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i].outline != FaceSides::Outline::holed) continue;
    const CadFace& face = shape.faces[i];
    const std::vector<int> counts = fitter.counts(face, sides[i]);
    for (std::size_t wire = 0; wire < counts.size(); ++wire) {
      if (counts[wire] == 0) continue;
      double length = 0;
      for (const Coedge& coedge : face.wires[wire].coedges) length += shape.edges[coedge.edge - 1].length;
      for (const Coedge& coedge : face.wires[wire].coedges) {
        const int edge = coedge.edge - 1;
        const double share = shape.edges[edge].length / length;
        double& wanted = wishes.wanted[edge];
        any |= std::abs(wanted * wishes.stride - share * counts[wire]) > 0.5;
        wanted = share * counts[wire] / wishes.stride;
      }
    }
  }
  return any;
}

}  // namespace quadrille
