/// Based on: Morton, A computer oriented geodetic data base (1966), for the curve.

#include "mesher/mesh/renumbering.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "geometry/base/rows.hpp"

namespace quadrille {

namespace {

/// Spreads the bits of a number below 2^10: two zero bits follow each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffU;
  x = (x | x << 8) & 0x0300f00fU;
  x = (x | x << 4) & 0x030c30c3U;
  return (x | x << 2) & 0x09249249U;
}

/// Orders elements along a Morton curve through cells, by their first corners. Elements in the same cell keep
/// their order. \param cells number of cells along an axis, a power of two, 128 at most.
template <std::size_t n>
std::vector<int> along_curve(const std::vector<Vector3>& points,
                             const std::vector<std::array<int, n>>& elements, int cells, SparseCheck& check) {
  Vector3 low = points[elements[0][0]], high = low;
  for (const auto& element : elements) {
    low = low.cwiseMin(points[element[0]]);
    high = high.cwiseMax(points[element[0]]);
  }
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0 ? (cells - 1e-6) / extent : 0;
  std::vector<std::uint32_t> keys(elements.size());
  for (std::size_t t = 0; t < keys.size(); ++t) {
    check();
    const Vector3 at = scale * (points[elements[t][0]] - low);
    const auto bits = [&](int k) { return spread(static_cast<std::uint32_t>(at[k])); };
    keys[t] = bits(0) | bits(1) << 1 | bits(2) << 2;
  }
  Rows<> rows(cells * cells * cells, [&](auto&& add) {
    for (std::size_t t = 0; t < keys.size(); ++t) add(static_cast<int>(keys[t]), static_cast<int>(t));
  });
  return rows.take_items();
}

/// Gives the points of an element their numbers; those that have none yet get the next ones.
template <std::size_t n>
void renumber(std::array<int, n>& element, std::vector<int>& number, std::vector<int>& old_point) {
  for (int& v : element) {
    if (number[v] < 0) {
      number[v] = static_cast<int>(old_point.size());
      old_point.push_back(v);
    }
    v = number[v];
  }
}

}  // namespace

RenumberedMesh order_by_place(const TriangleMesh& mesh, const ExecutionContext& context) {
  SparseCheck check(context);
  RenumberedMesh result;
  constexpr int cells = 128;  // about a hundred triangles in each, whose order hardly matters
  const std::vector<int> order = along_curve(mesh.points, mesh.triangles, cells, check);
  std::vector<int> number(mesh.points.size(), -1);
  result.mesh.triangles.reserve(mesh.triangles.size());
  result.old_point.reserve(mesh.points.size());
  if (!mesh.tags.empty()) result.mesh.tags.reserve(mesh.tags.size());
  for (int t : order) {
    check();
    renumber(result.mesh.triangles.emplace_back(mesh.triangles[t]), number, result.old_point);
    if (!mesh.tags.empty()) result.mesh.tags.push_back(mesh.tags[t]);
  }
  result.mesh.points.reserve(result.old_point.size());
  for (int old : result.old_point) result.mesh.points.push_back(mesh.points[old]);
  return result;
}

std::vector<int> order_by_place(const std::vector<Vector3>& points, std::size_t fixed,
                                std::vector<std::array<int, 4>>& quads, const ExecutionContext& context) {
  SparseCheck check(context);
  int cells = 1;
  while (cells < 128 && 16 * cells * cells < static_cast<int>(quads.size())) cells *= 2;
  std::vector<int> old_point(fixed), number(points.size(), -1);
  std::iota(old_point.begin(), old_point.end(), 0);
  std::copy_n(old_point.begin(), fixed, number.begin());
  std::vector<std::array<int, 4>> ordered;
  ordered.reserve(quads.size());
  for (const int at : along_curve(points, quads, cells, check)) {
    check();
    renumber(ordered.emplace_back(quads[at]), number, old_point);
  }
  quads = std::move(ordered);
  return old_point;
}

}  // namespace quadrille
