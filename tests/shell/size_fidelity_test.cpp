/// Sides of elements against the sizes that were wanted.

#include "mesher/shell/size_fidelity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "mesher/mesh/criteria.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

TEST(SizeFidelity, CountsEachSideOnceAgainstTheSizeThere) {
  const CadModel box = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = 1;  // which divides all sides
  ExecutionContext context;
  const ShellMesh mesh = quadrille::mesh(box, options, context);
  const SizeFidelity exact =
      size_fidelity(mesh, SizingField::build(box, options.sizing, context), box.shape());
  EXPECT_EQ(exact.sides, static_cast<int>(2 * mesh.quads.size()));  // of a closed mesh
  EXPECT_NEAR(exact.median, 1, 1e-6);
  EXPECT_DOUBLE_EQ(exact.within_percent, 100);
  options.sizing.size = 4;  // of another mesh
  const SizeFidelity fine =
      size_fidelity(mesh, SizingField::build(box, options.sizing, context), box.shape());
  EXPECT_NEAR(fine.median, 0.25, 1e-6);
  EXPECT_DOUBLE_EQ(fine.within_percent, 0);
  EXPECT_DOUBLE_EQ(fine.json()["below_percent"], 100);
}

TEST(SizeFidelity, GradedMeshesKeepTheirSizes) {
  const CadModel bracket = CadModel::read(sample_model("bracket").path());
  MeshOptions options;
  options.sizing.size = bracket.diagonal() / 60;
  options.sizing.face_sizes[1] = options.sizing.size / 4;
  ExecutionContext context;
  SizeFidelity found;
  options.inspect = [&](const ShellMesh& mesh, const SizingField& field) {
    found = size_fidelity(mesh, field, bracket.shape());
  };
  quadrille::mesh(bracket, options, context);
  EXPECT_NEAR(found.median, 1, 0.15);
  EXPECT_GT(found.within_percent, 85);
}

TEST(SizeFidelity, FineEdgesDoNotMakeWholeGridsFine) {
  const CadModel box = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = 4;
  for (int edge = 1; edge <= 12; ++edge) options.sizing.edge_sizes[edge] = 0.5;
  ExecutionContext context;
  SizeFidelity found;
  options.inspect = [&](const ShellMesh& mesh, const SizingField& field) {
    found = size_fidelity(mesh, field, box.shape());
  };
  const ShellMesh mesh = quadrille::mesh(box, options, context);
  EXPECT_LT(mesh.quads.size(), 3000u);  // grids between such edges have 8800, four parts of larger quads 3692
  EXPECT_GT(found.within_percent, 88);  // and 28 % within, or 76
  EXPECT_NEAR(found.below_percent + found.within_percent + found.above_percent, 100, 1e-9);
  // Here more than a twentieth of the free quads lie outside the limits before nodes slide, and none after.
  for (int edge = 1; edge <= 12; ++edge) options.sizing.edge_sizes[edge] = 0.75;
  const ShellMesh coarser = quadrille::mesh(box, options, context);
  EXPECT_GT(found.within_percent, 85);  // grids have 80
  EXPECT_EQ(check_criteria(coarser).outside, 0);
  // Where users ask for the division itself, rows go through.
  options.sizing.edge_sizes.clear();
  for (int edge = 1; edge <= 12; ++edge) options.sizing.spacings[edge].segments = 24;
  EXPECT_EQ(quadrille::mesh(box, options, context).quads.size(), 6u * 24 * 24);
}

}  // namespace
}  // namespace quadrille
