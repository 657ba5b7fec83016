/// Spreads orientations over pieces, cuts sides by angle and tag, and copies points for each fan around them.

#include "mesher/mesh/surface_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "geometry/base/error.hpp"
#include "geometry/base/side_key.hpp"
#include "mesher/mesh/side_twins.hpp"

namespace quadrille {

namespace {

int from(const TriangleMesh& mesh, Side side) {
  return mesh.triangles[triangle_of(side)][index_of(side)];
}
int to(const TriangleMesh& mesh, Side side) {
  return mesh.triangles[triangle_of(side)][next_index(index_of(side))];
}
int across(const TriangleMesh& mesh, Side side) {
  return mesh.triangles[triangle_of(side)][previous_index(index_of(side))];
}

/// The neighbor across each side that exactly two triangles of a tag share, whatever their orientation.
Twins neighbors(const TriangleMesh& mesh) {
  Twins twins(mesh.triangles.size(), {-1, -1, -1});
  for_each_side_of_tag(mesh, [&](std::span<const Side> group) {
    for (std::size_t i = 0; i < group.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (across(mesh, group[i]) == across(mesh, group[j]))
          throw failure(fmt::format("triangle {}", triangle_of(group[i])),
                        fmt::format("triangle {} has the same corners as triangle {}", triangle_of(group[i]),
                                    triangle_of(group[j])));
    if (group.size() != 2) return;
    twins[triangle_of(group[0])][index_of(group[0])] = group[1];
    twins[triangle_of(group[1])][index_of(group[1])] = group[0];
  });
  return twins;
}

/// Finds which triangles in the piece of `seed` must be reversed to match it.
/// \param turned -1 = not visited yet; out: 1 = to be reversed, 0 = not. \return the triangles of the piece.
std::vector<int> agree_with(int seed, const TriangleMesh& mesh, const Twins& twins,
                            std::vector<char>& turned) {
  std::vector<int> piece{seed};
  turned[seed] = 0;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const int t = piece[k];
    for (int i = 0; i < 3; ++i) {
      const Side twin = twins[t][i];
      if (twin < 0) continue;
      const bool opposite = mesh.triangles[t][i] == to(mesh, twin);
      const char wanted = static_cast<char>(opposite ? turned[t] : 1 - turned[t]);
      char& other = turned[triangle_of(twin)];
      if (other < 0) {
        other = wanted;
        piece.push_back(triangle_of(twin));
      } else if (other != wanted) {
        throw failure(fmt::format("triangle {}", t),
                      fmt::format("triangle {} cannot be oriented to match its neighbors: the surface is "
                                  "one-sided, like a Moebius strip",
                                  t));
      }
    }
  }
  return piece;
}

/// Removes the neighbor relation across sides that are to be cut.
void cut_twins(const TriangleMesh& mesh, double angle, const std::vector<std::array<int, 2>>& sides,
               Twins& twins) {
  std::vector<std::uint64_t> keys;
  std::vector<char> on_side(mesh.points.size(), 0);
  for (const auto& [a, b] : sides) {
    keys.push_back(side_key(a, b));
    on_side[a] = on_side[b] = 1;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Vector3> normals;
  if (angle > 0) {
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3& p = mesh.points[a];
      normals.emplace_back((mesh.points[b] - p).cross(mesh.points[c] - p).normalized());
    }
  }
  const double least = std::cos(angle * std::numbers::pi / 180);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i), twin = twins[t][i];
      if (twin < side) continue;
      const int a = from(mesh, side), b = to(mesh, side);
      const bool folded = angle > 0 && normals[t].dot(normals[triangle_of(twin)]) < least;
      const bool listed =
          on_side[a] && on_side[b] && std::binary_search(keys.begin(), keys.end(), side_key(a, b));
      if (folded || listed) twins[t][i] = twins[triangle_of(twin)][index_of(twin)] = -1;
    }
  }
}

/// Copies each point for every fan of triangles around it but the first.
void split_points(const Twins& twins, CutSurface& surface) {
  TriangleMesh& mesh = surface.mesh;
  std::vector<char> met(mesh.points.size(), 0), done(4 * twins.size(), 0);
  std::vector<Side> fan;  // corners still to be followed
  const auto take = [&](Side corner, int point) {
    if (done[corner]) return;
    done[corner] = 1;
    mesh.triangles[triangle_of(corner)][index_of(corner)] = point;
    fan.push_back(corner);
  };
  for (int t = 0; t < static_cast<int>(twins.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (done[make_side(t, i)]) continue;
      int point = mesh.triangles[t][i];
      if (std::exchange(met[point], 1)) {
        surface.original.push_back(point);
        mesh.points.push_back(Vector3(mesh.points[point]));
        if (!mesh.fixed.empty()) mesh.fixed.push_back(mesh.fixed[point]);
        point = static_cast<int>(mesh.points.size()) - 1;
      }
      take(make_side(t, i), point);
      while (!fan.empty()) {
        const int at = triangle_of(fan.back()), corner = index_of(fan.back());
        fan.pop_back();
        // The same point beyond the side that leaves it and beyond the one that reaches it.
        const Side out = twins[at][corner], in = twins[at][previous_index(corner)];
        if (out >= 0) take(make_side(triangle_of(out), next_index(index_of(out))), point);
        if (in >= 0) take(in, point);
      }
    }
}

}  // namespace

std::vector<int> coincident_points(const std::vector<Vector3>& points, double tolerance) {
  std::vector<int> first(points.size());
  std::iota(first.begin(), first.end(), 0);
  if (!(tolerance > 0)) {
    std::vector<int> order = first;
    const auto place = [&](int v) { return std::tie(points[v].x(), points[v].y(), points[v].z()); };
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::tuple_cat(place(a), std::tie(a)) < std::tuple_cat(place(b), std::tie(b));
    });
    for (std::size_t k = 1; k < order.size(); ++k)
      if (place(order[k]) == place(order[k - 1])) first[order[k]] = first[order[k - 1]];
    return first;
  }
  const auto cell_of = [&](const Vector3& p) {
    std::array<std::int64_t, 3> cell;
    for (int i = 0; i < 3; ++i)
      cell[i] = static_cast<std::int64_t>(std::clamp(std::floor(p[i] / tolerance), -9e15, 9e15));
    return cell;
  };
  std::vector<std::pair<std::array<std::int64_t, 3>, int>> cells;  // of each point
  cells.reserve(points.size());
  for (int v = 0; v < static_cast<int>(points.size()); ++v) cells.emplace_back(cell_of(points[v]), v);
  std::sort(cells.begin(), cells.end());
  for (int v = 0; v < static_cast<int>(points.size()); ++v) {
    const auto own = cell_of(points[v]);
    for (int k = 0; k < 9; ++k) {
      // Three cells in a row along z are consecutive in the sorted order.
      const std::array<std::int64_t, 3> low{own[0] + k / 3 - 1, own[1] + k % 3 - 1, own[2] - 1};
      const std::array<std::int64_t, 3> high{low[0], low[1], own[2] + 1};
      for (auto at = std::lower_bound(cells.begin(), cells.end(), std::pair(low, -1));
           at != cells.end() && at->first <= high; ++at)
        if (const int near = at->second;
            near < first[v] && first[near] == near && (points[near] - points[v]).norm() <= tolerance)
          first[v] = near;
    }
  }
  return first;
}

int orient_alike(TriangleMesh& mesh) {
  const Twins twins = neighbors(mesh);
  std::vector<char> turned(mesh.triangles.size(), -1);
  int count = 0;
  for (int seed = 0; seed < static_cast<int>(mesh.triangles.size()); ++seed) {
    if (turned[seed] >= 0) continue;
    const std::vector<int> piece = agree_with(seed, mesh, twins, turned);
    const auto ones = std::count_if(piece.begin(), piece.end(), [&](int t) { return turned[t] == 1; });
    const char wrong = 2 * ones > static_cast<std::ptrdiff_t>(piece.size()) ? 0 : 1;
    for (const int t : piece) {
      if (turned[t] != wrong) continue;
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
      ++count;
    }
  }
  return count;
}

CutSurface cut_surface(const TriangleMesh& mesh, double angle, std::vector<std::array<int, 2>> sides) {
  const Twins whole = neighbors(mesh);
  for (;;) {
    Twins twins = whole;
    cut_twins(mesh, angle, sides, twins);
    CutSurface surface{mesh, std::vector<int>(mesh.points.size()), 0};
    std::iota(surface.original.begin(), surface.original.end(), 0);
    const auto twin_of = [&](Side side) { return twins[triangle_of(side)][index_of(side)]; };
    surface.pieces = number_pieces(twins.size(), twin_of, surface.mesh.tags);
    split_points(twins, surface);
    // A cut along a single side separates no points. It continues along the next side of its triangle.
    const std::size_t count = sides.size();
    for (int t = 0; t < static_cast<int>(twins.size()); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Side side = make_side(t, i), twin = whole[t][i];
        if (twins[t][i] >= 0 || twin < side || surface.mesh.tags[t] != surface.mesh.tags[triangle_of(twin)] ||
            from(surface.mesh, side) != to(surface.mesh, twin) ||
            to(surface.mesh, side) != from(surface.mesh, twin))
          continue;
        sides.push_back({to(mesh, side), across(mesh, side)});
      }
    }
    if (sides.size() == count) return surface;
  }
}

}  // namespace quadrille
