#pragma once
/// Meshes from anywhere as one triangulation, ready to be worked on. Internal.

#include <array>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// The triangles of a mesh, and its quads as two each.
struct TriangleInput {
  TriangleMesh mesh;                      ///< oriented alike within each face; tags are faces, 0 = none
  std::vector<int> node;                  ///< node of the input -> point of the mesh; -1 = of no triangle
  std::vector<std::array<int, 2>> sides;  ///< that are segments of the input
};

/// Merges nodes, cuts quads in two, turns triangles, and puts large meshes into an order that caches like.
/// \param merge as FromTrianglesOptions::merge. \param notes takes a sentence for each thing that was mended.
/// Throws Error (failure) naming the element at fault: no finite position, two nodes on one place, no area,
/// one side only, a triangle twice. O(n log n).
TriangleInput triangle_input(const ShellMesh& input, double merge, std::vector<std::string>& notes,
                             const ExecutionContext& context);

}  // namespace quadrille
