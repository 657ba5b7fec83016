#pragma once
/// What is known of meshes and middle surfaces, as tables of text.

#include <string>

#include "geometry/midsurface/midsurface.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille::command {

/// Several lines: counts, q, Jacobians, inverted elements, irregular nodes, aspect, warping, edge lengths.
std::string quality_table(const QualitySummary& summary);

/// The histogram of q, one line per bin, with bars.
std::string quality_histogram(const QualitySummary& summary);

/// Several lines: how many quads fail, by criterion and face, and the worst quads with their centers.
std::string criteria_table(const CriteriaSummary& summary, const CriteriaLimits& limits);

/// Interior nodes by valence, one line for each valence that occurs.
std::string valence_table(const QualitySummary& summary);

/// A line for each face with its area, its thickness and the faces of the solid that it lies between; area
/// times thickness over the volume, with and without what is counted twice; the numbers of parts, solids and
/// free edges; and the faces of the solid that belong to no wall.
std::string middle_table(const MidSurface& middle);

}  // namespace quadrille::command
