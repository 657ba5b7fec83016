#pragma once
/// Finds the sides that two triangles of a mesh share. Internal.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

inline int triangle_of(Side side) {
  return element_of(side);
}
inline int next_index(int i) {
  return i == 2 ? 0 : i + 1;
}
inline int previous_index(int i) {
  return i == 0 ? 2 : i - 1;
}

/// Calls visit(sides) once for each two points and tag that sides have in common: all of these, ascending.
template <class Visit>
void for_each_side_of_tag(const TriangleMesh& mesh, Visit&& visit) {
  const auto tag_of = [&](Side side) { return mesh.tags.empty() ? 0 : mesh.tags[triangle_of(side)]; };
  std::vector<Side> by_tag;
  const auto split = [&](int, int, std::span<const Side> sides) {
    by_tag.assign(sides.begin(), sides.end());
    std::stable_sort(by_tag.begin(), by_tag.end(), [&](Side a, Side b) { return tag_of(a) < tag_of(b); });
    for (auto at = by_tag.begin(), end = at; at != by_tag.end(); at = end) {
      while (end != by_tag.end() && tag_of(*end) == tag_of(*at)) ++end;
      visit(std::span<const Side>(at, end));
    }
  };
  for_each_shared_side(mesh.points.size(), no_check, split, mesh.triangles);
}

/// Throws Error (failure) for indices out of range or repeated, naming the triangle, or a wrong count of
/// tags.
void check_indices(const TriangleMesh& mesh);

/// Throws Error (failure) naming a triangle that is the third of its tag on a side, or that runs along a side
/// in the same direction as another of its tag. Slower than join_twins(), which calls it on such errors.
void check_sides(const TriangleMesh& mesh);

/// The sides of a triangle mesh in rows. Sides that rise, to a point of higher index, are sorted by their
/// lower point. Sides that fall are in the order of the mesh. A counting sort: linear time and memory.
class SideRows {
 public:
  struct Up {
    int to;
    Side side;  ///< bitwise complement once it has a twin
  };

  explicit SideRows(const TriangleMesh& mesh);

  /// The first index >= `from` in the row of `point` of a side that rises to `to` and has triangle `t`'s tag;
  /// the end of the row if there is none.
  int find(int from, int point, int to, int t) const {
    const int end = end_[point];
    for (; from < end; from += at_once) {
      // No branch for each entry: it would be unpredictable.
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

  /// Whether a side has the same direction as another of its tag or is the third of its tag. Looks at rising
  /// sides, and at `lone`: falling sides that found no twin. Sorts `lone`.
  bool repeated(std::span<Side> lone) const;

  std::vector<Up> ups;     ///< `rising` entries, and padding for reads beyond them
  std::vector<Side> down;  ///< `falling` entries, and one spare
  int rising = 0, falling = 0;

 private:
  static constexpr int at_once = 8;

  const TriangleMesh& mesh_;
  const int* tags_;
  std::vector<int> end_;  ///< end of each point's row in `ups`
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

/// The side of the other triangle at each side, by triangle and side; -1 = none.
using Twins = std::vector<std::array<Side, 3>>;

/// Numbers the pieces that triangles form across sides, from 0. \param twin_of (side) the side across which a
/// piece continues there; -1 = none \param pieces out: piece of each triangle. \return their number.
template <class TwinOf>
int number_pieces(std::size_t triangles, TwinOf&& twin_of, std::vector<int>& pieces) {
  pieces.assign(triangles, -1);
  int count = 0;
  std::vector<int> waiting;
  for (int seed = 0; seed < static_cast<int>(triangles); ++seed) {
    if (pieces[seed] >= 0) continue;
    pieces[seed] = count;
    waiting.push_back(seed);
    while (!waiting.empty()) {
      const int t = waiting.back();
      waiting.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Side twin = twin_of(make_side(t, i));
        if (twin < 0 || pieces[triangle_of(twin)] >= 0) continue;
        pieces[triangle_of(twin)] = count;
        waiting.push_back(triangle_of(twin));
      }
    }
    ++count;
  }
  return count;
}

}  // namespace quadrille
