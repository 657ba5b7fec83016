/// Counts stay near the wanted ones, agree across faces, and have even sums.

#include "mesher/edges/edge_counts.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "geometry/base/error.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

struct Counted {
  FaceOutlines sides;
  EdgeCounts chosen;
};

Counted counted(const CadShape& shape, double size, int stride, const std::vector<int>& fixed = {}) {
  CountTargets targets;
  targets.stride = stride;
  targets.wanted.resize(shape.edges.size());
  targets.least.assign(shape.edges.size(), 1);
  targets.least_of_grids.assign(shape.edges.size(), 1);
  targets.fixed.assign(shape.edges.size(), 0);
  for (const EdgeId edge : shape.edges.ids()) {
    if (shape.edges[edge].degenerate) targets.least[edge] = 0;
    targets.wanted[edge] = shape.edges[edge].length / size / stride;
    if (!fixed.empty()) targets.fixed[edge] = fixed[edge.index()];
  }
  const TinyFeatures tiny = SamplingPlan(shape).tiny;
  FaceOutlines sides = find_face_sides(shape, FaceFlags(shape.faces.size(), 1), tiny, targets.wanted);
  EdgeCounts chosen = choose_counts(shape, targets, tiny, sides);
  return {std::move(sides), std::move(chosen)};
}

int sum(const IdVector<EdgeId, int>& counts, const FaceSide& side) {
  int total = 0;
  for (const SideEdge& edge : side) total += counts[edge.edge];
  return total;
}

TEST(EdgeCounts, AgreeAcrossFacesAndAreEvenAroundThem) {
  int facing = 0;
  for (const SampleModel& sample : sample_models()) {
    const CadModel model = CadModel::read(sample.path());
    const CadShape& shape = model.shape();
    for (const int stride : {1, 2}) {
      SCOPED_TRACE(sample.name + ", stride " + std::to_string(stride));
      const auto [sides, chosen] = counted(shape, model.diagonal() / 40, stride);
      for (const EdgeId edge : shape.edges.ids())
        EXPECT_EQ(chosen.counts[edge] > 0, !shape.edges[edge].degenerate) << edge.number();
      for (const FaceId face : shape.faces.ids()) {
        int around = 0;
        for (const CadWire& wire : shape.faces[face].wires)
          for (const Coedge& coedge : wire.coedges) around += chosen.counts[coedge.edge];
        EXPECT_TRUE(stride == 2 || around % 2 == 0) << "Face" << face.number();
        for (const FacingPair& pair : sides[face].facing) {
          EXPECT_EQ(sum(chosen.counts, pair.first), sum(chosen.counts, pair.second));
          ++facing;
        }
      }
    }
  }
  EXPECT_GT(facing, 50);
}

TEST(EdgeCounts, StayNearTheWantedOnes) {
  const CadModel model = testing::sheet({{{0, 0}, {20, 0}, {20, 12}, {0, 12}}});
  const CadShape& shape = model.shape();
  const Counted result = counted(shape, 1, 1);
  for (const EdgeId edge : shape.edges.ids())
    EXPECT_NEAR(result.chosen.counts[edge], shape.edges[edge].length, 1);
}

TEST(EdgeCounts, KeepFixedOnesOrRefuseThem) {
  const CadModel model = testing::sheet({{{0, 0}, {20, 0}, {20, 12}, {0, 12}}});
  const CadShape& shape = model.shape();
  std::vector<int> fixed(shape.edges.size(), 0);
  fixed[0] = 9;
  const Counted result = counted(shape, 1, 1, fixed);
  EXPECT_EQ(result.chosen.counts[edge_id(1)], 9);
  for (const EdgeId edge : shape.edges.ids()) {  // the opposite edge follows
    if (result.chosen.chords.of(edge) != result.chosen.chords.of(edge_id(1))) continue;
    EXPECT_EQ(result.chosen.counts[edge], 9);
  }
  fixed = {9, 8, 8, 8};
  EXPECT_THROW(counted(shape, 1, 1, fixed), Error);
}

}  // namespace
}  // namespace quadrille
