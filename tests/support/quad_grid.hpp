#pragma once
/// Grids of quads, and what of a mesh's topology must not change.

#include <set>
#include <utility>

#include "mesher/quads/improve.hpp"

namespace quadrille::testing {

using SideSet = std::set<std::pair<int, int>>;

/// The sides with one element, as that element runs them.
inline SideSet open_sides(const QuadMesh& mesh) {
  SideSet sides;
  const auto meet = [&](int a, int b) {
    if (!sides.erase({b, a})) sides.insert({a, b});
  };
  for (const auto& q : mesh.quads)
    for (int k = 0; k < 4; ++k) meet(q[k], q[(k + 1) & 3]);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) meet(t[k], t[(k + 1) % 3]);
  return sides;
}

/// Points minus sides plus elements: no hole opened, none closed.
inline int euler(const QuadMesh& mesh) {
  const int open = static_cast<int>(open_sides(mesh).size());
  const int sides = (4 * static_cast<int>(mesh.quads.size()) + open) / 2;
  return static_cast<int>(mesh.points.size()) - sides + static_cast<int>(mesh.quads.size());
}

/// A grid of squares in the plane, its rim fixed.
inline SurfaceMesh grid(int columns, int rows) {
  SurfaceMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      mesh.mesh.points.push_back({double(i), double(j), 0});
      mesh.parameters.push_back({double(i), double(j)});
      mesh.normals.push_back({0, 0, 1});
      mesh.fixed.push_back(i == 0 || j == 0 || i == columns || j == rows);
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      mesh.mesh.quads.push_back({a, a + 1, a + columns + 2, a + columns + 1});
    }
  return mesh;
}

}  // namespace quadrille::testing
