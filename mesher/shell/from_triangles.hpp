#pragma once
/// Meshes of triangles, and of triangles and quads, made all-quad: without a CAD model.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"

namespace quadrille {

/// How quads_from_triangles() works.
struct FromTrianglesOptions {
  /// Nodes at most this far apart become one, millimeters; 0 = those on one place; negative = none, and two
  /// on one place are refused.
  double merge = -1;
  /// Degrees: no quad reaches over a side at which the normals differ by more; 0 = none is kept for that.
  double feature_angle = 40;
  bool improve = true;         ///< clean up and smooth; else nodes stay where they are
  RecombineOptions recombine;  ///< how triangles are paired
};

/// Quads in place of the triangles of a mesh; its quads are cut in two first. Sides between faces, sides that
/// are segments of the mesh, and sides with more than two elements stay, as do nodes on them and nodes that
/// are corners or in groups of nodes. Groups hold what they held: where a group of nodes has all nodes of a
/// face, it has those of the quads there. Elements that run the other way round than most of their face are
/// turned. Where the mesh has no faces, those that the feature angle makes are numbered from 1. The result is
/// of first order. \param notes takes a sentence for each thing that was mended or lost. Throws Error:
/// failure naming the element at fault (indices from 0 as in the mesh), cancelled. Linear in practice.
QUADRILLE_API ShellMesh quads_from_triangles(const ShellMesh& input, const FromTrianglesOptions& options,
                                             std::vector<std::string>& notes, ExecutionContext& context);

}  // namespace quadrille
