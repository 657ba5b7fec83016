#pragma once
/// How many segments each edge gets. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/facing_sides.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// What is asked of the edges of the faces used.
struct CountWishes {
  std::vector<double> wanted;  ///< (edges) segments by the sizing field
  std::vector<int> least;      ///< (edges) fewest segments; 0 = edge not used
};

/// The counts of all edges: tied ones alike, rounded, and changed so that every face becomes even.
/// \param tie whether sides that face each other get as many segments.
/// \param strips both sides of these get as many nodes; none where edges are not to be tied.
/// \param odd_faces faces (from 1) that could not be made even
std::vector<int> choose_counts(const CadShape& shape, const std::vector<char>& used,
                               const CountWishes& wishes, const TinyFeatures& tiny, bool tie,
                               const std::vector<SplitStrip>& strips, int stride,
                               std::vector<int>& odd_faces);

}  // namespace quadrille
