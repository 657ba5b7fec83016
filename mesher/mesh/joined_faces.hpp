#pragma once
/// Which faces of a mesh are taken as one, because quads cross the smooth edges between them. Internal.

#include <algorithm>
#include <map>

#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Finds the faces that ShellMesh::crossed_edges connect. O(n log n) in these edges.
class JoinedFaces {
 public:
  explicit JoinedFaces(const ShellMesh& mesh) {
    for (const auto& edge : mesh.crossed_edges) {
      const int a = first(edge.faces[0]), b = first(edge.faces[1]);
      before_.emplace(a, a);
      before_.emplace(b, b);
      before_[std::max(a, b)] = std::min(a, b);
    }
  }
  /// The lowest number of the faces that are taken as one with a face, which may be its own.
  int first(int face) const {
    for (auto at = before_.find(face); at != before_.end() && at->second != face; at = before_.find(face))
      face = at->second;
    return face;
  }
  /// Whether quads cross an edge of the face.
  bool contains(int face) const { return before_.contains(face); }

 private:
  std::map<int, int> before_;
};

}  // namespace quadrille
