#pragma once
/// The options of a whole run: those of each stage, and those that concern all stages.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"
#include "mesher/mesh/inp_element.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// How faces are meshed.
enum class Strategy {
  direct,    ///< triangles at the target size, paired into quads
  subdivide  ///< triangles at twice the size, paired, each quad split into four
};

/// Final edge segments per segment of the triangulation that is paired: subdivision halves each segment.
inline int stride(Strategy strategy) {
  return strategy == Strategy::subdivide ? 2 : 1;
}

/// The version of Gmsh's .msh format; both are written as text.
enum class MshVersion { v2_2, v4_1 };

/// The kinds of CAD entities whose elements make groups in mesh files.
struct GroupKinds {
  bool faces = true;     ///< shell elements: Face3
  bool edges = true;     ///< lines on CAD edges: Edge7; without them the files have no lines
  bool vertices = true;  ///< nodes, and points if the format has them: Vertex2; without them no points
};

/// What mesh files contain.
struct WriteOptions {
  MshVersion msh_version = MshVersion::v2_2;  ///< version of .msh files
  GroupKinds groups;                          ///< groups that are written
  int quad_nodes = 8;                      ///< nodes of a second-order quad: 8, or 9 with one in the middle
  InpElement element = InpElement::shell;  ///< type of the quads in .inp files
  double scale = 1;   ///< of all lengths in the files, thicknesses too: 0.001 writes meters
  std::string title;  ///< for formats with a comment or title line; control characters are written as '?'
  int threads = 0;    ///< threads that format files of text; 0 = all cores
};

class SizingField;
struct ShellMesh;

/// How a model is meshed.
struct MeshOptions {
  SizingOptions sizing;                     ///< element sizes
  Strategy strategy = Strategy::subdivide;  ///< strategy for all faces
  int order = 1;                            ///< element order, 1 or 2
  std::vector<int> faces;                   ///< CAD faces to mesh; empty = all
  /// Edges shorter than this become points, and faces narrower than this between two edges become edges; 0 =
  /// all are kept.
  double merge_tiny = 0;
  /// Edges shorter and faces narrower than this are suppressed where that does no harm
  /// (ShellMesh::suppressed_features); 0 = half the least size.
  double reach = 0;
  /// Holes, pockets and bosses that are no wider than this are left out (ShellMesh::filled_holes); 0 = none.
  double fill_holes = 0;
  /// Mesh edges and slivers below the reach too, instead of suppressing them
  /// (ShellMesh::suppressed_features).
  bool keep_features = false;
  int rings = 1;         ///< most rings of quads around each hole without corners
  bool partial = false;  ///< deliver what could be meshed when a face fails, instead of throwing
  /// Refuse a face that has no valid mesh on its surface, instead of delivering it with nodes up to the least
  /// size off it (ShellMesh::off_geometry).
  bool strict = false;
  /// Warn if the area of a curved face differs from the CAD face, which takes up to 4 % of the work. Plane
  /// faces are always compared, since a difference there can end the run.
  bool check_curved_areas = true;
  std::filesystem::path write_size_field;  ///< .vdb file for the sizing field; empty = not written
  /// Called once with the mesh and its sizing field, which are valid only during the call. Empty = not
  /// called.
  std::function<void(const ShellMesh&, const SizingField&)> inspect;
  bool force = false;          ///< mesh even if there would be more than 50 million elements
  RecombineOptions recombine;  ///< how triangles are paired
  ImproveOptions improve;      ///< how quads are improved
};

}  // namespace quadrille
