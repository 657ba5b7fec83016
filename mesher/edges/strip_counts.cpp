/// Raises the counts along four-sided faces whose cells would be more than four times as long as wide.

#include "mesher/edges/strip_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/base/whole_number.hpp"

namespace quadrille {

namespace {

/// What the aspect of quads in the narrowest row may be beside that in a row of mean width.
constexpr double in_narrowest = 1.19;
constexpr double least_of_mean = 0.5;
/// What rounding of counts may make of the aspect.
constexpr double by_rounding = 1.22;

/// How wide the rows are that end on two facing sides, or on parts of these.
struct RowWidths {
  double length = 0;  ///< of a side, on average
  int rows = 0;
  double narrowest = std::numeric_limits<double>::infinity();
  bool divided = false;  ///< by users

  /// Rows far narrower than others, as at the leading edge of a wing, do not make all quads so short.
  double width() const {
    const double mean = length / rows;
    return std::clamp(in_narrowest * narrowest, least_of_mean * mean, mean);
  }
};

double shortest_segment(double length, const std::vector<double>& shares, const CountTable& table,
                        int count) {
  double shortest = std::numeric_limits<double>::infinity(), before = 0;
  for (int k = 1; k <= count; ++k) {
    const double at = shares.empty() ? table.length_at(table.total() * k / count) : length * shares[k];
    shortest = std::min(shortest, at - before);
    before = at;
  }
  return shortest;
}

}  // namespace

bool refine_along_strips(const CadShape& shape, const FaceOutlines& sides, const EdgeCounts& chosen,
                         const BoundaryNodes& nodes, const EdgeShares& shares, double aspect, double shortest,
                         IdVector<EdgeId, CountTable>& tables, CountTargets& targets) {
  IdVector<EdgeId, double> densities(shape.edges.size());  // (chords) least segments for each whole edge
  const auto widths = [&](std::span<const FacingPair> pairs) {
    RowWidths result;
    for (const FacingPair& pair : pairs) {
      for (const FaceSide* side : {&pair.first, &pair.second})
        for (const SideEdge& edge : *side) {
          const double length = shape.edges[edge.edge].length;
          result.length += 0.5 * length;
          result.divided |= nodes.edges[edge.edge].divided || nodes.edges[edge.edge].kept;
          result.narrowest = std::min(
              result.narrowest,
              shortest_segment(length, shares[edge.edge], tables[edge.edge], chosen.counts[edge.edge]));
        }
      for (const SideEdge& edge : pair.first) result.rows += chosen.counts[edge.edge];
    }
    return result;
  };
  for (const FaceSides& face : sides) {
    if (!face.has_four_sides()) continue;
    const std::span all(face.facing);
    const std::array ways{all.first(face.across), all.subspan(face.across)};
    for (const int k : {0, 1}) {
      const RowWidths across = widths(ways[1 - k]);
      if (across.rows == 0 || across.divided) continue;
      const double longest = std::max(aspect * across.width(), shortest);
      for (const FacingPair& pair : ways[k])
        for (const FaceSide* side : {&pair.first, &pair.second})
          for (const SideEdge& edge : *side) {
            double& of_chord = densities[chosen.chords.of(edge.edge)];
            of_chord = std::max(of_chord, shape.edges[edge.edge].length / longest);
          }
    }
  }
  bool any = false;
  for (const EdgeId i : tables.ids()) {
    const double density = densities[chosen.chords.of(i)];
    if (targets.least[i] == 0 || density <= 0) continue;
    const double before = tables[i].total();
    tables[i].raise_to(density / tables[i].length());
    const int least = targets.least_of_grids[i];
    targets.least_of_grids[i] = std::max(least, to_int(std::ceil(density / by_rounding)));
    targets.least[i] = std::max(targets.least[i], to_int(std::ceil(density / by_rounding / targets.stride)));
    constexpr double noticeable = 1.02;
    if (tables[i].total() <= noticeable * before && targets.least_of_grids[i] == least) continue;
    targets.wanted[i] = std::max(targets.wanted[i], tables[i].total() / targets.stride);
    any = true;
  }
  return any;
}

}  // namespace quadrille
