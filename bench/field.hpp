#pragma once
/// Memory and time of sizing fields, level by level.

#include <string>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// Prints a table for the field of each model. Without models: of a plate 1 m long with a fillet of 0.1 mm
/// along an edge, with twelve elements per circle: sizes 1:300, on a part of 1:10 000.
/// \param options size_min 0 = 0.05 mm for the plate, the default of meshes for models.
void print_fields(const std::vector<std::string>& models, const SizingOptions& options, int threads,
                  int repeat);

}  // namespace quadrille
