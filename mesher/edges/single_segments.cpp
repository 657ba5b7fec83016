/// One segment for short edges, where all faces stay even: a T-join over the chords that could have one.

#include "mesher/edges/single_segments.hpp"

#include <map>

#include "mesher/edges/parity.hpp"

namespace quadrille {

namespace {

/// The largest number of segments by the sizing field to which one is nearer than two, by ratio.
constexpr double most_wanted = 1.42;

class SingleSegments {
 public:
  SingleSegments(const CadShape& shape, const CountTargets& targets, const FaceOutlines& sides,
                 EdgeCounts& chosen)
      : shape_(shape), targets_(targets), sides_(sides), chosen_(chosen), single_(targets.wanted.size(), 0) {}

  void run() {
    for (const EdgeId edge : single_.ids()) single_[chord(edge)] |= chosen_.counts[edge] == 2;
    for (const EdgeId edge : single_.ids())
      if (chosen_.counts[edge] > 0) single_[chord(edge)] &= may_be_single(edge);
    for (const FaceSides& sides : sides_) keep_sums(sides);
    keep_faces_even();
    for (const EdgeId edge : single_.ids())
      if (is_single(edge)) chosen_.counts[edge] = 1;
  }

 private:
  EdgeId chord(EdgeId edge) const { return chosen_.chords.of(edge); }

  bool is_single(EdgeId edge) const { return chosen_.counts[edge] > 0 && single_[chord(edge)] != 0; }

  bool may_be_single(EdgeId edge) const {
    return targets_.least_of_grids[edge] <= 1 && targets_.fixed[edge] == 0 && !is_set(targets_.even, edge) &&
           targets_.wanted[edge] * targets_.stride <= most_wanted;
  }

  /// Chords on which sums over sides of several edges depend keep their segments, and so do the sides around
  /// holes in grids, and those of triangles, which could no longer be subdivided.
  void keep_sums(const FaceSides& sides) {
    for (const FacingPair& pair : sides.facing) {
      std::map<EdgeId, int> sums;
      for (const SideEdge& edge : pair.first) ++sums[chord(edge.edge)];
      for (const SideEdge& edge : pair.second) --sums[chord(edge.edge)];
      for (const auto& [id, sum] : sums)
        if (sum != 0 || sides.has_holes()) single_[id] = 0;
    }
    if (!sides.may_be_odd) return;
    for (const EdgeId edge : sides.rest) single_[chord(edge)] = 0;
  }

  void keep_faces_even() {
    IdVector<EdgeId, ParityEdge> edges(single_.size());
    FaceFlags odd(shape_.faces.size(), 0);
    for (const FaceId face : shape_.faces.ids()) {
      std::map<EdgeId, int> uses;  // of chords by the face
      for (const EdgeId edge : shape_.faces[face].edges())
        if (is_single(edge)) ++uses[chord(edge)];
      for (const auto& [id, count] : uses) {
        if (count % 2 == 0) continue;
        edges[id].faces.push_back(face);
        odd[face] ^= 1;
      }
    }
    for (const EdgeId edge : edges.ids())
      if (is_single(edge)) edges[chord(edge)].cost += 1;
    std::vector<FaceId> left;
    const EdgeFlags keep = make_even(edges, odd, left, targets_.check);
    for (const EdgeId edge : keep.ids())
      if (keep[edge]) single_[edge] = 0;
  }

  const CadShape& shape_;
  const CountTargets& targets_;
  const FaceOutlines& sides_;
  EdgeCounts& chosen_;
  EdgeFlags single_;  // (chords) 1 = gets one segment
};

}  // namespace

void choose_single_segments(const CadShape& shape, const CountTargets& targets, const FaceOutlines& sides,
                            EdgeCounts& chosen) {
  if (targets.stride == 2) SingleSegments(shape, targets, sides, chosen).run();
}

}  // namespace quadrille
