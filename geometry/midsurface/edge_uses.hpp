#pragma once
/// Which faces of a middle surface meet at which edges. Internal.

#include <vector>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/joining.hpp"

namespace quadrille {

/// The faces on each edge that is no point. Edges are counted from 0, in the order of the faces.
class EdgeUses {
 public:
  explicit EdgeUses(const std::vector<JoinedFace>& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const TopoDS_Edge& edge : edges_of(faces[i].face)) {
        const int number = edges_.Add(edge);
        uses_.resize(edges_.Extent());
        uses_[number - 1].push_back({static_cast<int>(i), edge.Orientation()});
      }
    }
  }

  struct Use {
    int face = 0;
    TopAbs_Orientation orientation = TopAbs_FORWARD;
  };
  int count() const { return edges_.Extent(); }
  const TopoDS_Shape& edge(int index) const { return edges_(index + 1); }
  int find(const TopoDS_Shape& edge) const { return edges_.FindIndex(edge) - 1; }  ///< -1 = none
  const std::vector<Use>& uses(int index) const { return uses_[index]; }

 private:
  TopTools_IndexedMapOfShape edges_;
  std::vector<std::vector<Use>> uses_;
};

}  // namespace quadrille
