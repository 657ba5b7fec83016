#pragma once
/// The quality of a mesh as a table to read.

#include <string>

#include "mesher/mesh/criteria.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille::command {

/// Several lines: counts, q, scaled Jacobian, irregular nodes, aspect, edge lengths.
std::string quality_table(const QualitySummary& summary);

/// The histogram of q, one line a bin, with bars.
std::string quality_histogram(const QualitySummary& summary);

/// Several lines: how many quads fail, by criterion and face, and the worst with their place.
std::string criteria_table(const CriteriaSummary& summary, const CriteriaLimits& limits);

/// Interior nodes by valence, one line a valence that occurs.
std::string valence_table(const QualitySummary& summary);

}  // namespace quadrille::command
