/// Halves quads along their better diagonal, merges points, refuses triangles without area, sorts by place.

#include "mesher/shell/triangle_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "geometry/base/error.hpp"
#include "mesher/mesh/renumbering.hpp"
#include "mesher/mesh/surface_cut.hpp"

namespace quadrille {

namespace {

double least_sine(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double area = (b - a).cross(c - a).norm();
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? area / longest : 0;
}

/// Cuts a quad along the diagonal whose worse triangle is better shaped. Inverted triangles are the worst.
std::array<std::array<int, 3>, 2> halves(const std::array<int, 4>& quad, const std::vector<Vector3>& points) {
  const auto& [a, b, c, d] = quad;
  const Vector3 normal = (points[c] - points[a]).cross(points[d] - points[b]);
  const auto value = [&](int i, int j, int k) {
    const bool turned = (points[j] - points[i]).cross(points[k] - points[i]).dot(normal) < 0;
    return (turned ? -1 : 1) * least_sine(points[i], points[j], points[k]);
  };
  const double along_ac = std::min(value(a, b, c), value(a, c, d));
  const double along_bd = std::min(value(a, b, d), value(b, c, d));
  if (along_ac >= along_bd) return {{{a, b, c}, {a, c, d}}};
  return {{{a, b, d}, {b, c, d}}};
}

void check_finite(const std::vector<Vector3>& points) {
  for (std::size_t v = 0; v < points.size(); ++v)
    if (!points[v].allFinite())
      throw failure(fmt::format("point {}", v), fmt::format("point {} has no finite position", v));
}

void check_places(const std::vector<Vector3>& points) {
  const std::vector<int> first = coincident_points(points, 0);
  for (int v = 0; v < static_cast<int>(points.size()); ++v) {
    const Vector3& p = points[v];
    if (first[v] != v)
      throw failure(
          fmt::format("point {}", v),
          fmt::format("the points {} and {} are at the same position, {} {} {}: merge them with `merge` 0",
                      first[v], v, p.x(), p.y(), p.z()));
  }
}

/// Refuses triangles without area, which leave cracks and folds.
void check_shapes(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (least_sine(mesh.points[a], mesh.points[b], mesh.points[c]) <= 1e-14)
      throw failure(
          fmt::format("triangle {}", t),
          fmt::format("triangle {} has no area: its corners are the points {}, {} and {}", t, a, b, c));
  }
}

int face_of(const std::vector<int>& faces, std::size_t element) {
  return element < faces.size() ? faces[element] : 0;
}

/// Reorders the triangles of large meshes so that neighbors are near each other in memory. That pays for
/// itself many times over in later steps: Gmsh lists triangles in the order of their creation.
void order(TriangleInput& input, const ExecutionContext& context) {
  constexpr std::size_t fit_the_caches = 1 << 14;
  if (input.mesh.triangles.size() < fit_the_caches) return;
  RenumberedMesh ordered = order_by_place(input.mesh, context);
  std::vector<int> now(input.mesh.points.size(), -1);
  for (std::size_t v = 0; v < ordered.old_point.size(); ++v) now[ordered.old_point[v]] = static_cast<int>(v);
  input.mesh = std::move(ordered.mesh);
  for (int& point : input.node) point = now[point];
}

}  // namespace

TriangleInput triangle_input(const ShellMesh& input, double merge, double least,
                             std::vector<std::string>& notes, const ExecutionContext& context) {
  check_finite(input.points);
  TriangleInput work;
  work.mesh.points = input.points;
  if (merge < 0) check_places(input.points);
  if (merge >= 0 || least > 0) {
    work.node = coincident_points(input.points, std::max(merge, least));
  } else {
    work.node.resize(input.points.size());
    std::iota(work.node.begin(), work.node.end(), 0);
  }
  std::size_t lost = 0;
  const auto add = [&](std::array<int, 3> triangle, int face) {
    for (int& v : triangle) v = work.node[v];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      ++lost;
      return;
    }
    work.mesh.triangles.push_back(triangle);
    work.mesh.tags.push_back(face);
  };
  for (std::size_t t = 0; t < input.triangles.size(); ++t)
    add(input.triangles[t], face_of(input.triangle_faces, t));
  for (std::size_t q = 0; q < input.quads.size(); ++q)
    for (const auto& half : halves(input.quads[q], input.points)) add(half, face_of(input.quad_faces, q));
  std::size_t merged = 0;
  for (std::size_t v = 0; v < work.node.size(); ++v) merged += work.node[v] != static_cast<int>(v);
  if (merged > 0) notes.push_back(fmt::format("{} nodes were merged with others", merged));
  if (lost > 0)
    notes.push_back(fmt::format("{} triangles lost their area by that merging: they are left out", lost));
  if (work.mesh.triangles.empty()) throw failure("", "no triangle is left");
  check_shapes(work.mesh);
  const int turned = orient_alike(work.mesh);
  if (turned > 0) notes.push_back(fmt::format("{} triangles were reversed to match their neighbors", turned));
  order(work, context);
  for (const ShellMesh::Segment& segment : input.segments) {
    const int a = work.node[segment.nodes[0]], b = work.node[segment.nodes[1]];
    if (a >= 0 && b >= 0 && a != b) work.sides.push_back({a, b});
  }
  return work;
}

}  // namespace quadrille
