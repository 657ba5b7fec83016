#pragma once
/// Options of each stage, with their defaults.

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

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

enum class Strategy {
  direct,    ///< triangles at the target size, paired into quads
  subdivide  ///< triangles at twice the size, paired, each quad split into four
};

/// What the exchange of pairs is after.
enum class Objective {
  regular,  ///< points with four quads first: what clean-up and smoothing make the most of
  shape  ///< the greatest mean q as the points stand, irregular points only next: three to eight times slower
};

struct RecombineOptions {
  bool paper_mode =
      false;  ///< the algorithm of the 2018 paper as it stands: colour, swap, remove; no improvement
  std::uint64_t seed = 1;  ///< of the random choices (paper mode)
  bool pair_rest =
      true;              ///< paper mode: pair what the colour leaves; false: leave it at the boundary, as the
                         ///< paper does before it collapses those triangles (collapse_boundary_triangles())
  bool exchange = true;  ///< exchange along alternating cycles and paths where angles or valence gain
  Objective objective = Objective::regular;  ///< of the exchange
};

struct ImproveOptions {
  bool clean_up = true;  ///< quad-vertex merge, doublet collapse, valence-driven moves
  int smoothing_sweeps = 8;
  double q_floor = 0.25;  ///< elements below this are worked on one by one at the end
};

struct MeshOptions {
  SizingOptions sizing;
  Strategy strategy = Strategy::subdivide;
  int order = 1;           ///< 1 or 2
  std::vector<int> faces;  ///< CAD faces to mesh; empty = all
  /// Edges shorter than this become points, and faces narrower than this between two edges become edges; 0 =
  /// all are kept.
  double merge_tiny = 0;
  bool partial = false;  ///< deliver what could be meshed when a face fails, instead of throwing
  std::filesystem::path write_size_field;  ///< .vdb to write the sizing field to; empty = none
  bool force = false;                      ///< go on where the mesh would pass 50 million elements
  RecombineOptions recombine;
  ImproveOptions improve;
};

}  // namespace quadrille
