#pragma once
/// Memory and time of sizing fields, level by level.

#include <string>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// Prints a table for the field of each model, or, where none is given, of a plate of one meter with a fillet
/// of 0.1 mm along an edge, twelve elements to a circle: sizes 1:300, on a part of 1:10 000.
/// \param options size_min 0 = 0.05 mm for the plate, what meshes have for others.
void print_fields(const std::vector<std::string>& models, const SizingOptions& options, int threads,
                  int repeat);

}  // namespace quadrille
