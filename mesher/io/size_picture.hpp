#pragma once
/// Pictures of sizes. Part of libquadrille_picture.so.

#include <string>

#include "mesher/size_map.hpp"

namespace quadrille {

/// The bytes of a PNG: on the left the sizes, on the right the governing sources. Empty if VTK cannot draw
/// it. \param width, height pixels.
std::string draw_sizes(const SizeMap& map, int width, int height);

}  // namespace quadrille
