#pragma once
/// Edges whose division users prescribe. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// How one edge is divided, whatever the sizes are.
struct PrescribedEdge {
  int segments = 0;  ///< of the final mesh
  /// Of the edge's length from its start, that nodes stand at: ascending, segments + 1; empty where only the
  /// number is prescribed.
  std::vector<double> shares;

  /// The mean or, where the shares are known, the longest length of the segments at a share.
  double size_at(double share, double length) const;
};

/// (edges) what options.spacings prescribes, pieces of a divided CAD edge together having its number.
/// \param size that edges with a bias but no number have by themselves, beside options.edge_sizes. Throws
/// Error (usage) where an edge in pieces has fewer segments than those.
std::vector<std::optional<PrescribedEdge>> prescribed_edges(const CadShape& shape,
                                                            const SizingOptions& options, double size);

}  // namespace quadrille
