#pragma once
/// Which faces of a middle surface meet at which edges. Internal.

#include <iterator>
#include <vector>

#include "geometry/cad/shape_parts.hpp"
#include "geometry/midsurface/joining.hpp"

namespace quadrille {

/// The faces on each edge that is no point, in the order of the faces.
class EdgeUses {
 public:
  struct Use {
    int face = 0;
    TopAbs_Orientation orientation = TopAbs_FORWARD;
  };
  struct UsedEdge {
    TopoDS_Edge edge;
    std::vector<Use> uses;
  };

  explicit EdgeUses(const std::vector<JoinedFace>& faces) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const TopoDS_Edge& edge : edges_of(faces[i].face)) {
        const int number = numbers_.Add(edge);
        if (number > std::ssize(edges_)) edges_.push_back({edge, {}});
        edges_[number - 1].uses.push_back({static_cast<int>(i), edge.Orientation()});
      }
    }
  }

  auto begin() const { return edges_.begin(); }
  auto end() const { return edges_.end(); }
  /// Null if no face uses the edge.
  const std::vector<Use>* find(const TopoDS_Shape& edge) const {
    const int number = numbers_.FindIndex(edge);
    return number > 0 ? &edges_[number - 1].uses : nullptr;
  }

 private:
  TopTools_IndexedMapOfShape numbers_;
  std::vector<UsedEdge> edges_;
};

}  // namespace quadrille
