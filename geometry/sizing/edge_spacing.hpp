#pragma once
/// Edges whose division the user prescribes. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// The division of one edge, independent of the sizing field.
struct PrescribedEdge {
  int segments = 0;  ///< number of segments in the final mesh; where it is not fixed, the wanted one
  /// Positions of the nodes as shares of the edge's length from its start: ascending, segments + 1 of them.
  /// Empty where only the number of segments is prescribed.
  std::vector<double> shares;
  /// What `shares` follows; 0 segments = the chord of the edge decides how many it gets.
  EdgeSpacing spacing{segments};

  /// Whether the number of segments is prescribed, not their spacing alone.
  bool is_fixed() const { return spacing.segments > 0; }
  /// The division of an edge into so many segments. Throws Error (usage) if a bias makes them so short that
  /// their ends are one point.
  static PrescribedEdge make(const CadEdge& edge, int segments, const EdgeSpacing& spacing);
  /// The length of the segment at a share of an edge of this length; the mean length if `shares` is empty.
  double size_at(double share, double length) const;
  /// The length of the shortest segment on an edge of this length.
  double shortest(double length) const;
};

/// The division of each edge, where one is prescribed.
using PrescribedEdges = IdVector<EdgeId, std::optional<PrescribedEdge>>;

/// What options.spacings prescribes; the pieces of a divided CAD edge have its number of segments
/// together. \param size the size of edges with a bias but no number, unless options.edge_sizes gives a
/// smaller one. Throws Error (usage) when an edge in pieces has fewer segments than pieces, or a bias, and as
/// PrescribedEdge::make() does.
PrescribedEdges prescribed_edges(const CadShape& shape, const SizingOptions& options, double size);

}  // namespace quadrille
