/// One segment for short edges, where all faces stay even: a T-join over the chords that could have one.

#include "mesher/edges/edge_counts.hpp"

#include <map>

#include "mesher/edges/count_balance.hpp"

namespace quadrille {

namespace {

/// The largest number of segments by the sizing field to which one is nearer than two, by ratio.
constexpr double most_wanted = 1.42;

/// Chords that keep two segments so that the sums around all faces stay even.
/// \param is_single whether an edge would otherwise get one
template <class IsSingle>
EdgeFlags kept_for_parity(const CadShape& shape, const CountTargets& targets, const Chords& chords,
                          IsSingle&& is_single) {
  IdVector<EdgeId, ParityEdge> edges(targets.wanted.size());
  FaceFlags odd(shape.faces.size(), 0);
  for (const FaceId face : shape.faces.ids()) {
    std::map<EdgeId, int> uses;  // of chords by the face
    for (const EdgeId edge : shape.faces[face].edges())
      if (is_single(edge)) ++uses[chords.of(edge)];
    for (const auto& [id, count] : uses) {
      if (count % 2 == 0) continue;
      edges[id].faces.push_back(face);
      odd[face] ^= 1;
    }
  }
  for (const EdgeId edge : edges.ids())
    if (is_single(edge)) edges[chords.of(edge)].cost += 1;
  std::vector<FaceId> left;
  return make_even(edges, odd, left, targets.check);
}

}  // namespace

void choose_single_segments(const CadShape& shape, const CountTargets& targets, const FaceOutlines& sides,
                            EdgeCounts& chosen) {
  if (targets.stride != 2) return;
  EdgeFlags single(targets.wanted.size(), 0);  // (chords) 1 = gets one segment
  const auto chord = [&](EdgeId edge) { return chosen.chords.of(edge); };
  const auto is_single = [&](EdgeId edge) { return chosen.counts[edge] > 0 && single[chord(edge)] != 0; };
  for (const EdgeId edge : single.ids()) single[chord(edge)] |= chosen.counts[edge] == 2;
  for (const EdgeId edge : single.ids())
    if (chosen.counts[edge] > 0 &&
        (targets.least_of_grids[edge] > 1 || targets.fixed[edge] != 0 || is_set(targets.even, edge) ||
         targets.wanted[edge] * targets.stride > most_wanted))
      single[chord(edge)] = 0;
  // Chords on which sums over sides of several edges depend keep their segments, and so do the sides around
  // holes in grids, and those of triangles, which could no longer be subdivided.
  for (const FaceSides& face : sides) {
    for (const FacingPair& pair : face.facing) {
      std::map<EdgeId, int> sums;
      for (const SideEdge& edge : pair.first) ++sums[chord(edge.edge)];
      for (const SideEdge& edge : pair.second) --sums[chord(edge.edge)];
      for (const auto& [id, sum] : sums)
        if (sum != 0 || face.has_holes()) single[id] = 0;
    }
    for (const EdgeId edge : face.rest)
      if (face.may_be_odd) single[chord(edge)] = 0;
  }
  const EdgeFlags keep = kept_for_parity(shape, targets, chosen.chords, is_single);
  for (const EdgeId edge : keep.ids())
    if (keep[edge]) single[edge] = 0;
  for (const EdgeId edge : single.ids())
    if (is_single(edge)) chosen.counts[edge] = 1;
}

}  // namespace quadrille
