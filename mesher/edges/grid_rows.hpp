#pragma once
/// Prescribed edge divisions and layers that grids continue as rows. Internal.

#include <optional>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

struct GridRows {
  /// What users prescribe, and the heights of layers on the edges that run away from the layers' own.
  PrescribedEdges prescribed;
  /// 1 = prescribed, and all faces along its chord are four-sided or rings: rows of flat quads keep
  /// the division, and the sizes around need not follow.
  EdgeFlags divided;
  EdgeFlags layered;  ///< 1 = its layers become rows
};

/// Finds the divisions and layers in the options that grids can continue. The layers of an edge become rows
/// if all its faces are four-sided, and the two sides that run away from it are single edges without a
/// division of their own. The layers may take up to nine tenths of these sides. The edges that run along
/// these sides must not have another prescribed number, nor a wanted count above four times or below a
/// quarter of it. \param sides outlines \param prescribed what users prescribe \param size the size on edges
/// that options.edge_sizes does not name
GridRows find_grid_rows(const CadShape& shape, const FaceOutlines& sides, PrescribedEdges prescribed,
                        const SizingOptions& options, double size);

}  // namespace quadrille
