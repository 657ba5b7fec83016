#pragma once
/// Segment counts along strips narrower than the size. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// Raises the wanted counts of edges of four-sided faces and of the rest of their chords until quads are at
/// most `aspect` times as long as the rows are wide. The width of the rows is known once counts are chosen.
/// Rows that users divide are as flat as these ask for. \param sides as choose_counts() left them \param
/// shortest no shorter segments are asked for \return whether anything was raised, so that counts must be
/// chosen again.
bool refine_along_strips(const CadShape& shape, const FaceOutlines& sides, const EdgeCounts& chosen,
                         const PlannedSpacing& spacing, double aspect, double shortest,
                         IdVector<EdgeId, CountTable>& tables, CountTargets& targets);

}  // namespace quadrille
