#include "mesher/mesh/side_twins.hpp"

#include <fmt/format.h>

#include <string>

#include "geometry/base/error.hpp"

namespace quadrille {

void check_indices(const TriangleMesh& mesh) {
  const auto fail = [](std::size_t t, const std::string& what) {
    throw failure(fmt::format("triangle {}", t), fmt::format("triangle {} {}", t, what));
  };
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
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int i = 0; i < 3; ++i) sides.push_back(make_side(t, i));
  }
  const auto from = [&](Side s) { return mesh.triangles[triangle_of(s)][index_of(s)]; };
  const auto to = [&](Side s) { return mesh.triangles[triangle_of(s)][next_index(index_of(s))]; };
  const auto key = [&](Side s) {
    return std::make_tuple(std::min(from(s), to(s)), std::max(from(s), to(s)),
                           mesh.tags.empty() ? 0 : mesh.tags[triangle_of(s)]);
  };
  std::sort(sides.begin(), sides.end(), [&](Side a, Side b) {
    return std::tuple_cat(key(a), std::tie(a)) < std::tuple_cat(key(b), std::tie(b));
  });
  const auto fail = [](Side side, const std::string& what) {
    throw failure(fmt::format("triangle {}", triangle_of(side)),
                  fmt::format("triangle {} {}", triangle_of(side), what));
  };
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const Side side = sides[k], twin = sides[k - 1];
    if (key(side) != key(twin)) continue;
    if (k > 1 && key(side) == key(sides[k - 2]))
      fail(side, fmt::format("is the third on the side {}-{}", from(side), to(side)));
    if (from(side) == from(twin)) {
      fail(side, fmt::format("runs along its side {}-{} the same way as triangle {}", from(side), to(side),
                             triangle_of(twin)));
    }
  }
}

}  // namespace quadrille
