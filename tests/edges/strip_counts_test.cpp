/// Counts along faces narrower than the size.

#include "mesher/edges/strip_counts.hpp"

#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>

#include <algorithm>
#include <cmath>
#include <memory>

#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"

namespace quadrille {
namespace {

ShellMesh mesh_of_plate(double thickness, double size) {
  const CadModel plate(std::make_shared<CadShape>(BRepPrimAPI_MakeBox(60, 40, thickness).Shape(), "plate"));
  MeshOptions options;
  options.sizing.size = size;
  options.sizing.growth = 2;  // sizes near the short edges do not reach far
  ExecutionContext context(1);
  return mesh(plate, options, context);
}

TEST(StripCounts, KeepsTheQuadsOfAThinRimWithinTheLimits) {
  for (const double thickness : {0.9, 0.7, 0.5}) {
    const ShellMesh mesh = mesh_of_plate(thickness, 5);
    EXPECT_EQ(validate(mesh, true), std::vector<std::string>{});
    // A few beside irregular vertices of the large faces may fail; where rims keep the size, dozens do.
    EXPECT_LE(check_criteria(mesh).failing, 3) << thickness;
  }
}

/// Quads between the two large faces.
int quads_of_rim(const ShellMesh& mesh) {
  return static_cast<int>(std::count_if(mesh.quads.begin(), mesh.quads.end(), [&](const auto& quad) {
    return std::abs(mesh.points[quad[0]].z() - mesh.points[quad[2]].z()) > 1e-6;
  }));
}

/// Below half the least size (5 / 8), rims are as coarse as the size asks for.
TEST(StripCounts, GivesUpWhereItWouldTakeFarMore) {
  EXPECT_GT(quads_of_rim(mesh_of_plate(0.5, 5)), quads_of_rim(mesh_of_plate(0.3, 5)));
}

TEST(StripCounts, RaisesATableWhereItIsLow) {
  CountTable table{{0, 1, 2}, {0, 4, 5}, {0, 10, 20}, 0};
  table.raise_to(0.3);
  EXPECT_DOUBLE_EQ(table.counts[1], 4);
  EXPECT_DOUBLE_EQ(table.total(), 7);
}

}  // namespace
}  // namespace quadrille
