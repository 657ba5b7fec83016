#pragma once
/// Plates with displacements or stresses given by a formula, for the tests of error estimates.

#include <fmt/format.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesher/adapt/shell_stress.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

using Place = std::function<Vector3(double, double)>;

/// n x n quads over the unit square, put into space.
inline ShellMesh grid(int n, const Place& place) {
  ShellMesh mesh;
  mesh.order = 2;
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) mesh.points.push_back(place(1.0 * column / n, 1.0 * row / n));
  for (int k = 0; k < n * n; ++k) {
    const int a = k / n * (n + 1) + k % n;
    mesh.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
  }
  return mesh;
}

inline Vector3 flat(double x, double y) {
  return {10 * x, 10 * y, 0};
}

/// The .frd file of a mesh as bricks of eight nodes, 0.2 thick, that move.
inline std::string frd(const ShellMesh& mesh, const std::function<Vector3(const Vector3&)>& moved) {
  std::string nodes, elements, values;
  int number = 0;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const auto& corners = mesh.quads[quad];
    const Vector3 normal = (mesh.points[corners[2]] - mesh.points[corners[0]])
                               .cross(mesh.points[corners[3]] - mesh.points[corners[1]])
                               .normalized();
    elements += fmt::format(" -1{:10}{:5}{:5}{:5}\n -2", quad + 1, 1, 0, 1);
    for (int k = 0; k < 8; ++k) {
      const Vector3 p = mesh.points[corners[k % 4]] + (k < 4 ? -0.1 : 0.1) * normal, u = moved(p);
      elements += fmt::format("{:10}", ++number);
      nodes += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, p.x(), p.y(), p.z());
      values += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, u.x(), u.y(), u.z());
    }
    elements += "\n";
  }
  return fmt::format("    1C\n    2C{:30}{:37}\n{} -3\n    3C{:30}{:37}\n{} -3\n", number, 1, nodes,
                     mesh.quads.size(), 1, elements) +
         fmt::format(
             "  100CL  101 1.000000000{:12}{:22}{:5}{:10}{:2}\n -4  DISP        4    1\n -5  D1          1   "
             " 2    "
             "1    0\n{} -3\n 9999\n",
             number, 0, 1, 1, 1, values);
}

inline std::vector<std::array<ShellStress, 4>> stresses_of(
    const ShellMesh& mesh, const std::function<Vector3(const Vector3&)>& moved, double poisson) {
  return shell_stresses(mesh, read_frd(frd(mesh, moved), "t.frd"), poisson, "t.frd");
}

/// Stresses that are given by place.
inline std::vector<std::array<ShellStress, 4>> given(
    const ShellMesh& mesh, const std::function<double(int quad, const Vector3&)>& value) {
  auto stresses = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(p.x(), 0, 0); }, 0.3);
  for (std::size_t quad = 0; quad < stresses.size(); ++quad) {
    for (ShellStress& stress : stresses[quad]) {
      stress.membrane.setZero();
      stress.bending.setZero();
      stress.membrane[0] = stress.bending[3] = value(static_cast<int>(quad), stress.point);
    }
  }
  return stresses;
}

}  // namespace quadrille
