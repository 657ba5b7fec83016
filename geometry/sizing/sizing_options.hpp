#pragma once
/// What size is wanted where.

#include <filesystem>
#include <limits>
#include <map>

namespace quadrille {

/// What one run may make, so that no setting and no damaged file takes all memory. Estimated before anything
/// is made, and counted while it is.
struct Budget {
  double elements = 50e6;  ///< the most
  double segments = 5e6;   ///< of all edges
  double blocks = 4e5;     ///< of 512 voxels (2.1 kB) in the sizing field
  /// What an element takes at most while it is made, as measured on parts of half a million; all of them must
  /// fit into the memory that is free.
  double bytes_an_element = bytes_an_element_of_order(1);

  /// Memory that an element takes while it is made.
  static constexpr double bytes_an_element_of_order(int order) { return order == 2 ? 500 : 200; }
  /// One that nothing passes.
  static Budget unlimited() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, infinity, 0};
  }
};

/// The size wanted, by source; the smallest wins, and the result varies no faster than `growth`.
struct SizingOptions {
  double size = 0;                     ///< global target edge length; 0 = diagonal / elements_per_diagonal
  double elements_per_diagonal = 60;   ///< of the model's box
  double size_min = 0;                 ///< no source goes below this; 0 = size / 8
  double elements_per_circle = 12;     ///< elements per 2 pi of curvature; 0 = curvature is ignored
  double growth = 0.3;                 ///< gradation: largest |grad size|
  std::map<int, double> face_sizes;    ///< CAD face -> size on it
  std::map<int, double> edge_sizes;    ///< CAD edge -> size on it
  std::map<int, double> vertex_sizes;  ///< CAD vertex -> size at it
  std::filesystem::path size_field;    ///< external .vdb grid that caps the size; empty = none
  Budget budget;                       ///< what may be spent
};

}  // namespace quadrille
