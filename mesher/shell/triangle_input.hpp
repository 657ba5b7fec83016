#pragma once
/// Converts meshes of any origin into one clean triangulation. Internal.

#include <array>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The triangles of a mesh, with each of its quads cut into two.
struct TriangleInput {
  TriangleMesh mesh;                      ///< consistently oriented in each face; tags are faces, 0 = none
  std::vector<int> node;                  ///< node of the input -> point of the mesh; -1 = left out
  std::vector<std::array<int, 2>> sides;  ///< sides that are segments of the input
};

/// Merges nodes, cuts quads in two, orients triangles, and reorders large meshes for the caches, without the
/// nodes that no triangle uses. \param merge as FromTrianglesOptions::merge.
/// \param least nodes at most this far apart are merged in any case, after places are checked; 0 = none.
/// \param notes out, one sentence for each repair is appended. Throws Error (failure) naming the element at
/// fault: a node without a finite position, two nodes at the same position, no area, a one-sided surface, two
/// equal triangles. O(n log n).
TriangleInput triangle_input(const ShellMesh& input, double merge, double least,
                             std::vector<std::string>& notes, const ExecutionContext& context);

}  // namespace quadrille
