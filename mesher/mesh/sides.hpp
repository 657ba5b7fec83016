#pragma once
/// The sides of triangles and quads, and which elements share them. Internal.

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/base/rows.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

/// A side of an element as 4 * element + i: from corner i to the next corner. It also stands for that corner.
/// -1 = none.
using Side = std::int32_t;

inline Side make_side(int element, int i) {
  return 4 * element + i;
}
inline int element_of(Side side) {
  return side >> 2;
}
inline int index_of(Side side) {
  return side & 3;
}

/// An element with other numbers for its nodes.
template <class Element, class Numbers>
Element with_numbers(Element element, const Numbers& numbers) {
  for (int& node : element) node = numbers[node];
  return element;
}

/// For loops that are too short to be cancelled.
inline constexpr auto no_check = [] {};

/// The corners at each node. \param check called once for each element, and twice in all
template <std::size_t n, class Check = decltype(no_check)>
Rows<Side> corners_by_node(std::size_t nodes, const std::vector<std::array<int, n>>& elements,
                           Check check = no_check) {
  return Rows<Side>(nodes, [&](auto&& add) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      check();
      for (std::size_t i = 0; i < n; ++i)
        add(elements[e][i], make_side(static_cast<int>(e), static_cast<int>(i)));
    }
  });
}

/// Calls visit(low, high, sides) once for each pair of nodes that sides join, in ascending order: `sides` are
/// all of them, ascending. Sorts the few sides of each node; memory: linear.
/// \param check called once for each side, and twice in all
/// \param lists of elements as arrays of their nodes; they are numbered through all lists
template <class Check, class Visit, class... Lists>
void for_each_shared_side(std::size_t nodes, Check check, Visit&& visit, const Lists&... lists) {
  struct End {
    int high;
    Side side;
    auto operator<=>(const End&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  Rows<End> rows(nodes, [&](auto&& add) {
    int element = 0;
    const auto add_list = [&](const auto& elements) {
      for (const auto& corners : elements) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
          check();
          const int a = corners[i], b = corners[(i + 1) % corners.size()];
          add(std::min(a, b), End{std::max(a, b), make_side(element, static_cast<int>(i))});
        }
        ++element;
      }
    };
    (add_list(lists), ...);
  });
  std::vector<Side> group;
  for (std::size_t low = 0; low < nodes; ++low) {
    const std::span<End> ends = rows[low];
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      group.push_back(ends[i].side);
      if (i + 1 < ends.size() && ends[i + 1].high == ends[i].high) continue;
      visit(static_cast<int>(low), ends[i].high, std::span<const Side>(group));
      group.clear();
    }
  }
}

/// The sides of only one element: how many there are, and how long they are together.
struct Rim {
  int sides = 0;
  double length = 0;
};

/// \param lists of elements as arrays of their nodes
template <class... Lists>
Rim rim_of(const std::vector<Vector3>& points, const Lists&... lists) {
  Rim rim;
  for_each_shared_side(
      points.size(), no_check,
      [&](int low, int high, std::span<const Side> sides) {
        if (sides.size() != 1) return;
        ++rim.sides;
        rim.length += (points[high] - points[low]).norm();
      },
      lists...);
  return rim;
}

}  // namespace quadrille
