/// Based on: Morton, A computer oriented geodetic data base (1966), for the curve.

#include "mesher/renumbering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace quadrille {

namespace {

constexpr std::size_t large = 1 << 18;  // smaller ones fit the caches
constexpr std::size_t samples = 1024;

/// How far apart in space successive triangles lie, in sides of triangles, on average of a sample.
double stride(const TriangleMesh& mesh) {
  double steps = 0, sides = 0;
  const std::size_t every = std::max<std::size_t>(1, mesh.triangles.size() / samples);
  for (std::size_t t = 0; t + 1 < mesh.triangles.size(); t += every) {
    const auto& [a, b, c] = mesh.triangles[t];
    steps += (mesh.points[mesh.triangles[t + 1][0]] - mesh.points[a]).norm();
    sides += (mesh.points[b] - mesh.points[a]).norm();
  }
  return sides > 0 ? steps / sides : 0;
}

constexpr double near = 16;  // sides

/// The middle bits of three numbers below 2^10 by turns.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ffU;
  x = (x | x << 8) & 0x0300f00fU;
  x = (x | x << 4) & 0x030c30c3U;
  return (x | x << 2) & 0x09249249U;
}

/// The triangles along a Morton curve through their first corners, equal places in the order of the mesh.
std::vector<int> along_curve(const TriangleMesh& mesh) {
  Vector3 low = mesh.points[mesh.triangles[0][0]], high = low;
  for (const auto& t : mesh.triangles) {
    low = low.cwiseMin(mesh.points[t[0]]);
    high = high.cwiseMax(mesh.points[t[0]]);
  }
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0 ? 1023 / extent : 0;
  struct Place {
    std::uint32_t key;
    int triangle;
  };
  std::vector<Place> places(mesh.triangles.size()), other(places.size());
  for (std::size_t t = 0; t < places.size(); ++t) {
    const Vector3 at = scale * (mesh.points[mesh.triangles[t][0]] - low);
    const auto bits = [&](int k) { return spread(static_cast<std::uint32_t>(at[k])); };
    places[t] = {bits(0) | bits(1) << 1 | bits(2) << 2, static_cast<int>(t)};
  }
  for (int shift = 0; shift < 30; shift += 10) {
    std::array<std::size_t, 1025> start{};
    for (const Place& p : places) ++start[(p.key >> shift & 1023) + 1];
    for (int k = 0; k < 1024; ++k) start[k + 1] += start[k];
    for (const Place& p : places) other[start[p.key >> shift & 1023]++] = p;
    places.swap(other);
  }
  std::vector<int> order(places.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = places[t].triangle;
  return order;
}

}  // namespace

bool is_scattered(const TriangleMesh& mesh) {
  if (mesh.triangles.size() < large) return false;
  double jump = 0;
  std::size_t count = 0;
  const std::size_t every = mesh.triangles.size() / samples;
  for (std::size_t t = 0; t + 1 < mesh.triangles.size(); t += every, ++count) {
    jump += std::abs(mesh.triangles[t][0] - mesh.triangles[t][1]);
    jump += std::abs(mesh.triangles[t][0] - mesh.triangles[t + 1][0]);
  }
  // Rows of a grid are as far apart as this; at random, a third of all points lies between two.
  const double rows = 8 * std::sqrt(static_cast<double>(mesh.points.size()));
  return jump / static_cast<double>(count) > rows || stride(mesh) > near;
}

RenumberedMesh order_by_place(const TriangleMesh& mesh) {
  RenumberedMesh result;
  const bool sorted = stride(mesh) <= near;
  const std::vector<int> order = sorted ? std::vector<int>() : along_curve(mesh);
  std::vector<int> number(mesh.points.size(), -1);
  result.mesh.triangles.reserve(mesh.triangles.size());
  result.old_point.reserve(mesh.points.size());
  if (!mesh.tags.empty()) result.mesh.tags.reserve(mesh.tags.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const std::size_t t = sorted ? k : static_cast<std::size_t>(order[k]);
    std::array<int, 3> triangle = mesh.triangles[t];
    for (int& v : triangle) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(result.old_point.size());
        result.old_point.push_back(v);
      }
      v = number[v];
    }
    result.mesh.triangles.push_back(triangle);
    if (!mesh.tags.empty()) result.mesh.tags.push_back(mesh.tags[t]);
  }
  result.mesh.points.reserve(result.old_point.size());
  for (int old : result.old_point) result.mesh.points.push_back(mesh.points[old]);
  return result;
}

}  // namespace quadrille
