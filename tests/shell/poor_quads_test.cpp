/// What forces quads outside the limits is named: a short edge, two edges that come close, a sharp corner.

#include "mesher/shell/poor_quads.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using namespace testing;

ShellMesh meshed(const CadModel& model, double size, double least) {
  MeshOptions options;
  options.sizing.size = size;
  options.sizing.size_min = least;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

/// Quads that fail any criterion but warp.
int failing(const ShellMesh& mesh) {
  CriteriaLimits limits = limits_of(mesh);
  limits.values[static_cast<std::size_t>(Criterion::warp)] = unchecked;
  return check_criteria(mesh, limits).failing;
}

int quads_of(const ShellMesh& mesh) {
  int sum = 0;
  for (const auto& found : mesh.poor_quads) sum += found.quads;
  return sum;
}

TEST(PoorQuads, AnEdgeShorterThanTheLeastSizeIsNamed) {
  // A notch 0.8 wide and 6 deep in a plate, least size 1: two segments on its base are 0.4 long.
  const CadModel model =
      sheet({{{0, 0}, {20, 0}, {20, 20}, {10.8, 20}, {10.8, 14}, {10, 14}, {10, 20}, {0, 20}}});
  const ShellMesh mesh = meshed(model, 4, 1);
  ASSERT_FALSE(mesh.poor_quads.empty());
  bool is_edge = false;
  for (const auto& found : mesh.poor_quads) {
    EXPECT_FALSE(found.why.empty());
    is_edge |= found.dimension == 1 && found.why == "it is 0.8 long" && found.is_forced();
  }
  EXPECT_TRUE(is_edge);
  EXPECT_EQ(quads_of(mesh), failing(mesh));
}

TEST(PoorQuads, EdgesThatComeCloseAreNamed) {
  // Two plates joined by a neck 0.7 wide: the reach is 0.5, so that the neck stays.
  const CadModel model = sheet({{{0, 0},
                                 {10, 0},
                                 {10, 4.65},
                                 {14, 4.65},
                                 {14, 0},
                                 {24, 0},
                                 {24, 10},
                                 {14, 10},
                                 {14, 5.35},
                                 {10, 5.35},
                                 {10, 10},
                                 {0, 10}}});
  const ShellMesh mesh = meshed(model, 3, 1);
  ASSERT_FALSE(mesh.poor_quads.empty());
  EXPECT_EQ(mesh.poor_quads[0].dimension, 2);
  EXPECT_EQ(quads_of(mesh), failing(mesh));
  EXPECT_NE(mesh.poor_quads[0].why.find("come within 0.7"), std::string::npos) << mesh.poor_quads[0].why;
}

TEST(PoorQuads, ASharpCornerIsNamed) {
  const CadModel model = sheet({{{0, 0}, {40, 0}, {40, 10}}});  // 14 degrees
  MeshOptions options;
  options.sizing.size = 2;
  options.keep_features = true;
  ExecutionContext context(1);
  const ShellMesh mesh = quadrille::mesh(model, options, context);
  ASSERT_FALSE(mesh.poor_quads.empty());
  EXPECT_EQ(quads_of(mesh), failing(mesh));
  EXPECT_TRUE(std::any_of(mesh.poor_quads.begin(), mesh.poor_quads.end(), [](const auto& poor) {
    return poor.why.find("its sides meet at 14 degrees at Vertex") != std::string::npos;
  }));
}

TEST(PoorQuads, NothingIsToldOfLargeFeaturesAndUnknownSizes) {
  const CadModel model = sheet({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}});
  ShellMesh mesh = meshed(model, 4, 1);
  EXPECT_TRUE(mesh.poor_quads.empty());
  EXPECT_EQ(mesh.size_min, 1);
  mesh.size_min = 100;
  EXPECT_FALSE(poor_quads(model.shape(), mesh).empty());
  mesh.size_min = 0;
  EXPECT_TRUE(poor_quads(model.shape(), mesh).empty());
}

TEST(SmallFeatures, FollowTheReach) {
  // A step of 0.2 in the rim.
  const CadModel model = sheet({{{0, 0}, {20, 0}, {20, 20}, {10, 20}, {10, 19.8}, {0, 19.8}}});
  const auto found = [&](double reach, bool keep) {
    MeshOptions options;
    options.sizing.size = 4;
    options.sizing.size_min = 1;
    options.reach = reach;
    options.keep_features = keep;
    return small_features(model, options);
  };
  const SmallFeatures usual = found(0, false);
  ASSERT_FALSE(usual.suppressed_features.empty());
  EXPECT_EQ(usual.suppressed_features[0].kind, ShellMesh::SuppressedFeature::Kind::edge);
  EXPECT_NEAR(usual.suppressed_features[0].distance, 0.2, 1e-9);
  EXPECT_TRUE(found(0.1, false).suppressed_features.empty());
  EXPECT_FALSE(found(0.3, false).suppressed_features.empty());
  EXPECT_TRUE(found(0, true).suppressed_features.empty());
}

TEST(PoorQuads, ASettingOnOneEdgeChangesNothingElsewhere) {
  // The notch of the first test, and far from it an edge with ten segments.
  const CadModel model =
      sheet({{{0, 0}, {20, 0}, {20, 20}, {10.8, 20}, {10.8, 14}, {10, 14}, {10, 20}, {0, 20}},
             {{100, 0}, {120, 0}, {120, 20}, {100, 20}}});
  const auto at_notch = [&](const MeshOptions& options) {
    ExecutionContext context(1);
    const ShellMesh mesh = quadrille::mesh(model, options, context);
    int quads = 0;
    for (const auto& found : mesh.poor_quads) quads += found.quads;
    return quads;
  };
  MeshOptions options;
  options.sizing.size = 4;
  options.sizing.size_min = 1;
  const int before = at_notch(options);
  ASSERT_GT(before, 0);
  int far = 0;
  for (const CadEdge& edge : model.shape().edges)
    if (model.shape().vertices[edge.first_vertex].x() > 90) far = edge.number;
  ASSERT_GT(far, 0);
  options.sizing.spacings[far].segments = 40;  // each 0.5 long: no shorter than asked for
  EXPECT_EQ(at_notch(options), before);
  options.sizing.spacings.clear();
  options.sizing.edge_sizes[far] = 0.25;
  EXPECT_EQ(at_notch(options), before);
}

}  // namespace
}  // namespace quadrille
