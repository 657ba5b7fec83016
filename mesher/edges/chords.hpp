#pragma once
/// Chords: edges opposite each other across faces, which share their count and their spacing. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

/// Classes of edges: a union-find structure that also records which members run in opposite directions.
class Chords {
 public:
  /// \param wanted (edges) number of segments
  explicit Chords(const std::vector<double>& wanted);

  /// The representative edge of the chord that an edge belongs to.
  int of(int edge) const;
  /// Whether an edge runs in the opposite direction to the representative of its chord.
  bool against(int edge) const;

  /// Merges the chords of two edges, unless some member wants more than `largest_ratio` times the count that
  /// another one wants. \return whether the two edges are now in one chord.
  bool tie(const SideEdge& a, const SideEdge& b, double largest_ratio);

 private:
  std::vector<int> parent_;
  std::vector<char> against_;       // 1 = runs against its parent
  std::vector<double> low_, high_;  // (representatives) smallest and largest count wanted in the chord
};

/// Spaces the nodes of the chords. All members have their nodes at the same shares of their lengths, and at
/// each place the member with the finest spacing decides. A side that is a single edge takes over the spacing
/// of the edges opposite if these are several.
/// \param tables (edges) \param counts (edges) segments of the final mesh \param prescribed (edges) shares
/// that users prescribe, which apply to the whole chord; empty = not prescribed.
/// \return (edges) shares of the edge's length from its start, ascending, one for each node; empty where an
/// edge is alone in its chord, or where some segment would be more than twice as long as its own sizes allow.
std::vector<std::vector<double>> space_chords(const CadShape& shape, const std::vector<FaceSides>& sides,
                                              const Chords& chords, const std::vector<CountTable>& tables,
                                              const std::vector<int>& counts,
                                              const std::vector<std::vector<double>>& prescribed);

}  // namespace quadrille
