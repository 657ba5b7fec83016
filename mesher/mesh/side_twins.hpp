#pragma once
/// Which sides of a triangle mesh are the same. Internal.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
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

/// The sides of a triangle mesh in rows: those that run up, to a point of higher index, by their lower point;
/// those that run down in the order of the mesh. Made by a counting sort; time and memory linear.
class SideRows {
 public:
  struct Up {
    int to;
    Side side;  ///< its complement once it is taken
  };

  explicit SideRows(const TriangleMesh& mesh);

  /// The first place from `from` on of a side of `point` that rises to `to`, beside triangle `t`'s tag; the
  /// end of the point's row if there is none.
  int find(int from, int point, int to, int t) const {
    const int end = end_[point];
    for (; from < end; from += at_once) {
      // Without a branch on each, which cannot be foreseen.
      unsigned found = 1U << at_once;
      for (int k = 0; k < at_once; ++k) found |= static_cast<unsigned>(ups[from + k].to == to) << k;
      const int place = from + std::countr_zero(found);
      if (place >= std::min(end, from + at_once)) continue;
      const int other = triangle_of(ups[place].side < 0 ? ~ups[place].side : ups[place].side);
      if (!tags_ || tags_[other] == tags_[t]) return place;
      from = place + 1 - at_once;
    }
    return end;
  }
  int begin(int point) const { return point == 0 ? 0 : end_[point - 1]; }
  int end(int point) const { return end_[point]; }

  /// Whether some side runs the same way as another of its tag, or is the third: among those that rise, and
  /// among `lone`, sides that run down and found no twin. Sorts `lone`.
  bool repeated(std::span<Side> lone) const;

  std::vector<Up> ups;     ///< `rising` of them, and room to read on
  std::vector<Side> down;  ///< `falling` of them
  int rising = 0, falling = 0;

 private:
  static constexpr int at_once = 8;

  const TriangleMesh& mesh_;
  const int* tags_;
  std::vector<int> end_;  ///< of each point's row
};

/// Calls join(side, twin) once for each side that two triangles of one tag share.
/// Throws Error (failure) as check_sides() does. Time and memory: linear.
template <class Join>
void join_twins(const TriangleMesh& mesh, Join&& join) {
  SideRows rows(mesh);
  bool doubtful = false;
  std::size_t lone = 0;
  for (int d = 0; d < rows.falling; ++d) {
    const Side side = rows.down[d];
    const int t = triangle_of(side), i = index_of(side), p = mesh.triangles[t][next_index(i)];
    const int place = rows.find(rows.begin(p), p, mesh.triangles[t][i], t);
    if (place >= rows.end(p)) {
      rows.down[lone++] = side;
    } else if (rows.ups[place].side < 0) {
      doubtful = true;
    } else {
      join(side, rows.ups[place].side);
      rows.ups[place].side = ~rows.ups[place].side;
    }
  }
  if (doubtful || rows.repeated({rows.down.data(), lone})) check_sides(mesh);
}

}  // namespace quadrille
