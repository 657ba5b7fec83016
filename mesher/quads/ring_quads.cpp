#include "mesher/quads/ring_quads.hpp"

#include <utility>

namespace quadrille {

namespace {

/// Collects points of a mesh anew.
class Collector {
 public:
  Collector(const FaceQuads& old, const FaceSurface& surface) : old_(old), surface_(surface) {}

  int copy(int i, bool fixed) {
    const auto& from = old_.surface_mesh;
    const int point = add(from.mesh.points[i], from.parameters[i], from.normals[i], fixed, old_.pole[i]);
    result.surface_mesh.boundary_angles.back() =
        i < static_cast<int>(from.boundary_angles.size()) && fixed ? from.boundary_angles[i] : 0;
    return point;
  }

  int add(const Vector3& point, const Vector2& uv, bool fixed) {
    return add(point, uv, surface_.normal(uv), fixed, false);
  }

  FaceQuads result;

 private:
  int add(const Vector3& point, const Vector2& uv, const Vector3& normal, bool fixed, bool pole) {
    auto& mesh = result.surface_mesh;
    mesh.mesh.points.push_back(point);
    mesh.parameters.push_back(uv);
    mesh.normals.push_back(normal);
    mesh.fixed.push_back(fixed);
    mesh.boundary_angles.push_back(0);
    result.pole.push_back(pole);
    return static_cast<int>(mesh.mesh.points.size()) - 1;
  }

  const FaceQuads& old_;
  const FaceSurface& surface_;
};

}  // namespace

void add_ring_quads(FaceQuads& quads, std::vector<FaceBoundary::Segment>& segments, const HoleRings& rings,
                    const FaceBoundary& boundary, const FaceSurface& surface) {
  const int fixed = static_cast<int>(quads.nodes.size());
  const int count = static_cast<int>(quads.surface_mesh.mesh.points.size());
  Collector collector(quads, surface);
  std::vector<int> renumbered(count, -1), on_hole(boundary.uv.size(), -1);
  // The boundary first: of a ring's node the one of the hole.
  for (int i = 0; i < fixed; ++i) {
    if (quads.nodes[i] >= 0) {
      renumbered[i] = collector.copy(i, true);
      collector.result.nodes.push_back(quads.nodes[i]);
    } else {
      const int point = HoleRings::point_of(quads.nodes[i]);
      on_hole[point] = collector.add(boundary.points[point], boundary.uv[point], true);
      collector.result.nodes.push_back(boundary.nodes[point]);
    }
  }
  for (int i = 0; i < count; ++i) {
    if (renumbered[i] < 0) renumbered[i] = collector.copy(i, false);
  }
  std::vector<std::vector<int>> between(boundary.uv.size());
  const auto rows_at = [&](int i) {  // from the hole to the outermost ring
    const int point = HoleRings::point_of(quads.nodes[i]);
    if (between[point].empty()) {
      between[point].push_back(on_hole[point]);
      for (const auto& [uv, p] : rings.between[point]) between[point].push_back(collector.add(p, uv, false));
      between[point].push_back(renumbered[i]);
    }
    return between[point];
  };
  auto& result = collector.result.surface_mesh.mesh;
  const auto renumber = [&](auto elements) {
    for (auto& element : elements) {
      for (int& point : element) point = renumbered[point];
    }
    return elements;
  };
  result.quads = renumber(quads.surface_mesh.mesh.quads);
  result.triangles = renumber(quads.surface_mesh.mesh.triangles);
  for (auto& segment : segments) {
    if (quads.nodes[segment.a] >= 0) {
      segment.a = renumbered[segment.a];
      segment.b = renumbered[segment.b];
      continue;
    }
    const std::vector<int> at_a = rows_at(segment.a), at_b = rows_at(segment.b);
    for (std::size_t k = 0; k + 1 < at_a.size(); ++k)
      result.quads.push_back({at_a[k], at_b[k], at_b[k + 1], at_a[k + 1]});
    segment.a = at_a.front();
    segment.b = at_b.front();
  }
  quads = std::move(collector.result);
}

}  // namespace quadrille
