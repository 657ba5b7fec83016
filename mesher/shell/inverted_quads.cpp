/// Finds the corner that is inverted most, what it lies on, and the edges near it.

#include "mesher/shell/inverted_quads.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "mesher/faces/boundary_crossings.hpp"

namespace quadrille {

namespace {

class InvertedQuads {
 public:
  InvertedQuads(const CadShape& shape, FaceId face, const FaceChart& chart, const BoundaryNodes& nodes)
      : shape_(shape), face_(face), boundary_(chart.boundary), surface_(*chart.surface), nodes_(nodes) {}

  FaceProblem run(const FaceMesh& mesh, const std::vector<int>& inverted) const {
    std::set<int> corners, touched;
    for (const int quad : inverted) corners.insert(mesh.quads[quad].begin(), mesh.quads[quad].end());
    for (const auto& quad : mesh.quads) {
      if (std::none_of(quad.begin(), quad.end(), [&](int corner) { return corners.contains(corner); }))
        continue;
      for (const int corner : quad) {
        if (corner < static_cast<int>(mesh.nodes.size())) touched.insert(mesh.nodes[corner]);
      }
    }
    const int corner = worst_corner(mesh, mesh.quads[inverted.front()]);
    const Vector3& near = mesh.points[corner];
    const Cause cause = largest_stray(boundary_, surface_) > 1 ? Cause::stray_curves : Cause::inverted;
    FaceProblem problem(cause, face_,
                        fmt::format("Face{} has {} inverted quad{} at this size, the first at {}, {}",
                                    face_.number(), inverted.size(), inverted.size() == 1 ? "" : "s",
                                    place_text(near), place_of(mesh, corner)));
    problem.edges = edges_at(touched);
    return problem;
  }

 private:
  /// The node at the corner of a quad that is inverted most.
  int worst_corner(const FaceMesh& mesh, const std::array<int, 4>& quad) const {
    const auto& p = mesh.points;
    const Vector3 outward = (shape_.faces[face_].reversed ? -1 : 1) * surface_.normal(mesh.uv[quad[0]]);
    int worst = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
      const Vector3 &at = p[quad[k]], &next = p[quad[(k + 1) % 4]], &before = p[quad[(k + 3) % 4]];
      const double area = (next - at).cross(before - at).dot(outward);
      if (area < least) {
        least = area;
        worst = k;
      }
    }
    return quad[worst];
  }

  /// A text that says where a node of the face lies.
  std::string place_of(const FaceMesh& mesh, int corner) const {
    if (corner >= static_cast<int>(mesh.nodes.size())) return "inside the face";
    const int node = mesh.nodes[corner];
    const auto vertex = std::find(nodes_.vertex_nodes.begin(), nodes_.vertex_nodes.end(), node);
    if (vertex != nodes_.vertex_nodes.end())
      return fmt::format("Vertex{}", vertex - nodes_.vertex_nodes.begin() + 1);
    for (const auto& segment : boundary_.segments) {
      if (!segment.edge.exists()) continue;
      const auto& on_edge = nodes_.edges[segment.edge].nodes;
      if (std::find(on_edge.begin(), on_edge.end(), node) != on_edge.end())
        return fmt::format("a node of Edge{}", shape_.edges[segment.edge].number);
    }
    return "inside the face";
  }

  /// The edges of the face, ascending, that have one of the given nodes.
  std::vector<EdgeId> edges_at(const std::set<int>& touched) const {
    std::set<EdgeId> result;
    for (const auto& segment : boundary_.segments)
      if (segment.edge.exists() &&
          (touched.contains(boundary_.nodes[segment.a]) || touched.contains(boundary_.nodes[segment.b])))
        result.insert(segment.edge);
    return {result.begin(), result.end()};
  }

  const CadShape& shape_;
  FaceId face_;
  const FaceBoundary& boundary_;
  const FaceSurface& surface_;
  const BoundaryNodes& nodes_;
};

}  // namespace

FaceProblem inverted_problem(const CadShape& shape, FaceId face, const FaceChart& chart,
                             const BoundaryNodes& nodes, const FaceMesh& mesh,
                             const std::vector<int>& inverted) {
  return InvertedQuads(shape, face, chart, nodes).run(mesh, inverted);
}

}  // namespace quadrille
