#pragma once
/// How many segments each edge gets. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/chords.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// What is asked of the edges of the faces used.
struct CountWishes {
  int stride = 1;                   ///< BoundaryNodes::stride, which see
  std::vector<double> wanted;       ///< (edges) segments by the sizing field, of the mesh that is recombined
  std::vector<int> least;           ///< (edges) fewest of those; 0 = edge not used
  std::vector<int> least_of_grids;  ///< (edges) fewest segments of the final mesh between grids
  std::vector<int> fixed;           ///< (edges) segments of the final mesh that users ask for; 0 = any number
  std::vector<char> even;  ///< (edges) 1 = an even number of segments, with a stride of 1; may be empty
};

struct EdgeCounts {
  std::vector<int> counts;  ///< (edges) segments of the final mesh; 0 = edge not used
  Chords chords;
  std::vector<int> odd_faces;  ///< faces (from 1) that could not be made even
};

/// The counts of all edges, near those wanted: one for each chord, as many on sides that face each other, and
/// an even sum round every face. Faces whose sides would have to go too far from what is wanted lose their
/// outline. \param sides (faces) in: as found; out: those whose facing sides have as many segments.
/// Chords that only grids have are counted by themselves, others by the stride; with stride 2, wedges and
/// strips may keep an odd boundary, since the triangle that is left is cut up. Fixed counts are kept, and by
/// the edges that run along theirs if those want no more than four times or a quarter as many. Throws Error
/// (usage, naming the edges) where they cannot be: an odd number on an edge of a face that needs even ones, a
/// face whose boundary stays odd.
EdgeCounts choose_counts(const CountWishes& wishes, const TinyFeatures& tiny, std::vector<FaceSides>& sides);

}  // namespace quadrille
