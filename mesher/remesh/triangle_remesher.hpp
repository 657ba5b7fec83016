#pragma once
/// A triangulated surface made anew of triangles of a wanted size. Internal.

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
    std::array<int, 2> points;                                                 ///< in the curve's direction
    int curve = 0;                                                             ///< from 0
    double from = 0 /**< length along the curve at the first point */, to = 0; /**< at the second */
  };
  TriangleMesh mesh;                ///< tags are the surface's patches
  std::vector<CurveSide> sides;     ///< by curve, in order along it
  std::vector<int> surface_corner;  ///< (points) the corner of the surface that a point is; -1 = none
};

/// Makes triangles with sides as long as `targets` wants, smaller where nodes on curves are nearer and where
/// they would fold by more than 60 degrees at a side (down to an eighth), on each patch of the surface.
/// Corners stay, nodes on curves are those of `nodes` (see place_on_curves()), and others lie on the patch.
/// \param surface without tags. \param targets (points of the surface) millimeters, the same all over a
/// connected piece. Throws Error (cancelled). Based on: Botsch & Kobbelt, A remeshing approach to
/// multiresolution modeling (2004): sides split and collapsed, flipped, points moved along the surface.
RemeshedTriangles remesh_triangles(const TriangleMesh& surface, const FeatureNetwork& network,
                                   const std::vector<std::vector<double>>& nodes,
                                   const SurfaceLocator& locator, const std::vector<double>& targets,
                                   ExecutionContext& context);

}  // namespace quadrille
