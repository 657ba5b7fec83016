#pragma once
/// Files of middle surfaces. The file's ending determines the format.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "geometry/base/api.hpp"
#include "geometry/midsurface/midsurface.hpp"

namespace quadrille {

/// The data of a middle surface: for each face its area, thickness (mean, least and largest) and the faces of
/// the solid between which it lies, and the results of the checks.
QUADRILLE_API nlohmann::json midsurface_json(const MidSurface& middle);

/// Writes the faces of the middle surface as .brep, .brp, .step or .stp, or midsurface_json() as .json. The
/// file appears whole or not at all. Throws Error: usage for an unknown ending, failure when the file cannot
/// be written.
QUADRILLE_API void write_midsurface(const MidSurface& middle, const std::filesystem::path& path);

/// Throws Error (usage) if write_midsurface() does not know the file's ending.
QUADRILLE_API void check_midsurface_format(const std::filesystem::path& path);

}  // namespace quadrille
