/// Plans follow the outlines and the counts on their edges.

#include "mesher/edges/face_plan.hpp"

#include <gtest/gtest.h>

#include "mesher/edges/edge_sampling.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

BoundaryNodes sampled(const CadModel& model, double size, int stride) {
  ExecutionContext context(1);
  SizingOptions options;
  options.size = size;
  const SizingField field = SizingField::build(model, options, context);
  return sample_edges(model.shape(), field, stride, FaceFlags(model.shape().faces.size(), 1),
                      SamplingPlan(model.shape()), context);
}

TEST(FacePlan, CountsTheQuadsOfAGrid) {
  const CadModel model = testing::sheet({{{0, 0}, {20, 0}, {20, 12}, {0, 12}}});
  const BoundaryNodes nodes = sampled(model, 2, 1);
  const FacePlan& plan = nodes.plans[face_id(1)];
  EXPECT_EQ(plan.grid_quads, 60);
  EXPECT_TRUE(plan.is_filled());
  EXPECT_FALSE(plan.has_kept_edge || plan.has_divided_edge || plan.keeps_rows());
}

TEST(FacePlan, KnowsHoles) {
  const CadModel plate = CadModel::read(sample_model("plate_with_holes").path());
  const BoundaryNodes holed = sampled(plate, 3, 1);
  const FacePlan& plan = holed.plans[face_id(1)];
  EXPECT_FALSE(plan.is_filled());
  EXPECT_TRUE(plan.sides.has_holes());
  EXPECT_EQ(plan.grid_quads, 0);
}

/// Quads are cut in four only where all edges have even numbers of segments.
TEST(FacePlan, SubdividesOnlyWhatIsEven) {
  int cut = 0;
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    const CadShape& shape = model.shape();
    for (const int stride : {1, 2}) {
      const BoundaryNodes nodes = sampled(model, model.diagonal() / 30, stride);
      for (const FaceId face : shape.faces.ids()) {
        bool even = true;
        for (const CadWire& wire : shape.faces[face].wires)
          for (const Coedge& coedge : wire.coedges)
            even &= shape.edges[coedge.edge].degenerate || nodes.edges[coedge.edge].segments() % 2 == 0;
        const int expected = stride == 2 && even ? 2 : 1;
        EXPECT_EQ(nodes.plans[face].stride, expected) << sample.name << " Face" << face.number();
        cut += expected == 2;
      }
    }
  }
  EXPECT_GT(cut, 10);
}

}  // namespace
}  // namespace quadrille
