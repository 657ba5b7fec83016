/// Sorts all sides into rows by their lower point (counting sort), where the two uses of a side meet.

#include "mesher/mesh/side_twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

[[noreturn]] void fail(std::size_t t, const std::string& what) {
  throw failure(fmt::format("triangle {}", t), fmt::format("triangle {} {}", t, what));
}

}  // namespace

void check_indices(const TriangleMesh& mesh) {
  const auto points = static_cast<unsigned>(mesh.points.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    for (int v : c) {
      if (static_cast<unsigned>(v) >= points)
        fail(t, fmt::format("refers to point {}, which does not exist", v));
    }
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) fail(t, "has the same point twice");
  }
  if (!mesh.tags.empty() && mesh.tags.size() != mesh.triangles.size()) {
    throw failure(
        "tags", fmt::format("{} tags were given for {} triangles", mesh.tags.size(), mesh.triangles.size()));
  }
}

void check_sides(const TriangleMesh& mesh) {
  const auto from = [&](Side s) { return mesh.triangles[triangle_of(s)][index_of(s)]; };
  const auto to = [&](Side s) { return mesh.triangles[triangle_of(s)][next_index(index_of(s))]; };
  for_each_side_of_tag(mesh, [&](std::span<const Side> sides) {
    if (sides.size() < 2) return;
    const Side side = sides[1];
    if (from(side) == from(sides[0])) {
      fail(triangle_of(side), fmt::format("runs along its side {}-{} the same way as triangle {}", from(side),
                                          to(side), triangle_of(sides[0])));
    }
    if (sides.size() > 2)
      fail(triangle_of(sides[2]),
           fmt::format("is the third on the side {}-{}", from(sides[2]), to(sides[2])));
  });
}

SideRows::SideRows(const TriangleMesh& mesh)
    : mesh_(mesh), tags_(mesh.tags.empty() ? nullptr : mesh.tags.data()), end_(mesh.points.size() + 1, 0) {
  const auto& triangles = mesh.triangles;
  std::vector<int>& start = end_;
  for (const auto& [a, b, c] : triangles) {
    start[a] += a < b;
    start[b] += b < c;
    start[c] += c < a;
  }
  for (int& s : start) rising += std::exchange(s, rising);
  ups.resize(rising + at_once);
  down.resize(3 * triangles.size() - rising + 1);
  // No branch on the direction of a side: it would be unpredictable. Entries that are not to be kept are
  // written too, where later ones overwrite them. Each start moves to the end of its row.
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][next_index(i)];
      const bool rises = a < b;
      const int place = rises ? start[a] : rising;
      start[a] += rises;
      ups[place] = {b, make_side(t, i)};
      down[falling] = make_side(t, i);
      falling += !rises;
    }
  }
}

bool SideRows::repeated(std::span<Side> lone) const {
  const auto& triangles = mesh_.triangles;
  for (int place = 0; place < rising; ++place) {
    if (ups[place].side < 0) continue;
    // Of two sides with the same direction, at least one has no twin.
    const int t = triangle_of(ups[place].side), p = triangles[t][index_of(ups[place].side)];
    const int same = find(begin(p), p, ups[place].to, t);
    if (same != place || find(place + 1, p, ups[place].to, t) < end(p)) return true;
  }
  const auto key = [&](Side s) {
    const int t = triangle_of(s), i = index_of(s);
    return std::make_tuple(triangles[t][i], triangles[t][next_index(i)], tags_ ? tags_[t] : 0);
  };
  std::sort(lone.begin(), lone.end(), [&](Side a, Side b) { return key(a) < key(b); });
  return std::adjacent_find(lone.begin(), lone.end(), [&](Side a, Side b) { return key(a) == key(b); }) !=
         lone.end();
}

}  // namespace quadrille
