#pragma once
/// Quadrille's own triangulation of a planar domain: points along a cross field, as the mesher has it before
/// it pairs.

#include <vector>

#include "bench/planar_triangulation.hpp"

namespace quadrille::bench {

/// Triangulates what lies between the first ring and the others (holes), as `quadrille mesh --strategy
/// direct` does on a face that is no regular grid. Their sides are the CAD edges: none gets less than one
/// segment.
TriangleMesh triangulate_along_field(const std::vector<Ring>& rings, const Grading& grading);

}  // namespace quadrille::bench
