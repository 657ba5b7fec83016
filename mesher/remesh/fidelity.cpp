/// Measures nearest distances both ways between the surface and fans of triangles over the quads.

#include "mesher/remesh/fidelity.hpp"

#include <map>

namespace quadrille {

namespace {

/// The mesh as triangles around the middle of each quad, through its midside nodes if it has any. Their tags
/// are the faces of the surface.
TriangleMesh fans_of(const ShellMesh& mesh, const std::vector<int>& face_numbers) {
  std::map<int, int> patch_of_face;
  for (const int number : face_numbers)
    patch_of_face.try_emplace(number, static_cast<int>(patch_of_face.size()));
  TriangleMesh fans;
  fans.points = mesh.points;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    std::vector<int> loop;
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 4; ++k) {
      const int corner = mesh.quads[q][k];
      loop.push_back(corner);
      if (mesh.order == 1) {
        middle += 0.25 * mesh.points[corner];
        continue;
      }
      loop.push_back(mesh.midsides[q][k]);
      // The shape functions of the eight-node element at its middle.
      middle += 0.5 * mesh.points[loop.back()] - 0.25 * mesh.points[corner];
    }
    const int center = static_cast<int>(fans.points.size());
    fans.points.push_back(middle);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      fans.triangles.push_back({loop[k], loop[(k + 1) % loop.size()], center});
      fans.tags.push_back(patch_of_face.at(mesh.quad_faces[q]));
    }
  }
  return fans;
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
  return sum;
}

void raise(RemeshFidelity::Distance& largest, double length, const Vector3& at, int face) {
  if (length > largest.length) largest = {length, at, face};
}

}  // namespace

RemeshFidelity measure_fidelity(const TriangleMesh& surface, const std::vector<int>& patches,
                                const SurfaceLocator& locator, const ShellMesh& mesh,
                                const std::vector<int>& face_numbers) {
  RemeshFidelity result;
  const TriangleMesh fans = fans_of(mesh, face_numbers);
  for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
    const auto& [a, b, center] = fans.triangles[t];
    const int patch = fans.tags[t];
    for (const Vector3& p :
         {fans.points[a], Vector3(0.5 * (fans.points[a] + fans.points[b])), fans.points[center]})
      raise(result.of_mesh, (locator.nearest(patch, p).point - p).norm(), p, face_numbers[patch]);
  }
  const SurfaceLocator made(fans, fans.tags, static_cast<int>(face_numbers.size()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int v : surface.triangles[t]) {
      const Vector3& p = surface.points[v];
      raise(result.of_surface, (made.nearest(patches[t], p).point - p).norm(), p, face_numbers[patches[t]]);
    }
  result.surface_area = area_of(surface);
  result.mesh_area = area_of(fans);
  return result;
}

}  // namespace quadrille
