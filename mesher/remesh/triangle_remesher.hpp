#pragma once
/// Remeshes a triangulated surface with triangles of a wanted size. Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/feature_network.hpp"
#include "mesher/remesh/surface_locator.hpp"

namespace quadrille {

/// Triangles on a surface, with nodes on its curves.
struct RemeshedTriangles {
  /// A side on a curve.
  struct CurveSide {
    std::array<int, 2> points;  ///< end points, in the curve's direction
    int curve = 0;              ///< index of the curve, from 0
    double from = 0 /**< length along the curve at the first point */, to = 0; /**< at the second point */
  };
  TriangleMesh mesh;                ///< tags are the surface's patches
  std::vector<CurveSide> sides;     ///< sides on curves, by curve, in order along each
  std::vector<int> surface_corner;  ///< (points) point of the surface at which curves end; -1 = none
};

/// Makes triangles on each patch of the surface, with sides as long as `targets` asks. They are smaller where
/// nodes on curves are closer, and where triangles would fold by more than 60 degrees at a side (down to an
/// eighth). Corners stay, nodes on curves are those of `nodes` (see place_on_curves()), and other points lie
/// on the patch. \param surface its tags do not matter. \param targets (points of the surface) wanted side
/// lengths, millimeters. Throws Error (cancelled). Based on: Botsch & Kobbelt, A remeshing approach to
/// multiresolution modeling (2004): sides are split, collapsed and flipped, and points move along the
/// surface.
RemeshedTriangles remesh_triangles(const TriangleMesh& surface, const FeatureNetwork& network,
                                   const std::vector<std::vector<double>>& nodes,
                                   const SurfaceLocator& locator, const std::vector<double>& targets,
                                   ExecutionContext& context);

}  // namespace quadrille
