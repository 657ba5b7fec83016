#pragma once
/// The quality of a mesh as tables of text.

#include <string>

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

}  // namespace quadrille::command
