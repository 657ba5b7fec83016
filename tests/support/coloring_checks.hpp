#pragma once
/// What must hold of an edge coloring.

#include <fmt/format.h>

#include <string>

#include "mesher/pairing/edge_coloring.hpp"

namespace quadrille::testing {

/// What is wrong with a coloring, naming the triangle: neighbors that do not refer to each other, or an edge
/// to which its two triangles give different colors. Empty if nothing is wrong. No color can occur twice in a
/// triangle, since each has only one place there.
inline std::string validate(const EdgeColoring& coloring) {
  for (int t = 0; t < coloring.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i), twin = coloring.twin(side);
      if (twin < 0) continue;
      if (triangle_of(twin) >= coloring.size() || coloring.twin(twin) != side)
        return fmt::format("triangle {} is not a neighbor of its neighbor {}", t, triangle_of(twin));
      if (coloring.color(twin) != coloring.color(side))
        return fmt::format("triangles {} and {} give the edge between them the colors {} and {}", t,
                           triangle_of(twin), coloring.color(side), coloring.color(twin));
    }
  }
  return {};
}

/// The number of edges without a color.
inline int count_blanks(const EdgeColoring& coloring) {
  int count = 0;
  for (int t = 0; t < coloring.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i), twin = coloring.twin(side);
      count += (twin < 0 || twin > side) && coloring.color(side) == EdgeColoring::blank;
    }
  }
  return count;
}

}  // namespace quadrille::testing
