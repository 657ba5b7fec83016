#pragma once
/// What size is wanted where.

#include <filesystem>
#include <map>

namespace quadrille {

/// The size wanted, by source; the smallest wins, and the result varies no faster than `growth`.
struct SizingOptions {
  double size = 0;  ///< global target edge length; 0 = diagonal / elements_per_diagonal
  double elements_per_diagonal = 60;
  double size_min = 0;                 ///< no source goes below this; 0 = size / 8
  double elements_per_circle = 12;     ///< elements per 2 pi of curvature; 0 = curvature is ignored
  double growth = 0.3;                 ///< gradation: largest |grad size|
  std::map<int, double> face_sizes;    ///< CAD face -> size on it
  std::map<int, double> edge_sizes;    ///< CAD edge -> size on it
  std::map<int, double> vertex_sizes;  ///< CAD vertex -> size at it
  std::filesystem::path size_field;    ///< external .vdb grid that caps the size; empty = none
};

}  // namespace quadrille
