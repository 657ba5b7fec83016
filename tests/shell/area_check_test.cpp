/// Volumes of meshes beside those of their solids, and areas beside those of faces.

#include "mesher/shell/area_check.hpp"

#include <gtest/gtest.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

#include <numbers>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

ShellMesh meshed(const CadModel& model, double divisions, const std::vector<int>& faces = {}) {
  MeshOptions options;
  options.sizing.size = model.diagonal() / divisions;
  options.faces = faces;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

TEST(AreaCheck, MeasuresTheVolumesOfClosedSamples) {
  int solids = 0;
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    const ShellMesh mesh = meshed(model, 40);
    EXPECT_TRUE(area_differences(model, mesh).empty()) << sample.name;
    const auto found = volumes(model, mesh);
    EXPECT_EQ(found.has_value(), sample.closed && !sample.non_manifold && sample.solids > 0) << sample.name;
    if (!found) continue;
    ++solids;
    EXPECT_GT(found->cad, 0) << sample.name;
    EXPECT_NEAR(found->mesh / found->cad, 1, 0.02) << sample.name;
    GProp_GProps properties;
    BRepGProp::VolumeProperties(model.shape().shape, properties, 1e-6, true);
    EXPECT_NEAR(found->cad / properties.Mass(), 1, 1e-4) << sample.name;
  }
  EXPECT_GT(solids, 3);
}

TEST(AreaCheck, KnowsTheVolumeOfABoxAndHasNoneOfAnOpenMesh) {
  const CadModel box =
      CadModel::read(std::filesystem::path(QUADRILLE_SOURCE_DIR) / "examples/models/box.brep");
  const auto found = volumes(box, meshed(box, 10));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->mesh / found->cad, 1, 1e-9);
  EXPECT_FALSE(volumes(box, meshed(box, 10, {1, 2})));
  const CadModel sheet = testing::sheet({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}});
  EXPECT_FALSE(volumes(sheet, meshed(sheet, 10)));
}

}  // namespace
}  // namespace quadrille
