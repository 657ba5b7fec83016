#pragma once
/// Which sides of a triangle mesh are the same. Internal.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"

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

/// The side of the same triangle that starts where a side ends, or ends where it starts.
inline Side next_side(Side side) {
  return make_side(triangle_of(side), next_index(index_of(side)));
}
inline Side previous_side(Side side) {
  return make_side(triangle_of(side), previous_index(index_of(side)));
}

/// Throws Error (failure) naming the triangle where indices are out of range or repeated.
void check_indices(const TriangleMesh& mesh);

/// Throws Error (failure) naming a triangle that is the third of its tag on a side, or runs along a side the
/// same way as another of its tag. Slower than join_twins(), which calls it where something is wrong.
void check_sides(const TriangleMesh& mesh);

/// Calls join(side, twin) once for each side that two triangles of one tag share.
/// Throws Error (failure) as check_sides() does. Time and memory: linear (a counting sort of the sides that
/// run up, to a point of higher index, by their lower point; those that run down are looked up).
template <class Join>
void join_twins(const TriangleMesh& mesh, Join&& join) {
  const auto& triangles = mesh.triangles;
  const int* const tags = mesh.tags.empty() ? nullptr : mesh.tags.data();
  std::vector<int> start(mesh.points.size() + 1, 0);
  for (const auto& [a, b, c] : triangles) {
    start[a] += a < b;
    start[b] += b < c;
    start[c] += c < a;
  }
  int total = 0;
  for (int& s : start) total += std::exchange(s, total);
  // Without a branch on which way a side runs, which cannot be foreseen: what is not to be kept is written as
  // well, where it will be written over.
  constexpr int at_once = 8;
  struct Up {
    int to;
    Side side;
  };
  std::vector<Up> ups(total + at_once);
  std::vector<Side> down(3 * triangles.size() - total + 1);
  std::size_t downs = 0;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][next_index(i)];
      const bool rises = a < b;
      const int place = rises ? start[a] : total;
      start[a] += rises;
      ups[place] = {b, make_side(t, i)};
      down[downs] = make_side(t, i);
      downs += !rises;
    }
  }
  // start[p] is now the end of p's sides. The first place from `from` on of a side of p that rises to a
  // point, in a tag; p's end if there is none.
  const auto find = [&](int from, int p, int to, int t) {
    const int end = start[p];
    for (; from < end; from += at_once) {
      unsigned found = 1U << at_once;
      for (int k = 0; k < at_once; ++k) found |= static_cast<unsigned>(ups[from + k].to == to) << k;
      const int place = from + std::countr_zero(found);
      if (place >= std::min(end, from + at_once)) continue;
      const int other = triangle_of(ups[place].side < 0 ? ~ups[place].side : ups[place].side);
      if (!tags || tags[other] == tags[t]) return place;
      from = place + 1 - at_once;
    }
    return end;
  };
  const auto first_of = [&](int p) { return p == 0 ? 0 : start[p - 1]; };
  bool doubtful = false;
  std::size_t lone = 0;
  for (std::size_t d = 0; d < downs; ++d) {
    const Side side = down[d];
    const int t = triangle_of(side), i = index_of(side), p = triangles[t][next_index(i)];
    const int place = find(first_of(p), p, triangles[t][i], t);
    if (place >= start[p]) {
      down[lone++] = side;
    } else if (ups[place].side < 0) {
      doubtful = true;
    } else {
      join(side, ups[place].side);
      ups[place].side = ~ups[place].side;  // taken
    }
  }
  // Two sides that run the same way: one of them is left alone, if not taken twice above.
  for (int place = 0; place < total && !doubtful; ++place) {
    if (ups[place].side < 0) continue;
    const int t = triangle_of(ups[place].side), p = triangles[t][index_of(ups[place].side)];
    const int same = find(first_of(p), p, ups[place].to, t);
    doubtful = same != place || find(place + 1, p, ups[place].to, t) < start[p];
  }
  const auto key = [&](Side s) {
    const int t = triangle_of(s), i = index_of(s);
    return std::make_tuple(triangles[t][i], triangles[t][next_index(i)], tags ? tags[t] : 0);
  };
  std::sort(&down[0], &down[lone], [&](Side a, Side b) { return key(a) < key(b); });
  for (std::size_t d = 1; d < lone; ++d) doubtful |= key(down[d]) == key(down[d - 1]);
  if (doubtful) check_sides(mesh);
}

}  // namespace quadrille
