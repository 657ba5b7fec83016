#pragma once
/// Chords: edges opposite each other across faces, which share their count and their spacing. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

/// The largest ratio between wanted counts of a chord's edges, or of facing sides, of which one is fixed.
constexpr double largest_fixed_ratio = 4;

/// Classes of edges: a union-find structure that also records which members run in opposite directions.
class Chords {
 public:
  /// \param wanted number of segments
  explicit Chords(const IdVector<EdgeId, double>& wanted);

  /// The representative edge of the chord that an edge belongs to.
  EdgeId of(EdgeId edge) const;
  /// Whether an edge runs in the opposite direction to the representative of its chord.
  bool against(EdgeId edge) const;

  /// Merges the chords of two edges, unless the wanted count of some member is more than `largest_ratio`
  /// times that of another one. \return whether the two edges are now in one chord.
  bool tie(const SideEdge& a, const SideEdge& b, double largest_ratio);

 private:
  IdVector<EdgeId, EdgeId> parent_;
  EdgeFlags against_;                    // 1 = runs against its parent
  IdVector<EdgeId, double> low_, high_;  // (representatives) smallest and largest count wanted in the chord
};

/// Places of nodes, as shares of the edge's length from its start.
using EdgeShares = IdVector<EdgeId, std::vector<double>>;

/// Where the nodes of all edges lie.
struct PlannedSpacing {
  EdgeShares shares;  ///< see space_chords()
  /// (representatives) 1 = users prescribe the number of segments on the chord, or its spacing.
  EdgeFlags divided, kept;
};

/// Spaces the nodes of the chords. All members have their nodes at the same shares of their lengths, and at
/// each place the member with the finest spacing decides. A side that is a single edge takes over the spacing
/// of the edges opposite if these are several.
/// \param counts segments of the final mesh \param prescribed shares
/// that users prescribe, which apply to the whole chord; empty = not prescribed.
/// \return shares of the edge's length from its start, ascending, one for each node; empty where an
/// edge is alone in its chord, or where some segment would be more than twice as long as its own sizes allow.
EdgeShares space_chords(const CadShape& shape, const FaceOutlines& sides, const Chords& chords,
                        const IdVector<EdgeId, CountTable>& tables, const IdVector<EdgeId, int>& counts,
                        const EdgeShares& prescribed);

/// 1 = the edge's division is prescribed, and all faces along its chord are four-sided or rings: rows of flat
/// quads keep the division, and the sizes around need not follow. The other edges of the chord must not have
/// another prescribed number, nor a wanted count above four times or below a quarter of it. \param sides
/// outlines \param prescribed for each edge \param size the size on edges that options.edge_sizes does not
/// name
EdgeFlags find_grid_rows(const CadShape& shape, const FaceOutlines& sides, const PrescribedEdges& prescribed,
                         const SizingOptions& options, double size);

}  // namespace quadrille
