/// Raises the counts along four-sided faces whose cells would be more than four times as long as wide.

#include "mesher/edges/strip_counts.hpp"

#include <algorithm>

namespace quadrille {

namespace {

constexpr double wanted_aspect = 4;  // the quality limit is 5
constexpr double most = 3;           // largest factor on the number of segments

/// One direction of a four-sided face: mean length and count of the two sides along it.
struct Extent {
  double length = 0;
  int count = 0;
};

Extent extent_of(const CadShape& shape, const FacingPair& pair, const IdVector<EdgeId, int>& counts) {
  Extent extent;
  for (const FaceSide* side : {&pair.first, &pair.second}) {
    for (const SideEdge& edge : *side) extent.length += 0.5 * shape.edges[edge.edge].length;
  }
  for (const SideEdge& edge : pair.first) extent.count += counts[edge.edge];
  return extent;
}

}  // namespace

bool refine_along_strips(const CadShape& shape, const FaceOutlines& sides, const EdgeCounts& chosen,
                         IdVector<EdgeId, CountTable>& tables, CountTargets& targets) {
  IdVector<EdgeId, double> densities(shape.edges.size());  // (chords) least segments for each whole edge
  for (const FaceSides& face : sides) {
    if (!face.is_rectangle()) continue;
    for (const int k : {0, 1}) {
      const Extent along = extent_of(shape, face.facing[k], chosen.counts),
                   across = extent_of(shape, face.facing[1 - k], chosen.counts);
      if (along.count == 0 || across.count == 0 || !(across.length > 0)) continue;
      const double needed = along.length * across.count / (wanted_aspect * across.length);
      if (needed > most * along.count) continue;
      for (const FaceSide* side : {&face.facing[k].first, &face.facing[k].second}) {
        for (const SideEdge& edge : *side) {
          double& of_chord = densities[chosen.chords.of(edge.edge)];
          of_chord = std::max(of_chord, needed * shape.edges[edge.edge].length / along.length);
        }
      }
    }
  }
  bool any = false;
  for (const EdgeId i : tables.ids()) {
    const double density = densities[chosen.chords.of(i)];
    if (targets.least[i] == 0 || density <= 0) continue;
    const double before = tables[i].total();
    tables[i].raise_to(density / tables[i].length());
    constexpr double noticeable = 1.02;
    if (tables[i].total() <= noticeable * before) continue;
    targets.wanted[i] = std::max(targets.wanted[i], tables[i].total() / targets.stride);
    any = true;
  }
  return any;
}

}  // namespace quadrille
