#pragma once
/// Prepares triangulations of any origin for pairing: orients them consistently, and cuts them along the
/// sides that no quad may cross. Internal.

#include <array>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// For each point, the first point within `tolerance` of it that is its own representative; the point itself
/// if there is no such point. \param tolerance 0 = exactly the same position. O(n log n).
std::vector<int> coincident_points(const std::vector<Vector3>& points, double tolerance);

/// Orients triangles so that neighbors of one tag run along their common side in opposite directions. Each
/// connected piece takes the orientation of the majority. Returns how many triangles were reversed. Throws
/// Error (failure) naming a triangle that agrees with its neighbors in neither orientation (a one-sided
/// surface), or that has the same corners as another. O(n).
int orient_alike(TriangleMesh& mesh);

/// A triangulation cut into pieces. No piece has a side with more than two triangles, or touches itself at a
/// single point.
struct CutSurface {
  TriangleMesh mesh;          ///< triangles in their old order; the tag of each is its piece, from 0
  std::vector<int> original;  ///< point -> point of the input; points on cuts have copies, which come last
  int pieces = 0;             ///< number of pieces
};

/// Cuts an oriented triangulation along these sides: sides between different tags, sides between triangles
/// whose normals differ by more than `angle` degrees (0 = never), sides where more than two triangles of one
/// tag meet, and `sides` (pairs of points, in either order). Fixed points stay fixed. O(n + s log s) for n
/// triangles and s sides.
CutSurface cut_surface(const TriangleMesh& mesh, double angle, std::vector<std::array<int, 2>> sides = {});

}  // namespace quadrille
