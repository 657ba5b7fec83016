/// Membrane and bending stresses from the displacements of bricks, as CalculiX writes them.

#include "mesher/adapt/shell_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/solved_plates.hpp"

namespace quadrille {
namespace {

TEST(ShellStress, IsHookesInThePlaneAndInBending) {
  const ShellMesh mesh = grid(2, [](double x, double y) { return Vector3(10 * x + y, 9 * y + x, 0); });
  const auto stretched = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(1e-3 * p.x(), 0, 0); }, 0.3);
  for (const auto& quad : stretched) {
    for (const ShellStress& stress : quad) {
      EXPECT_NEAR(stress.membrane[0], 1e-3 / 0.91, 1e-6);
      EXPECT_NEAR(stress.membrane[1], 0.3e-3 / 0.91, 1e-6);
      EXPECT_NEAR(stress.membrane[3], 0, 1e-6);
      EXPECT_LT(stress.bending.norm(), 1e-6);
      EXPECT_NEAR(stress.thickness, 0.2, 1e-6);
    }
  }
  // Fibers stretch by their height times 0.02: at the top, 0.1 up, by 2e-3.
  const auto bent = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(0.02 * p.z() * p.x(), 0, 0); }, 0.3);
  double area = 0;
  for (const auto& quad : bent) {
    for (const ShellStress& stress : quad) {
      area += stress.area;
      EXPECT_LT(stress.membrane.norm(), 1e-6);
      EXPECT_NEAR(stress.bending[0], 2e-3 / 0.91, 2e-6);
      EXPECT_NEAR(stress.bending[1], 0.3 * 2e-3 / 0.91, 2e-6);
    }
  }
  EXPECT_NEAR(area, 89, 1e-3);
}

TEST(ShellStress, TurnsWithQuadsThatSolversTurnOver) {
  const ShellMesh mesh = grid(3, flat);
  ShellMesh turned = mesh;
  for (auto& [a, b, c, d] : turned.quads) std::swap(b, d);
  const auto moved = [](const Vector3& p) { return Vector3(0.02 * p.z() * p.x() * p.y(), 0, 0); };
  const SolverResult result = read_frd(frd(turned, moved), "t.frd");
  const auto same = shell_stresses(mesh, result, 0, "t.frd"), straight = stresses_of(mesh, moved, 0);
  for (std::size_t quad = 0; quad < same.size(); ++quad) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT((same[quad][k].point - straight[quad][k].point).norm(), 1e-5);
      EXPECT_LT((same[quad][k].bending - straight[quad][k].bending).norm(), 1e-5);
    }
  }
}

}  // namespace
}  // namespace quadrille
