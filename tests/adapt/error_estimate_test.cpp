/// Errors of stresses by patch recovery, and sizes that spread them evenly.

#include "mesher/adapt/error_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/solved_plates.hpp"

namespace quadrille {
namespace {

TEST(ErrorEstimate, IsNoneForStressesThatArePolynomials) {
  const ShellMesh mesh = grid(6, flat);
  const auto smooth =
      given(mesh, [](int, const Vector3& p) { return 1 + p.x() * p.y() - 0.3 * p.x() * p.x(); });
  EXPECT_LT(estimate_error(mesh, smooth, 0.3).relative(), 1e-6);
}

TEST(ErrorEstimate, IsWhereStressesJump) {
  const ShellMesh mesh = grid(8, flat);
  const auto jumping =
      given(mesh, [](int quad, const Vector3&) { return quad == 0 || quad == 9 ? 2.0 : 1.0; });
  const ErrorEstimate estimate = estimate_error(mesh, jumping, 0.3);
  EXPECT_GT(estimate.relative(), 0.05);
  double near = 0;
  for (std::size_t quad = 0; quad < estimate.squares.size(); ++quad) {
    if (quad % 8 < 4 && quad / 8 < 4) near += estimate.squares[quad];
  }
  EXPECT_GT(near, 0.999 * estimate.sum());
}

TEST(ErrorEstimate, FoldsAreNoErrors) {
  const auto bent = [](double x, double y) {
    return x <= 0.5 ? Vector3(10 * x, 10 * y, 0) : Vector3(5, 10 * y, 10 * x - 5);
  };
  const ShellMesh mesh = grid(6, bent);
  const auto two = given(mesh, [](int quad, const Vector3&) { return quad % 6 < 3 ? 1.0 : -2.0; });
  EXPECT_LT(estimate_error(mesh, two, 0.3).relative(), 1e-6);
  const ShellMesh straight = grid(6, flat);
  EXPECT_GT(estimate_error(straight, two, 0.3).relative(), 0.1);
}

TEST(ErrorEstimate, SizesSpreadItEvenly) {
  const ShellMesh mesh = grid(10, flat);  // quads of side 1
  ErrorEstimate estimate;
  estimate.squares.assign(100, 1e-4);
  estimate.all = 1;
  for (const double size : even_sizes(mesh, estimate)) EXPECT_NEAR(size, even_sizes(mesh, estimate)[0], 1e-9);
  // Second order: the square of a quad's error goes with the sixth power of its new size, over as many.
  for (int quad = 0; quad < 100; ++quad) {
    if (quad % 10 < 5) estimate.squares[quad] = 64e-4;
  }
  auto sizes = even_sizes(mesh, estimate);
  EXPECT_NEAR(sizes[3] / sizes[8], 0.5, 1e-6);
  EXPECT_GT(sizes[5], 1.05 * sizes[4]);
  EXPECT_LT(sizes[5], 0.95 * sizes[6]);
  // A single quad is believed by a quarter at each of its corners.
  estimate.squares.assign(100, 1e-4);
  estimate.squares[55] = 64e-4;
  sizes = even_sizes(mesh, estimate);
  EXPECT_NEAR(sizes[5 * 11 + 5] / sizes[0], std::pow(67.0 / 4, -1.0 / 6), 1e-6);
}

TEST(ErrorEstimate, TellsWhereItIsConcentrated) {
  constexpr int n = 8;
  const ShellMesh mesh = grid(n, flat);
  ErrorEstimate estimate;
  estimate.squares.assign(mesh.quads.size(), 1);
  const int node = 4 * (n + 1) + 4;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    if (std::count(mesh.quads[quad].begin(), mesh.quads[quad].end(), node) > 0) estimate.squares[quad] = 8;
  }
  std::vector<char> wanted(mesh.points.size(), 0);
  wanted[node] = 1;
  EXPECT_EQ(singular_corners(mesh, estimate), wanted);
  // A slope is none, nor a rough field.
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad)
    estimate.squares[quad] = std::pow(1.3, static_cast<double>(quad % n)) * (1 + quad % 3);
  EXPECT_EQ(singular_corners(mesh, estimate), std::vector<char>(mesh.points.size(), 0));
}

}  // namespace
}  // namespace quadrille
