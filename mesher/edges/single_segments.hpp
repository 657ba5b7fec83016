#pragma once
/// Single segments on edges that are too short for two: 8 % fewer short sides and 6 % fewer quads outside the
/// limits on real parts (decision 75). Internal.

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// Gives one segment in place of two to the chords whose wanted count is nearer to one than to two, by ratio:
/// the ends of strips, for instance, which then have one row. Faces beside them are not cut from quads of
/// twice the size, so their boundaries need an even sum of segments only: where the sum would be odd, a
/// cheapest set of chords keeps its two segments (make_even()). Chords keep them too where curves, users, or
/// sums over sides of several edges require more than one. Does nothing unless the stride is 2.
void choose_single_segments(const CadShape& shape, const CountTargets& targets, const FaceOutlines& sides,
                            EdgeCounts& chosen);

}  // namespace quadrille
