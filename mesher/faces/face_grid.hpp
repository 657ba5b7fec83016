#pragma once
/// Faces as grids of quads, without triangles in between. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// The quads of a face at its final size. Points on the boundary come first, `nodes.size()` of them: those of
/// the FaceBoundary, then those in the middle of its segments.
struct FaceGrid {
  std::vector<Vector2> uv;
  std::vector<Vector3> points;
  std::vector<int> nodes;                 ///< index into BoundaryNodes::points
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise in the parameter plane
  int rings = 0;                          ///< round each hole, at least; 0 = no holes
};

/// The face as a grid, or a few that meet in one point or round a core; where it has holes (Outline::holed),
/// nodes inside are still to be moved, and quads may be folded until then. Nothing where its outline allows
/// none, where the grid would fold, or where it would miss the sizing field. Time: linear in the points.
std::optional<FaceGrid> make_grid(const FaceBoundary& boundary, const FaceSides& sides,
                                  const FaceSurface& surface, SizingField::Sampler& size_at,
                                  const ExecutionContext& context = {});

}  // namespace quadrille
