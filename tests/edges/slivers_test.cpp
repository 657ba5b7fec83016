/// Faces narrower than half the minimum size, with any number of edges.

#include "mesher/edges/slivers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// Two faces below and two above a strip of the given width, which end at 40 below and at 70 above.
CadModel strip_between_faces(double width) {
  const double top = 20 + width;
  return sheet({{{0, 0}, {40, 0}, {40, 20}, {0, 20}},
                {{40, 0}, {100, 0}, {100, 20}, {40, 20}},
                {{0, 20}, {40, 20}, {100, 20}, {100, top}, {70, top}, {0, top}},
                {{0, top}, {70, top}, {70, 40}, {0, 40}},
                {{70, top}, {100, top}, {100, 40}, {70, 40}}});
}

FaceFlags all_faces(const CadModel& model) {
  return FaceFlags(model.face_count(), 1);
}

TEST(Slivers, AreDividedWhereVerticesFaceTheInsideOfAnEdge) {
  const CadModel model = strip_between_faces(0.02);
  ASSERT_EQ(model.face_count(), 5);
  EXPECT_TRUE(find_slivers(model.shape(), all_faces(model), 0.5).empty());  // the vertices do not face
  const auto divided = divided_at_slivers(model.shape(), all_faces(model), 0.5);
  ASSERT_TRUE(divided);
  EXPECT_EQ(divided->edges.size(), model.shape().edges.size() + 2);
  EXPECT_EQ(divided->vertices.size(), model.shape().vertices.size() + 2);
  const auto slivers = find_slivers(*divided, all_faces(model), 0.5);
  ASSERT_EQ(slivers.size(), 1U);
  EXPECT_EQ(slivers[0].pairs.size(), 3U);
  EXPECT_EQ(slivers[0].ties.size(), 2U);
  double length = 0;
  for (const Sliver::Pair& pair : slivers[0].pairs) {
    EXPECT_NEAR(divided->edges[pair.edge].length, divided->edges[pair.other].length, 1e-3);
    length += divided->edges[pair.edge].length;
  }
  EXPECT_NEAR(length, 100, 1e-6);
  EXPECT_FALSE(divided_at_slivers(*divided, all_faces(model), 0.5));
}

TEST(Slivers, AreNoneAboveTheWidth) {
  const CadModel model = strip_between_faces(0.6);
  EXPECT_FALSE(divided_at_slivers(model.shape(), all_faces(model), 0.5));
  EXPECT_FALSE(divided_at_slivers(model.shape(), all_faces(model), 0));
  EXPECT_TRUE(find_slivers(model.shape(), all_faces(model), 0.5).empty());
}

TEST(Slivers, GoFromTheMesh) {
  const CadModel model = strip_between_faces(0.02);
  MeshOptions options;
  options.sizing.size = 10;
  ExecutionContext context(1);
  const ShellMesh mesh = quadrille::mesh(model, options, context);
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
  EXPECT_EQ(check_criteria(mesh).failing, 0);
  const auto merged = std::count_if(mesh.faces.begin(), mesh.faces.end(),
                                    [](const auto& face) { return face.status == FaceStatus::merged; });
  EXPECT_EQ(merged, 1);
  for (const auto& corner : mesh.corners) EXPECT_LE(corner.vertex, model.vertex_count());
  for (const auto& segment : mesh.segments) EXPECT_LE(segment.edge, model.edge_count());
  options.keep_features = true;
  EXPECT_GT(check_criteria(quadrille::mesh(model, options, context)).failing, 0);
}

}  // namespace
}  // namespace quadrille
