#pragma once
/// Counts along strips that are narrower than the size. Internal.

#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/count_table.hpp"
#include "mesher/edges/edge_counts.hpp"

namespace quadrille {

/// Raises what edges of four-sided faces want, and what the others of their chords want by as much, until no
/// quad of the face is longer than four times the width of its rows, which are known once counts are chosen.
/// Where that would take more than three times as many, all is left as it is. \param sides as choose_counts()
/// left them. \param tables (edges) \return whether anything was raised, so that counts are to be chosen
/// again.
bool refine_along_strips(const CadShape& shape, const std::vector<FaceSides>& sides, const EdgeCounts& chosen,
                         std::vector<CountTable>& tables, CountWishes& wishes);

}  // namespace quadrille
