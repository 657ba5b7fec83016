/// Good grids are kept, and poor or wasteful ones give way to better meshes.

#include "mesher/shell/face_judge.hpp"

#include <gtest/gtest.h>

#include "geometry/surfaces/face_surface.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

/// A grid over a square of 20 by 20, each row pushed aside by `shear` times its height.
FaceMesh grid(int columns, int rows, double shear = 0) {
  FaceMesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double x = 20.0 * i / columns, y = 20.0 * j / rows;
      mesh.points.push_back({x + shear * y, y, 0});
      mesh.uv.push_back({x, y});
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i;
      mesh.quads.push_back({a, a + 1, a + columns + 2, a + columns + 1});
    }
  mesh.nodes.resize(2 * static_cast<std::size_t>(columns + rows));
  return mesh;
}

SizingOptions sizes_of_one() {
  SizingOptions options;
  options.size = 1;
  return options;
}

class FaceJudgeTest : public ::testing::Test {
 protected:
  const CadModel model_ = testing::sheet({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}});
  ExecutionContext context_{1};
  const SizingField field_ = SizingField::build(model_, sizes_of_one(), context_);
  const FaceSurface surface_{model_.shape().faces[face_id(1)]};
  FaceJudge judge_{field_, face_id(1), surface_, context_};
};

TEST_F(FaceJudgeTest, KeepsGoodGridsOfTheRightSize) {
  EXPECT_FALSE(judge_.is_doubtful(grid(20, 20), FacePlan()));
}

TEST_F(FaceJudgeTest, ReplacesShearedGridsByBetterMeshes) {
  const FaceMesh sheared = grid(20, 20, 2);
  EXPECT_TRUE(judge_.is_doubtful(sheared, FacePlan()));
  EXPECT_TRUE(judge_.replaces_grid(grid(20, 20), sheared));
  EXPECT_FALSE(judge_.replaces_grid(grid(20, 20, 2), sheared));
}

TEST_F(FaceJudgeTest, ReplacesWastefulGridsByFewerQuads) {
  const FaceMesh fine = grid(40, 40);
  EXPECT_TRUE(judge_.is_doubtful(fine, FacePlan()));
  EXPECT_TRUE(judge_.replaces_grid(grid(20, 20), fine));
  EXPECT_FALSE(judge_.replaces_grid(grid(38, 38), fine));
  FacePlan divided;
  divided.has_divided_edge = true;  // users want as many
  EXPECT_FALSE(judge_.is_doubtful(fine, divided));
}

TEST_F(FaceJudgeTest, ReplacesQuadsCutInFourWhereTheyArePoor) {
  EXPECT_FALSE(judge_.is_doubtful(grid(20, 20)));
  const FaceMesh poor = grid(20, 20, 2);
  EXPECT_TRUE(judge_.is_doubtful(poor));
  EXPECT_TRUE(judge_.replaces_cut(grid(20, 20), poor));
  EXPECT_FALSE(judge_.replaces_cut(poor, poor));
}

}  // namespace
}  // namespace quadrille
