#pragma once
/// Chords: edges that run along each other across faces, and so share their count and their spacing.
/// Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

/// Classes of edges. A union-find structure that knows which members run against each other.
class Chords {
 public:
  /// \param wanted (edges) number of segments
  explicit Chords(const std::vector<double>& wanted);

  /// The edge that stands for the chord of an edge.
  int of(int edge) const;
  /// Whether an edge runs against the one that stands for its chord.
  bool against(int edge) const;

  /// Makes the chords of two edges one, unless some member would get more than `largest_ratio` times the
  /// count of another. \return whether they are one.
  bool tie(const SideEdge& a, const SideEdge& b, double largest_ratio);

 private:
  std::vector<int> parent_;
  std::vector<char> against_;  // parent
  std::vector<double> low_, high_;
};

/// Where the nodes of the chords go: the nodes of all members at equal shares of their lengths, by the
/// tightest spacing that one of them asks for there. A side that is a single edge takes over the spacing of
/// several edges that it runs along.
/// \param tables (edges) \param counts (edges) segments of the final mesh \param prescribed (edges) shares
/// that users ask for, which their chord gets too; empty where there are none.
/// \return (edges) shares of the edge's length from its start, ascending, one for each node; empty where an
/// edge is alone in its chord, or where the shares would leave its own spacing too far behind.
std::vector<std::vector<double>> space_chords(const CadShape& shape, const std::vector<FaceSides>& sides,
                                              const Chords& chords, const std::vector<CountTable>& tables,
                                              const std::vector<int>& counts,
                                              const std::vector<std::vector<double>>& prescribed);

}  // namespace quadrille
