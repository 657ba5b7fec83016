#pragma once
/// Triangulates closed loops in space, without a parameter plane. Internal.

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// The triangles that span closed loops of points: the first loop is the outer one, the others are holes,
/// which bridges join to it. No point is added. Based on: Liepa, Filling holes in meshes (2003), as in CGAL.
/// \param points places of the points that the loops refer to
/// \param loops indices into `points`, at least three a loop, in the direction in which the triangles lie to
/// the left
/// \param flips flip_flat() the triangles, by which narrow ones may leave the surface that they filled
/// \return triangles over the indices, counter-clockwise as the loops; none if no triangulation was found or
/// if there are more than 2000 points. Up to O(n^3), about n^2 for most loops.
std::vector<std::array<int, 3>> fill_loops(const std::vector<Vector3>& points,
                                           const std::vector<std::vector<int>>& loops, bool flips);

/// Flips the long sides of flat triangles, which remain where points lie in a line: a triangle whose longest
/// side is flipped becomes part of two better ones. At most 20 passes over the triangles.
/// \param kept sides that stay, smaller index first
void flip_flat(const std::vector<Vector3>& points, const std::set<std::pair<int, int>>& kept,
               std::vector<std::array<int, 3>>& triangles);

}  // namespace quadrille
