#pragma once
/// The options of a whole run: those of each stage, and what concerns them all.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// How faces are meshed.
enum class Strategy {
  direct,    ///< triangles at the target size, paired into quads
  subdivide  ///< triangles at twice the size, paired, each quad split into four
};

/// Segments of an edge for each one that its face is paired with: subdivision halves them.
inline int stride(Strategy strategy) {
  return strategy == Strategy::subdivide ? 2 : 1;
}

/// Of Gmsh's .msh, both as text.
enum class MshVersion { v2_2, v4_1 };

/// The kinds of CAD entities whose elements make groups in mesh files.
struct GroupKinds {
  bool faces = true;     ///< shell elements: Face3
  bool edges = true;     ///< lines on CAD edges: Edge7; without them the files have no lines
  bool vertices = true;  ///< nodes, and points where the format has them: Vertex2; without them no points
};

/// What files hold.
struct WriteOptions {
  MshVersion msh_version = MshVersion::v2_2;  ///< of .msh files
  GroupKinds groups;                          ///< that files have
  int quad_nodes = 8;                         ///< of second-order quads: 8, or 9 with one in the middle
  std::string title;  ///< put into formats that have a comment or title line, control characters as '?'
  int threads = 0;    ///< that make the text of .msh, .inp, .unv, .bdf and .vtk; 0 = all cores
};

class SizingField;
struct ShellMesh;

/// How a model is meshed.
struct MeshOptions {
  SizingOptions sizing;                     ///< lengths of elements
  Strategy strategy = Strategy::subdivide;  ///< of all faces
  int order = 1;                            ///< 1 or 2
  std::vector<int> faces;                   ///< CAD faces to mesh; empty = all
  /// Edges shorter than this become points, and faces narrower than this between two edges become edges; 0 =
  /// all are kept.
  double merge_tiny = 0;
  /// Mesh all edges and slivers below half the least size, where they would be let go (ShellMesh::let_go).
  bool keep_features = false;
  int rings = 1;          ///< of quads round each hole without corners, at most
  bool symmetry = false;  ///< mesh one side of the model's mirror planes and copy its mirror images
  bool partial = false;   ///< deliver what could be meshed when a face fails, instead of throwing
  std::filesystem::path write_size_field;  ///< .vdb to write the sizing field to; empty = none
  /// Called once with the mesh and the sizes that it was made with, which end with the call; with `symmetry`
  /// those of the part that was meshed. Empty = nothing.
  std::function<void(const ShellMesh&, const SizingField&)> inspect;
  bool force = false;          ///< go on where the mesh would pass 50 million elements
  RecombineOptions recombine;  ///< how triangles are paired
  ImproveOptions improve;      ///< how quads are improved
};

}  // namespace quadrille
