/// Short edges become points, slivers become edges, and nothing else changes.

#include "mesher/edges/tiny_features.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

TinyFeatures tiny_of(const CadShape& shape, double length) {
  return find_tiny_features(shape, FaceFlags(shape.faces.size(), 1), EdgeFlags(shape.edges.size()), length);
}

TEST(TinyFeatures, AreNoneWithoutALength) {
  for (const SampleModel& sample : sample_models()) {
    SCOPED_TRACE(sample.name);
    const CadModel model = CadModel::read(sample.path());
    const TinyFeatures tiny = tiny_of(model.shape(), 0);
    for (const VertexId vertex : tiny.vertices.ids()) EXPECT_EQ(tiny.vertices[vertex], vertex);
    for (const EdgeId edge : tiny.edges.ids()) EXPECT_EQ(tiny.edges[edge], edge);
    EXPECT_EQ(std::count(tiny.merged_faces.begin(), tiny.merged_faces.end(), 1), 0);
  }
}

TEST(TinyFeatures, ShortEdgesBecomePoints) {
  const CadModel model = testing::sheet({{{0, 0}, {10, 0}, {10, 5.9}, {9.9, 6}, {0, 6}}});
  const CadShape& shape = model.shape();
  const TinyFeatures tiny = tiny_of(shape, 0.2);
  for (const EdgeId id : shape.edges.ids()) {
    const CadEdge& edge = shape.edges[id];
    EXPECT_EQ(tiny.collapsed_edges[id] != 0, edge.length < 0.2);
    EXPECT_EQ(tiny.closed(edge), edge.length < 0.2);
  }
  EXPECT_EQ(std::count(tiny.merged_faces.begin(), tiny.merged_faces.end(), 1), 0);
}

/// Between two plates lies a strip 0.1 wide. Its long edges share their nodes, which both plates use.
TEST(TinyFeatures, ANarrowStripBecomesAnEdge) {
  const CadModel model = testing::sheet({{{0, 0}, {10, 0}, {10, 5}, {0, 5}},
                                         {{0, 5}, {10, 5}, {10, 5.1}, {0, 5.1}},
                                         {{0, 5.1}, {10, 5.1}, {10, 9}, {0, 9}}});
  const CadShape& shape = model.shape();
  const TinyFeatures tiny = tiny_of(shape, 0.2);
  FaceFlags used(shape.faces.size(), 1);
  for (const FaceId face : shape.faces.ids()) {
    EXPECT_EQ(tiny.merged_faces[face] != 0, face == face_id(2));
    used[face] = !tiny.merged_faces[face];
  }
  const auto uses = uses_of_nodes(shape, used, tiny);
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 2), 1);
  int shared = 0;
  for (const EdgeId edge : shape.edges.ids()) shared += tiny.edges[edge] != edge;
  EXPECT_EQ(shared, 1);
}

TEST(TinyFeatures, DistancesAreMeasuredAlongTheWholeEdge) {
  const CadModel model = testing::sheet({{{0, 0}, {10, 0}, {10, 3}, {0, 1}}});
  const CadShape& shape = model.shape();
  const auto edge_at = [&](const Vector3& middle) -> const CadEdge& {
    return *std::find_if(shape.edges.begin(), shape.edges.end(), [&](const CadEdge& edge) {
      return (points_along(edge, 2).at(1) - middle).norm() < 1e-9;
    });
  };
  const CadEdge &low = edge_at({5, 0, 0}), &high = edge_at({5, 2, 0});
  EXPECT_GT(distance_between(high, low), 2.5);
  EXPECT_LE(distance_between(high, low), 3);
  EXPECT_TRUE(is_small(low, 10.1));
  EXPECT_FALSE(is_small(low, 9));
}

}  // namespace
}  // namespace quadrille
