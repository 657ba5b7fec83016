/// Finds the corner that is inverted most, what it lies on, and the edges near it.

#include "mesher/shell/face_mesher.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "mesher/faces/boundary_crossings.hpp"

namespace quadrille {

namespace {

/// The node at the corner of a quad that is inverted most. \param outward a normal of the quad
int worst_corner(const std::vector<Vector3>& p, const std::array<int, 4>& quad, const Vector3& outward) {
  const auto area = [&](int k) {
    const Vector3 &at = p[quad[k]], &next = p[quad[(k + 1) % 4]], &before = p[quad[(k + 3) % 4]];
    return (next - at).cross(before - at).dot(outward);
  };
  return quad[std::min({0, 1, 2, 3}, [&](int a, int b) { return area(a) < area(b); })];
}

/// A text that says where a boundary node of the face lies.
std::string place_of(int node, const CadShape& shape, const FaceBoundary& boundary,
                     const BoundaryNodes& nodes) {
  const auto vertex = std::find(nodes.vertex_nodes.begin(), nodes.vertex_nodes.end(), node);
  if (vertex != nodes.vertex_nodes.end())
    return fmt::format("Vertex{}", vertex - nodes.vertex_nodes.begin() + 1);
  for (const auto& segment : boundary.segments) {
    if (!segment.edge.exists()) continue;
    const auto& on_edge = nodes.edges[segment.edge].nodes;
    if (std::find(on_edge.begin(), on_edge.end(), node) != on_edge.end())
      return fmt::format("a node of Edge{}", shape.edges[segment.edge].number);
  }
  return "inside the face";
}

/// The edges of the face, ascending, that have one of the given nodes.
std::vector<EdgeId> edges_at(const std::set<int>& touched, const FaceBoundary& boundary) {
  std::set<EdgeId> result;
  for (const auto& segment : boundary.segments)
    if (segment.edge.exists() &&
        (touched.contains(boundary.nodes[segment.a]) || touched.contains(boundary.nodes[segment.b])))
      result.insert(segment.edge);
  return {result.begin(), result.end()};
}

}  // namespace

FaceProblem inverted_problem(const CadShape& shape, FaceId face, const FaceChart& chart,
                             const BoundaryNodes& nodes, const FaceMesh& mesh,
                             const std::vector<int>& inverted) {
  const auto is_on_boundary = [&](int corner) { return corner < static_cast<int>(mesh.nodes.size()); };
  std::set<int> corners, touched;
  for (const int quad : inverted) corners.insert(mesh.quads[quad].begin(), mesh.quads[quad].end());
  for (const auto& quad : mesh.quads) {
    if (std::none_of(quad.begin(), quad.end(), [&](int corner) { return corners.contains(corner); }))
      continue;
    for (const int corner : quad)
      if (is_on_boundary(corner)) touched.insert(mesh.nodes[corner]);
  }
  const auto& first = mesh.quads[inverted.front()];
  const Vector3 normal = chart.surface->normal(mesh.uv[first[0]]);
  const int corner = worst_corner(mesh.points, first, (shape.faces[face].reversed ? -1 : 1) * normal);
  const Cause cause =
      largest_stray(chart.boundary, *chart.surface) > 1 ? Cause::stray_curves : Cause::inverted;
  FaceProblem problem(
      cause, face,
      fmt::format("Face{} has {} inverted quad{} at this size, the first at {}, {}", face.number(),
                  inverted.size(), inverted.size() == 1 ? "" : "s", place_text(mesh.points[corner]),
                  is_on_boundary(corner) ? place_of(mesh.nodes[corner], shape, chart.boundary, nodes)
                                         : "inside the face"));
  problem.edges = edges_at(touched, chart.boundary);
  return problem;
}

}  // namespace quadrille
