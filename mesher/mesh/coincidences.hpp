#pragma once
/// Nodes, edges and quads of a mesh that lie on others without being joined to them.

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/base/api.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Where a mesh touches itself without being joined.
struct Coincidences {
  int nodes = 0;                 ///< nodes at the place of an earlier one, no quad of which they share
  int quads = 0;                 ///< quads whose corners lie where those of an earlier quad lie
  std::vector<int> free_edges;   ///< CAD edges with open sides that lie on sides of another edge, ascending
  std::vector<int> faces;        ///< CAD faces with such nodes, ascending
  bool sewing_suffices = false;  ///< all of it is along free edges that lie on free edges
  /// The name of the setting that joins or parts them: "sew"; "imprint"; "keep_features" where quads lie on
  /// quads with the same nodes, since the sides of something thin were suppressed; empty if there are none.
  std::string_view remedy() const;
  /// "38 nodes lie on others ...", with advice(); empty if there are none.
  std::string sentence(const std::set<std::string_view>& tried = {}) const;
};

/// Two nodes are at one place if they are within 1e-7 of the mesh's diagonal, or a 10000th of the median
/// segment. Looks first at the nodes on CAD edges, at all others only if some of those coincide.
/// Time: O(n log n) for n quads, a tenth of a microsecond each.
QUADRILLE_API Coincidences coincidences(const ShellMesh& mesh);

}  // namespace quadrille
