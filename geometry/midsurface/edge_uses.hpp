#pragma once
/// Which faces of a middle surface meet at which edges. Internal.

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <vector>

#include "geometry/midsurface/joining.hpp"

namespace quadrille {

/// The faces on each edge that is no point. Edges are counted from 0, in the order of the faces.
class EdgeUses {
 public:
  explicit EdgeUses(const std::vector<JoinedFace>& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (TopExp_Explorer it(faces[i].face, TopAbs_EDGE); it.More(); it.Next()) {
        if (BRep_Tool::Degenerated(TopoDS::Edge(it.Current()))) continue;
        const int edge = edges_.Add(it.Current());
        uses_.resize(edges_.Extent());
        uses_[edge - 1].push_back({static_cast<int>(i), it.Current().Orientation()});
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
