#pragma once
/// Plain planar Delaunay triangulations of the paper's domains: graded random points, slightly relaxed, all
/// inserted at once. They are like those of a general triangulator, not field-aligned. Based on: Bridson,
/// Fast Poisson disk sampling in arbitrary dimensions (2007).

#include <filesystem>
#include <vector>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille::bench {

using Ring = std::vector<Vector2>;  ///< closed, without repeating the first point

/// Size at the boundary, and how it grows with the distance from it.
struct Grading {
  double boundary_size = 1;
  double growth = 0;
  double largest = 1e300;
};

/// \param rings the outer ring and the islands, in any direction; their points are kept.
TriangleMesh triangulate(const std::vector<Ring>& rings, const Grading& grading, unsigned seed);

/// Rings as in bench/data/lake_ontario.txt: "> count", then "x y" lines.
std::vector<Ring> read_rings(const std::filesystem::path& path);

}  // namespace quadrille::bench
