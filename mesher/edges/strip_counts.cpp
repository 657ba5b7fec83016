/// Raises the counts along four-sided faces whose cells would be more than four times as long as wide.

#include "mesher/edges/strip_counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/base/vector.hpp"
#include "geometry/base/whole_number.hpp"

namespace quadrille {

namespace {

/// Quads in the narrowest row may exceed the aspect by this factor, which is 4.9 in place of 4; the quality
/// limit is 5.
constexpr double in_narrowest = 1.22;

/// How wide the rows are that end on two facing sides, or on parts of these.
struct RowWidths {
  double length = 0;  ///< of a side, on average
  int rows = 0;
  double narrowest = std::numeric_limits<double>::infinity();
  bool divided = false;  ///< by users

  double mean() const { return length / rows; }
  /// Rows far narrower than others, as at the leading edge of a wing, do not make all quads so short.
  double least() const { return std::clamp(narrowest, 0.5 * mean(), mean()); }
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

/// \param along the sides from end to end, cut into pairs
StripRefiner::Waist StripRefiner::waist_between(std::span<const FacingPair> along) const {
  std::array<std::vector<Vector3>, 2> sides;
  for (const FacingPair& pair : along)
    for (const FaceSide* side : {&pair.first, &pair.second})
      for (const SideEdge& edge : *side) {
        const int steps = std::max(1, steps_of_edge / static_cast<int>(along.size() * side->size()));
        const std::vector<Vector3> points = points_along(shape_.edges[edge.edge], steps, edge.forward);
        std::vector<Vector3>& all = sides[side == &pair.first ? 0 : 1];
        all.insert(all.end(), points.begin(), points.end());
      }
  const auto& [a, b] = sides;
  const double at_start = (a.front() - b.front()).norm(), at_end = (a.back() - b.back()).norm();
  Waist result;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(a.size() - 1);
    const double straight = (1 - share) * at_start + share * at_end;
    const double ratio = straight > 0 ? std::min(straight, distance_to_line(a[i], b)) / straight : 1;
    result.narrowest = std::min(result.narrowest, ratio);
    sum += ratio;
  }
  result.mean = sum / static_cast<double>(a.size());
  return result;
}

bool StripRefiner::refine(const FaceOutlines& sides, const EdgeCounts& chosen, const PlannedSpacing& spacing,
                          IdVector<EdgeId, CountTable>& tables, CountTargets& targets) {
  // (chords) wanted and least segments for each whole edge
  IdVector<EdgeId, double> wanted(shape_.edges.size()), least(shape_.edges.size());
  const auto widths = [&](std::span<const FacingPair> pairs) {
    RowWidths result;
    for (const FacingPair& pair : pairs) {
      for (const SideEdge& edge : pair.edges()) {
        const double length = shape_.edges[edge.edge].length;
        result.length += 0.5 * length;
        const EdgeId chord = chosen.chords.of(edge.edge);
        result.divided |= spacing.divided[chord] || spacing.kept[chord];
        result.narrowest = std::min(
            result.narrowest,
            shortest_segment(length, spacing.shares[edge.edge], tables[edge.edge], chosen.counts[edge.edge]));
      }
      result.rows += sum_over(pair.first, chosen.counts);
    }
    return result;
  };
  for (const FaceId id : sides.ids()) {
    const FaceSides& face = sides[id];
    if (!face.has_four_sides()) continue;
    const std::span all(face.facing);
    const std::array ways{all.first(face.across), all.subspan(face.across)};
    for (const int k : {0, 1}) {
      RowWidths across = widths(ways[1 - k]);
      if (across.rows == 0 || across.divided) continue;
      auto& waist = waists_[id][k];
      if (!waist) waist = waist_between(ways[k]);
      across.narrowest *= waist->narrowest;
      across.length *= waist->mean;
      for (const FacingPair& pair : ways[k])
        for (const SideEdge& edge : pair.edges()) {
          const double shortest = shortest_[edge.edge];
          if (in_narrowest * aspect_ * across.mean() < shortest) continue;  // out of reach
          const EdgeId chord = chosen.chords.of(edge.edge);
          const double length = shape_.edges[edge.edge].length;
          wanted[chord] = std::max(wanted[chord], length / std::max(aspect_ * across.mean(), shortest));
          least[chord] = std::max(
              least[chord], std::ceil(length / std::max(in_narrowest * aspect_ * across.least(), shortest)));
        }
    }
  }
  bool any = false;
  for (const EdgeId i : tables.ids()) {
    const EdgeId chord = chosen.chords.of(i);
    if (targets.least[i] == 0 || wanted[chord] <= 0) continue;
    const double before = tables[i].total();
    const int segments = to_int(least[chord]), before_least = targets.least_of_grids[i];
    tables[i].raise_to(std::max(wanted[chord], least[chord]) / tables[i].length());
    targets.least_of_grids[i] = std::max(before_least, segments);
    targets.least[i] = std::max(targets.least[i], (segments + targets.stride - 1) / targets.stride);
    constexpr double noticeable = 1.02;
    if (tables[i].total() <= noticeable * before && targets.least_of_grids[i] == before_least) continue;
    targets.wanted[i] = std::max(targets.wanted[i], tables[i].total() / targets.stride);
    any = true;
  }
  return any;
}

}  // namespace quadrille
