#pragma once
/// Flips sides between triangles of a face. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/faces/face_triangulation.hpp"

namespace quadrille {

/// Neighbors across the sides of triangles. Entry 3 t + k belongs to the side of triangle t from corner k to
/// corner k + 1: it is the same side as seen from the other triangle, 3 t' + k', or -1 if there is none.
/// \param points number of points. Time: linear, but quadratic in the triangles at a point.
std::vector<int> triangle_neighbors(const std::vector<std::array<int, 3>>& triangles, int points,
                                    const ExecutionContext& context);

/// Flips sides until they satisfy the Delaunay criterion in space. Based on: Lawson (1977).
/// \param across neighbors in the form of triangle_neighbors(). They must stem from the triangles before the
/// points of each pole were merged, since merging may leave two sides between the same two points.
void flip_in_space(FaceTriangulation& face, std::vector<int> across, const ExecutionContext& context);

}  // namespace quadrille
