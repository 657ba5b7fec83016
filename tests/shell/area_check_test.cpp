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

TEST(AreaCheck, FindsNoDifferencesOnSamples) {
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    EXPECT_TRUE(area_differences(model, meshed(model, 40)).empty()) << sample.name;
  }
}

}  // namespace
}  // namespace quadrille
