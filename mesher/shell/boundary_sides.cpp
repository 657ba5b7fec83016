/// Counts the uses of sides in quads and in the boundary, and compares the two.

#include "mesher/shell/boundary_sides.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "geometry/base/side_key.hpp"

namespace quadrille {

std::optional<std::pair<int, int>> wrong_boundary_side(const FaceBoundary& boundary,
                                                       const std::vector<int>& nodes,
                                                       const std::vector<std::array<int, 4>>& quads) {
  struct SideUse {
    int rising = 0, falling = 0;  // quads that run along it to the node of higher index, and to the other
    int asked = 0;                // quads that the boundary requires
    bool spur = false;            // required by a spur, where no quads are needed
  };
  // The boundary runs along spurs an even number of times: there and back. Where these lie outside the face,
  // no quad ends on them.
  std::unordered_map<std::uint64_t, int> runs;
  for (const auto& segment : boundary.segments)
    if (!segment.degenerate) ++runs[side_key(boundary.nodes[segment.a], boundary.nodes[segment.b])];
  std::map<std::pair<int, int>, SideUse> uses;  // sides between two boundary nodes
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate) continue;
    const int a = boundary.nodes[segment.a], b = boundary.nodes[segment.b];
    const int middle = segment.middle_node < 0 ? b : segment.middle_node;
    for (const auto& [from, to] : {std::pair(a, middle), std::pair(middle, b)}) {
      if (from == to) continue;
      SideUse& use = uses[std::minmax(from, to)];
      use.asked += segment.internal ? 2 : 1;
      use.spur |= runs[side_key(a, b)] % 2 == 0;
    }
  }
  const int fixed = static_cast<int>(nodes.size());
  for (const auto& quad : quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      if (a >= fixed || b >= fixed || nodes[a] == nodes[b]) continue;
      SideUse& use = uses[std::minmax(nodes[a], nodes[b])];
      ++(nodes[a] < nodes[b] ? use.rising : use.falling);
    }
  }
  for (const auto& [side, use] : uses) {
    const int met = use.rising + use.falling, asked = use.asked == 0 ? 2 : use.asked;
    const bool ends_there = (met <= asked && met % 2 == asked % 2) || (use.spur && met == 0);
    if (!ends_there || use.rising > 1 || use.falling > 1) return side;
  }
  return std::nullopt;
}

std::optional<std::pair<int, int>> crowded_side(const std::vector<int>& nodes,
                                                const std::vector<std::array<int, 4>>& quads) {
  const int fixed = static_cast<int>(nodes.size());
  // The first of the points at a node stands for all.
  std::unordered_map<int, int> first;
  std::vector<int> point(nodes.size());
  for (int i = 0; i < fixed; ++i) point[i] = first.emplace(nodes[i], i).first->second;
  if (first.size() == nodes.size()) return std::nullopt;  // there is no seam
  std::unordered_map<std::uint64_t, int> uses;
  for (const auto& quad : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      if (a >= fixed && b >= fixed) continue;
      const int from = a < fixed ? point[a] : a, to = b < fixed ? point[b] : b;
      if (++uses[side_key(from, to)] > 2) return std::pair(a, b);
    }
  return std::nullopt;
}

}  // namespace quadrille
