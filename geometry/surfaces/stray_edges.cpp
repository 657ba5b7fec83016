/// Measures how far samples of each edge lie outside the bounding box of all surfaces.

#include "geometry/surfaces/stray_edges.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/surfaces/edge_curve.hpp"

namespace quadrille {

namespace {

/// The largest distance of points of an edge from a box.
double distance_from_box(const CadEdge& edge, const Vector3& low, const Vector3& high) {
  const EdgeCurve curve(edge);
  const int intervals = std::max(8, 4 * curve.spans());
  double largest = 0;
  for (int i = 0; i <= intervals; ++i) {
    const Vector3 p = curve.point(edge.first + (edge.last - edge.first) * i / intervals);
    largest = std::max(largest, (p - p.cwiseMax(low).cwiseMin(high)).norm());
  }
  return largest;
}

}  // namespace

std::string StrayEdge::sentence() const {
  return fmt::format(
      "Edge{} runs {} mm away from the model's surfaces, which span {} mm: the file may be damaged", edge,
      number_text(distance), number_text(span));
}

std::vector<StrayEdge> stray_edges(const CadShape& shape, const FaceFlags& used) {
  constexpr double spans = 10;
  std::vector<EdgeId> long_ones;
  Eigen::AlignedBox3d vertices;
  for (const Vector3& vertex : shape.vertices) vertices.extend(vertex);
  const double usual = vertices.isEmpty() ? 0 : vertices.diagonal().norm();
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    // Edges whose curves could not be measured have length 0.
    if (edge.is_used(used) && !edge.degenerate && edge.length > spans * usual) long_ones.push_back(id);
  }
  std::vector<StrayEdge> result;
  if (long_ones.empty()) return result;
  const Bnd_Box box = box_of(shape.shape);  // edge curves enlarge it only where they bound planes
  if (box.IsVoid()) return result;
  const Vector3 low = to_vector(box.CornerMin()), high = to_vector(box.CornerMax());
  const double span = (high - low).norm();
  for (const EdgeId id : long_ones) {
    const double distance = distance_from_box(shape.edges[id], low, high);
    if (distance > spans * span) result.push_back({shape.edges[id].number, distance, span});
  }
  return result;
}

}  // namespace quadrille
