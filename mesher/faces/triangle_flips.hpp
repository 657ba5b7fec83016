#pragma once
/// Flips of the sides between triangles of a face. Internal.

#include <array>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/faces/face_triangulation.hpp"

namespace quadrille {

/// Triangle neighbors over sides: neighbor[3 t + k] is across the side from corner k to corner k + 1; -1 =
/// none. \param points above all corners. Linear but for points with many triangles.
std::vector<int> triangle_neighbors(const std::vector<std::array<int, 3>>& triangles, int points,
                                    const ExecutionContext& context);

/// Flips sides to the Delaunay criterion in space. Based on: Lawson (1977).
/// \param across as triangle_neighbors() gives them, before the points of poles were made one, which may
/// leave two sides between two points.
void flip_in_space(FaceTriangulation& face, std::vector<int> across, const ExecutionContext& context);

}  // namespace quadrille
