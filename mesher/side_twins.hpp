#pragma once
/// Which sides of a triangle mesh are the same. Internal.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/error.hpp"
#include "mesher/mesh_types.hpp"

namespace quadrille {

/// A side of a triangle as 4 * triangle + i, i = 0, 1, 2: from corner i to corner i + 1. -1 = none.
using Side = std::int32_t;

inline Side make_side(int triangle, int i) {
  return 4 * triangle + i;
}
inline int triangle_of(Side side) {
  return side >> 2;
}
inline int index_of(Side side) {
  return side & 3;
}
inline int next_index(int i) {
  return i == 2 ? 0 : i + 1;
}
inline int previous_index(int i) {
  return i == 0 ? 2 : i - 1;
}

/// Throws Error (failure) naming the triangle where indices are out of range or repeated.
void check_indices(const TriangleMesh& mesh);

/// Calls join(side, twin) once for each side that two triangles of one tag share.
/// Throws Error (failure) naming the triangle where more than two triangles of a tag share a side, or where
/// two of them run along it the same way. Time and memory: linear (a counting sort of the sides over their
/// lower point).
template <class Join>
void join_twins(const TriangleMesh& mesh, Join&& join) {
  struct Entry {
    std::int32_t other;  // the higher point
    Side side;
  };
  const auto& triangles = mesh.triangles;
  const auto fail = [&](Side side, const std::string& what) {
    throw failure(fmt::format("triangle {}", triangle_of(side)),
                  fmt::format("triangle {} {}", triangle_of(side), what));
  };
  const auto from = [&](Side s) { return triangles[triangle_of(s)][index_of(s)]; };
  const auto to = [&](Side s) { return triangles[triangle_of(s)][next_index(index_of(s))]; };
  const auto for_each_side = [&](auto&& visit) {
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
      for (int i = 0; i < 3; ++i) visit(make_side(t, i), triangles[t][i], triangles[t][next_index(i)]);
    }
  };

  std::vector<int> start(mesh.points.size() + 1, 0);
  for_each_side([&](Side, int a, int b) { ++start[std::min(a, b)]; });
  int total = 0;
  for (int& s : start) total += std::exchange(s, total);
  std::vector<Entry> entries(total);
  for_each_side([&](Side side, int a, int b) { entries[start[std::min(a, b)]++] = {std::max(a, b), side}; });

  // start[p] is now the end of p's bucket. The sides of one bucket are few: all pairs are compared.
  const bool tagged = !mesh.tags.empty();
  for (int p = 0, first = 0; p + 1 < static_cast<int>(start.size()); first = start[p++]) {
    for (int k = first; k < start[p]; ++k) {
      const auto [other, side] = entries[k];
      int twins = 0;
      for (int l = first; l < k; ++l) {
        const Side twin = entries[l].side;
        if (entries[l].other != other) continue;
        if (tagged && mesh.tags[triangle_of(side)] != mesh.tags[triangle_of(twin)]) continue;
        if (++twins == 2) fail(side, fmt::format("is the third on the side {}-{}", from(side), to(side)));
        if (from(side) == from(twin)) {
          fail(side, fmt::format("runs along its side {}-{} the same way as triangle {}", from(side),
                                 to(side), triangle_of(twin)));
        }
        join(side, twin);
      }
    }
  }
}

}  // namespace quadrille
