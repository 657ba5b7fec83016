/// Estimated counts against those of real meshes, and sizes for a wanted count.

#include "mesher/estimate.hpp"

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

/// The factor by which two counts differ, 1 or more.
double factor(double a, double b) {
  return std::max(a / b, b / a);
}

TEST(QuadEstimate, IsCloseToTheMesh) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    ExecutionContext context(1);
    QuadEstimate estimate(model, context);
    const QuadEstimate::Suggestion found = estimate.size_for(3000);
    MeshOptions options;
    options.sizing.size = found.size;
    EXPECT_EQ(estimate.quads(options), found.quads);
    // The wing's grid is wasteful, and no other mesh turns out to be better.
    const double allowed = sample.name == "wing" ? 1.45 : 1.25;
    EXPECT_LT(factor(static_cast<double>(mesh(model, options, context).quads.size()), found.quads), allowed);
  }
}

/// A wasteful grid is replaced, and so is its count; margins are counted where sizes across gaps are fine.
TEST(QuadEstimate, IsCloseToTheMeshAcrossGaps) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    ExecutionContext context(1);
    MeshOptions options;
    options.sizing.proximity = 3;
    const std::vector<double> by_face = QuadEstimate(model, context).quads_by_face(options);
    ASSERT_EQ(by_face.size(), static_cast<std::size_t>(model.face_count()));
    const double sum = std::accumulate(by_face.begin(), by_face.end(), 0.0);
    EXPECT_LT(factor(static_cast<double>(mesh(model, options, context).quads.size()), sum), 1.25);
  }
}

/// Beside spikes, edges are divided and get other numbers of segments than in the model as it was read. The
/// sides of the arm touch the cylinder that it ends in.
TEST(QuadEstimate, IsCloseToTheMeshAtSpikes) {
  const TopoDS_Shape arm = BRepPrimAPI_MakeBox(gp_Pnt(0, -10, 0), 60, 20, 5).Shape();
  const TopoDS_Shape part = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(10, 10).Shape(), arm).Shape();
  const CadModel model(std::make_shared<CadShape>(part, "arm"));
  ExecutionContext context(1);
  MeshOptions options;
  for (const double divisor : {30.0, 60.0}) {
    options.sizing.size = model.diagonal() / divisor;
    const double real = static_cast<double>(mesh(model, options, context).quads.size());
    EXPECT_LT(factor(real, QuadEstimate(model, context).quads(options)), 1.25) << divisor;
  }
}

/// Whatever was asked before, a suggestion gives the number of quads, or is the largest size there is.
TEST(QuadEstimate, FindsASizeForEachNumber) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    ExecutionContext context(1);
    QuadEstimate up(model, context), down(model, context);
    const double numbers[] = {1e3, 1e4, 1e5};
    for (std::size_t i = 0; i < std::size(numbers); ++i) {
      for (QuadEstimate* estimate : {&up, &down}) {
        const double wanted = numbers[estimate == &up ? i : std::size(numbers) - 1 - i];
        const QuadEstimate::Suggestion found = estimate->size_for(wanted);
        const bool is_largest = found.size > 0.0995 * model.diagonal() && found.quads > wanted;
        EXPECT_TRUE(is_largest || factor(found.quads, wanted) < 1.15)
            << wanted << ": size " << found.size << " for " << found.quads;
      }
    }
  }
}

}  // namespace
}  // namespace quadrille
