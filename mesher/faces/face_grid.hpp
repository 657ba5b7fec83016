#pragma once
/// Faces meshed as grids of quads, without a triangulation first. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/face_surface.hpp"
#include "mesher/edges/face_plan.hpp"
#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// The quads of a face at the final size. The boundary's points come first, `nodes.size()` of them: those of
/// the FaceBoundary, then the middles of its segments.
struct FaceGrid {
  std::vector<Vector2> uv;
  std::vector<Vector3> points;
  std::vector<int> nodes;                 ///< indices into BoundaryNodes::points
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise in the parameter plane
  int rings = 0;                          ///< least number of rings of quads around a hole; 0 = no holes
};

/// Meshes a face as one grid, as rows between two loops, or as a grid with blocks replaced by holes. With
/// holes, the nodes inside must still be moved, and quads may be folded until then. \return nothing if the
/// outline allows no grid, or if the grid would fold or miss the sizing field. Time: linear in the points.
std::optional<FaceGrid> make_grid(const FaceBoundary& boundary, const FacePlan& plan,
                                  const FaceSurface& surface, SizingField::Sampler& size_at,
                                  const ExecutionContext& context = {});

}  // namespace quadrille
