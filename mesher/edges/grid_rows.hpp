#pragma once
/// Prescribed edge divisions that grids continue as rows. Internal.

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "mesher/edges/face_sides.hpp"

namespace quadrille {

/// 1 = the edge's division is prescribed, and all faces along its chord are four-sided or rings: rows of flat
/// quads keep the division, and the sizes around need not follow. The other edges of the chord must not have
/// another prescribed number, nor a wanted count above four times or below a quarter of it. \param sides
/// outlines \param prescribed for each edge \param size the size on edges that options.edge_sizes does not
/// name
EdgeFlags find_grid_rows(const CadShape& shape, const FaceOutlines& sides, const PrescribedEdges& prescribed,
                         const SizingOptions& options, double size);

}  // namespace quadrille
