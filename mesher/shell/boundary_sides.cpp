/// Counts the uses of sides in quads and in the boundary, and compares the two.

#include "mesher/shell/boundary_sides.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "geometry/base/side_key.hpp"

namespace quadrille {

namespace {

/// A side of a quad, or a side that the boundary requires.
struct SideUse {
  int low, high;
  bool forward;      ///< the quad runs along it from low to high
  int quads, asked;  ///< quads on the side, quads required; one of them is 0
  bool spur;         ///< required by a spur, where no quads are needed
};

void add(std::vector<SideUse>& uses, int a, int b, int quads, int asked, bool spur = false) {
  if (a != b) uses.push_back({std::min(a, b), std::max(a, b), a < b, quads, asked, spur});
}

/// Keys of the sides that the boundary runs along an even number of times, ascending: there and back. Where
/// these lie outside the face, no quad ends on them.
std::vector<std::uint64_t> spurs(const FaceBoundary& boundary) {
  std::vector<std::uint64_t> keys, twice;
  for (const auto& segment : boundary.segments) {
    if (!segment.degenerate) keys.push_back(side_key(boundary.nodes[segment.a], boundary.nodes[segment.b]));
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0, j = 0; i < keys.size(); i = j) {
    while (j < keys.size() && keys[j] == keys[i]) ++j;
    if ((j - i) % 2 == 0) twice.push_back(keys[i]);
  }
  return twice;
}

}  // namespace

std::optional<std::pair<int, int>> wrong_boundary_side(const FaceBoundary& boundary,
                                                       const std::vector<int>& nodes,
                                                       const std::vector<std::array<int, 4>>& quads) {
  std::vector<SideUse> uses;
  const std::vector<std::uint64_t> there_and_back = spurs(boundary);
  for (const auto& segment : boundary.segments) {
    if (segment.degenerate) continue;
    const int a = boundary.nodes[segment.a], b = boundary.nodes[segment.b];
    const bool spur = std::binary_search(there_and_back.begin(), there_and_back.end(), side_key(a, b));
    const int count = segment.internal ? 2 : 1;
    if (segment.middle_node < 0) {
      add(uses, a, b, 0, count, spur);
    } else {
      add(uses, a, segment.middle_node, 0, count, spur);
      add(uses, segment.middle_node, b, 0, count, spur);
    }
  }
  const int fixed = static_cast<int>(nodes.size());
  for (const auto& quad : quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = quad[k], b = quad[(k + 1) % 4];
      if (a < fixed && b < fixed) add(uses, nodes[a], nodes[b], 1, 0);
    }
  }
  std::sort(uses.begin(), uses.end(), [](const SideUse& a, const SideUse& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    int met = 0, forward = 0, asked = 0;
    bool spur = false;
    for (; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high; ++j) {
      met += uses[j].quads;
      forward += uses[j].quads * static_cast<int>(uses[j].forward);
      asked += uses[j].asked;
      spur |= uses[j].spur;
    }
    if (asked == 0) asked = 2;
    const bool ends_there = (met <= asked && met % 2 == asked % 2) || (spur && met == 0);
    if (!ends_there || forward > 1 || met - forward > 1) return std::pair(uses[i].low, uses[i].high);
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
