#pragma once
/// Chooses the number of segments of each edge. Internal.

#include <functional>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/chords.hpp"
#include "mesher/edges/face_sides.hpp"
#include "mesher/edges/tiny_features.hpp"

namespace quadrille {

/// What the counts of the edges of the faces used should be.
struct CountTargets {
  int stride = 1;                        ///< see BoundaryNodes::stride
  IdVector<EdgeId, double> wanted;       ///< segments by the sizing field, in the mesh that is recombined
  IdVector<EdgeId, int> least;           ///< least number in the mesh that is recombined; 0 = edge not used
  IdVector<EdgeId, int> least_of_grids;  ///< least number in the final mesh if only grids use the chord
  IdVector<EdgeId, int> fixed;           ///< segments of the final mesh that users prescribe; 0 = any number
  EdgeFlags even;                        ///< 1 = even number of segments though the stride is 1; may be empty
  std::function<void()> check = [] {};   ///< called during long work; may throw
};

struct EdgeCounts {
  IdVector<EdgeId, int> counts;  ///< segments of the final mesh; 0 = edge not used
  Chords chords;
};

/// Chooses the counts of all edges near the wanted ones: one count for each chord, equal counts on facing
/// sides, and an even sum around every face. A face whose sides would get counts too far from the wanted ones
/// loses its outline. \param sides in: as found; out: with facing sides only where their counts match. Chords
/// that only grids use are counted in segments of the final mesh, others in multiples of the stride. With
/// stride 2, wedges and strips may keep an odd boundary, since the remaining triangle is subdivided too.
/// Fixed counts are kept. Other edges of the chord get the fixed count if their wanted counts are between a
/// quarter of it and four times it. Throws Error (usage, naming the edges) if a fixed count cannot be kept:
/// an odd one on an edge of a face that needs even numbers, or one that leaves the boundary of a face odd.
EdgeCounts choose_counts(const CadShape& shape, const CountTargets& targets, const TinyFeatures& tiny,
                         FaceOutlines& sides);

/// Gives one segment in place of two to the chords whose wanted count is nearer to one than to two, by ratio:
/// the ends of strips, for instance, which then have one row. On real parts there are 8 % fewer short sides,
/// and 6 % fewer quads outside the limits (decision 75). Faces beside them are not cut from quads of twice
/// the size, so their boundaries need an even sum of segments only: where the sum would be odd, a cheapest
/// set of chords keeps its two segments (make_even()). Chords keep them too where curves, users, or sums over
/// sides of several edges require more than one. Does nothing unless the stride is 2.
void choose_single_segments(const CadShape& shape, const CountTargets& targets, const FaceOutlines& sides,
                            EdgeCounts& chosen);

}  // namespace quadrille
