#pragma once
/// Triangles that no alternating path pairs migrate until they meet. Internal.

#include <vector>

#include "mesher/pairing/costed_coloring.hpp"

namespace quadrille {

/// Moves free triangles to each other: a triangle and a quad beside it form a pentagon, which can be cut into
/// a quad and a triangle on the far side. Two triangles that meet become a quad. Diagonals of pairs are
/// flipped where the way needs it. Afterwards a connected piece has at most one free triangle, unless no way
/// was found. \return the number of triangles still free.
int migrate_free_triangles(CostedColoring& coloring, const std::vector<Vector3>& points,
                           const ExecutionContext& context = {});

}  // namespace quadrille
