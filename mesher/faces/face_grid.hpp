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

/// When a grid has far more quads than the sizes request, for edges that users make fine (decision 75): one
/// with `wasteful` times the quads that the sizes request is replaced by a mesh with fewer than `fewer` of
/// its quads.
struct GridWaste {
  static constexpr double wasteful = 1.75, fewer = 0.8;
};

/// Whether there are more than `most` times the quads that the sizes request, plus half of the boundary
/// segments. Rows that are fine for one edge also run through areas where larger quads are wanted.
inline bool is_wasteful(double quads, double wanted, double border, double most) {
  return quads > most * wanted + 0.5 * border;
}

/// How many quads a face gets, a grid or others, before either is made. \param wanted number that the sizes
/// request \param border segments on its boundary
inline double expected_with_grid(double in_grid, double others, double wanted, double border) {
  const bool makes_room = is_wasteful(in_grid, wanted, border, GridWaste::wasteful);
  return makes_room && others < GridWaste::fewer * in_grid ? others : in_grid;
}

}  // namespace quadrille
