#pragma once
/// Turns meshes of triangles, or of triangles and quads, into all-quad meshes, without a CAD model.

#include <string>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/pairing/recombine_options.hpp"

namespace quadrille {

/// How quads_from_triangles() works.
struct FromTrianglesOptions {
  /// Nodes at most this far apart are merged, millimeters; 0 = only nodes at the same position; negative =
  /// none, and two nodes at the same position are refused.
  double merge = -1;
  /// No quad extends across a side where the normals differ by more than this, degrees; 0 = no such sides.
  double feature_angle = 40;
  bool improve = true;         ///< clean up and smooth; if false, nodes stay where they are
  RecombineOptions recombine;  ///< how triangles are paired
};

/// Replaces the triangles of a mesh by quads. Quads of the input are first cut in two. Sides between faces,
/// segments of the mesh, and sides with more than two elements stay, with their nodes. So do nodes that are
/// corners or in groups of nodes. Groups keep their extent: a group of nodes with all nodes of a face gets
/// all nodes of the quads there. Elements oriented against the majority of their connected face are reversed.
/// If the mesh has no faces, those that the feature angle separates are numbered from 1. The result is first
/// order. \param notes out, one sentence for each repair or loss is appended. Throws Error: failure naming
/// the element at fault (indices from 0 as in the mesh), cancelled. Linear in practice.
QUADRILLE_API ShellMesh quads_from_triangles(const ShellMesh& input, const FromTrianglesOptions& options,
                                             std::vector<std::string>& notes, ExecutionContext& context);

}  // namespace quadrille
