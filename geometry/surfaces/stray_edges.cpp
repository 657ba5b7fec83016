#include "geometry/surfaces/stray_edges.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

/// The largest distance of points of an edge from the model's box.
double distance_from_box(const CadShape& shape, const CadEdge& edge) {
  const EdgeCurve curve(edge);
  const int intervals = std::max(8, 4 * curve.spans());
  double largest = 0;
  for (int i = 0; i <= intervals; ++i) {
    const Vector3 p = curve.point(edge.first + (edge.last - edge.first) * i / intervals);
    largest = std::max(largest, (p - p.cwiseMax(shape.box_min).cwiseMin(shape.box_max)).norm());
  }
  return largest;
}

}  // namespace

std::string StrayEdge::sentence(const CadShape& shape) const {
  return fmt::format(
      "Edge{} runs {:.3g} mm away from the model, whose diagonal is {:.3g} mm: the file may be damaged", edge,
      distance, shape.diagonal());
}

std::vector<StrayEdge> stray_edges(const CadShape& shape, const std::vector<char>& used) {
  constexpr double diagonals = 10;
  std::vector<StrayEdge> result;
  for (std::size_t i = 0; i < shape.edges.size(); ++i) {
    const CadEdge& edge = shape.edges[i];
    const bool is_used =
        std::any_of(edge.faces.begin(), edge.faces.end(), [&](int face) { return used[face - 1]; });
    // A curve that could not be measured has no length.
    if (!is_used || edge.degenerate || !(edge.length > diagonals * shape.diagonal())) continue;
    const double distance = distance_from_box(shape, edge);
    if (distance > diagonals * shape.diagonal()) result.push_back({static_cast<int>(i) + 1, distance});
  }
  return result;
}

}  // namespace quadrille
