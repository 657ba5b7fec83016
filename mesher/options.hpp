#pragma once
/// The options of a whole run: those of each stage, and what concerns them all.

#include <filesystem>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

enum class Strategy {
  direct,    ///< triangles at the target size, paired into quads
  subdivide  ///< triangles at twice the size, paired, each quad split into four
};

/// Segments of an edge for each one that its face is paired with: subdivision halves them.
inline int stride(Strategy strategy) {
  return strategy == Strategy::subdivide ? 2 : 1;
}

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
