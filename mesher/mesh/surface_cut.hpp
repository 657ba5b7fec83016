#pragma once
/// Triangulations from anywhere made fit for pairing: oriented alike, and cut where quads must not reach
/// across. Internal.

#include <span>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// For each point the first one that lies within `tolerance` of it and stands for itself; itself where there
/// is none. \param tolerance 0 = on the very same place. O(n log n).
std::vector<int> coincident_points(const std::vector<Vector3>& points, double tolerance);

/// Turns triangles so that neighbors of one tag run along the side between them in opposite ways, the way
/// round that most of a connected piece have. Returns how many were turned. Throws Error (failure) naming a
/// triangle that fits no way round (a surface with one side only), or that has the same corners as another.
/// O(n).
int orient_alike(TriangleMesh& mesh);

/// A triangulation cut into pieces: no piece has a side with more than two triangles, or touches itself in a
/// point without a side there.
struct CutSurface {
  TriangleMesh mesh;          ///< the triangles as they were; the tag of each is its piece, from 0
  std::vector<int> original;  ///< point -> which one it was: those on cuts come several times, copies last
  int pieces = 0;
};

/// Cuts an oriented triangulation along the sides between different tags, between triangles whose normals
/// differ by more than `angle` degrees (0 = never), where more than two triangles of one tag meet, and along
/// `sides` (pairs of points, in either order). Points marked as fixed stay so. O(n + s log s) for n triangles
/// and s sides.
CutSurface cut_surface(const TriangleMesh& mesh, double angle, std::vector<std::array<int, 2>> sides = {});

}  // namespace quadrille
