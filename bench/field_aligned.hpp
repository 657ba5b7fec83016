#pragma once
/// Quadrille's own triangulation of a planar domain: points along a cross field, as the mesher makes it
/// before pairing.

#include <vector>

#include "bench/planar_triangulation.hpp"

namespace quadrille::bench {

/// Triangulates the domain between the first ring and the others (holes), as `quadrille mesh --strategy
/// direct` does on a face that is not a regular grid. The sides of the rings are the CAD edges: each gets at
/// least one segment.
TriangleMesh triangulate_along_field(const std::vector<Ring>& rings, const Grading& grading);

}  // namespace quadrille::bench
