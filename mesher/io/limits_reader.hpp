#pragma once
/// Reads quality limits from a file.

#include <filesystem>

#include "geometry/base/api.hpp"
#include "mesher/mesh/criteria.hpp"

namespace quadrille {

/// Reads limits from a JSON object, {"aspect": 5, "taper": null}: names as in criteria_info, null = not
/// checked; criteria that are not named keep their usual limits. Or reads a HyperMesh criteria file. Each
/// line holds a number, the name of a criterion, 1 or 0 (checked or not) and the columns weight, ideal, good,
/// warn, fail and worst; `fail` is the limit. Checked criteria that are not measured here go to
/// CriteriaLimits::not_measured, and criteria that are not in the file are not checked.
/// Throws Error (failure) with one sentence that names the file and what is wrong with it.
QUADRILLE_API CriteriaLimits read_limits(const std::filesystem::path& path);

}  // namespace quadrille
