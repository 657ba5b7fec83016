#pragma once
/// Remeshes triangulated surfaces with quads: scans, .stl files, meshes of other programs.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"
#include "mesher/quads/improve_options.hpp"

namespace quadrille {

/// How remesh() works.
struct RemeshOptions {
  double size = 0;  ///< element size, millimeters
  /// Faces end where the normals of neighbors differ by more than this, degrees; 0 = no faces end at folds.
  double feature_angle = 40;
  /// Nodes at most this far apart are merged, millimeters; 0 = only nodes at the same position; negative =
  /// two nodes at the same position are refused. Those within a millionth of the size are merged always.
  double merge = -1;
  int order = 1;               ///< 1 or 2
  bool force = false;          ///< continue even if the mesh would exceed 50 million elements or the memory
  RecombineOptions recombine;  ///< how triangles are paired
  ImproveOptions improve;      ///< how quads are improved
};

/// How a mesh compares with the surface that it was made from.
struct RemeshFidelity {
  /// A distance and its location.
  struct Distance {
    double length = 0;    ///< millimeters
    Vector3 at{0, 0, 0};  ///< the point at that distance
    int face = 0;         ///< face that the point belongs to, as numbered in the mesh
  };
  /// The point of the mesh farthest from the surface: a node, or the middle of a side or of a quad.
  Distance of_mesh;
  Distance of_surface;  ///< the point of the surface's triangulation farthest from the mesh
  double surface_area = 0 /**< of the input */, mesh_area = 0;  ///< square millimeters
};

/// Makes an all-quad mesh of a triangulated surface, at another size. The surface is cut into faces where the
/// faces of the input end, along its segments, and at folds. Nodes lie on the surface, and on the curves
/// between faces. Faces keep their numbers as far as they stay whole. Groups of faces and of segments keep
/// their extent. Elements become smaller where the surface bends too tightly for the size, and near small
/// faces, down to about an eighth of the size. At second order midside nodes lie on the surface, or on
/// straight sides where an element would fold. \param fidelity out, may be null. \param notes out, one
/// sentence for each repair or loss is appended. Throws Error: usage for invalid options or too many
/// elements; failure naming the place that cannot be meshed (three triangles on one side, a one-sided
/// surface, no area, quads that stay inverted); cancelled. The result does not depend on the thread count.
QUADRILLE_API ShellMesh remesh(const ShellMesh& input, const RemeshOptions& options, RemeshFidelity* fidelity,
                               std::vector<std::string>& notes, ExecutionContext& context);

}  // namespace quadrille
