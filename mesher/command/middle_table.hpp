#pragma once
/// What is known of a middle surface, as text.

#include <string>

#include "geometry/midsurface/midsurface.hpp"

namespace quadrille::command {

/// A line for each face with its area, its thickness and the faces of the solid that it lies between; area
/// times thickness over the volume, with and without what is counted twice; the numbers of parts, solids and
/// free edges; and the faces of the solid that belong to no wall.
std::string middle_table(const MidSurface& middle);

}  // namespace quadrille::command
