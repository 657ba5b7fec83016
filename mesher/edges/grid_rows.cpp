/// Follows prescribed divisions from edge to opposite edge.

#include "mesher/edges/grid_rows.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace quadrille {

namespace {

/// Largest ratio, either way, between the wanted count of a member of a chord and the count that it gets.
constexpr double largest_row_ratio = 4;

class RowFinder {
 public:
  RowFinder(const CadShape& shape, const FaceOutlines& sides, const PrescribedEdges& prescribed,
            const SizingOptions& options, double size)
      : shape_(shape), sides_(sides), prescribed_(prescribed), options_(options), size_(size) {}

  EdgeFlags run() const {
    EdgeFlags divided(prescribed_.size());
    for (const EdgeId edge : prescribed_.ids())
      divided[edge] = prescribed_[edge] && is_in_grids(edge, *prescribed_[edge]);
    return divided;
  }

 private:
  /// The edge opposite another one across a four-sided face or ring; none if there is no single such edge.
  EdgeId opposite(FaceId face, EdgeId edge) const {
    const FaceSides& sides = sides_[face];
    if (!sides.is_filled()) return {};
    for (const FacingPair& pair : sides.facing) {
      if (pair.first.size() != 1 || pair.second.size() != 1) continue;
      if (pair.first[0].edge == edge) return pair.second[0].edge;
      if (pair.second[0].edge == edge) return pair.first[0].edge;
    }
    return {};
  }

  /// All edges connected to an edge through opposite(); includes none if some face has no opposite edge.
  std::set<EdgeId> chord_of(EdgeId edge) const {
    std::set<EdgeId> chord{edge};
    std::vector<EdgeId> open{edge};
    while (!open.empty()) {
      const EdgeId here = open.back();
      open.pop_back();
      for (const FaceId face : shape_.edges[here].faces) {
        const EdgeId next = opposite(face, here);
        if (chord.insert(next).second && next.exists()) open.push_back(next);
      }
    }
    return chord;
  }

  /// The number of segments that an edge has in any case; 0 = none.
  int fixed_number(EdgeId edge) const {
    const auto& own = prescribed_[edge];
    return own && own->is_fixed() ? own->segments : 0;
  }

  bool is_in_grids(EdgeId edge, const PrescribedEdge& own) const {
    const std::set<EdgeId> chord = chord_of(edge);
    if (!std::all_of(chord.begin(), chord.end(), [](EdgeId member) { return member.exists(); })) return false;
    int segments = own.segments;
    for (const EdgeId member : chord) {
      const int number = own.is_fixed() ? 0 : fixed_number(member);
      if (number > 0) segments = number;
    }
    return std::all_of(chord.begin(), chord.end(), [&](EdgeId member) {
      if (const int number = fixed_number(member)) return number == segments;
      const double size = std::min(size_, value_or(options_.edge_sizes, shape_.edges[member].number, size_));
      const double wanted = std::max(1.0, shape_.edges[member].length / size);
      return segments <= largest_row_ratio * wanted && wanted <= largest_row_ratio * segments;
    });
  }

  const CadShape& shape_;
  const FaceOutlines& sides_;
  const PrescribedEdges& prescribed_;
  const SizingOptions& options_;
  double size_;
};

}  // namespace

EdgeFlags find_grid_rows(const CadShape& shape, const FaceOutlines& sides, const PrescribedEdges& prescribed,
                         const SizingOptions& options, double size) {
  return RowFinder(shape, sides, prescribed, options, size).run();
}

}  // namespace quadrille
