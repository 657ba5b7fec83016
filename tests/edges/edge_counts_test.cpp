/// Counts stay near the wanted ones, agree across faces, have even sums, and are refused or stopped in words.

#include "mesher/edges/edge_counts.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "geometry/base/error.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quadrille.hpp"
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

using testing::sheet;

/// What meshing says with these numbers of segments on Edge1, Edge2, ...; empty = it succeeds.
std::string refusal(const CadModel& model, Strategy strategy, const std::vector<int>& segments) {
  MeshOptions options;
  options.sizing.size = 3;
  options.strategy = strategy;
  for (std::size_t i = 0; i < segments.size(); ++i)
    options.sizing.spacings[static_cast<int>(i) + 1] = {.segments = segments[i]};
  ExecutionContext context(1);
  try {
    mesh(model, options, context);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(EdgeCounts, SayWhichNumbersWork) {
  // No grid fills it.
  const CadModel model = sheet({{{0, 0}, {20, 0}, {30, 10}, {26, 24}, {10, 30}, {-4, 22}, {-6, 8}}});
  const std::string whole = refusal(model, Strategy::subdivide, {4, 4, 4, 4, 4, 4, 2});
  EXPECT_TRUE(contains(whole, "use 2 more or less on one of Edge1, Edge2")) << whole;
  EXPECT_TRUE(contains(whole, "multiple of four")) << whole;
  for (const int works : {2, 6})
    EXPECT_EQ(refusal(model, Strategy::subdivide, {works, 4, 4, 4, 4, 4, 2}), "");
  EXPECT_EQ(refusal(model, Strategy::subdivide, {4, 4, 4, 4, 4, 4, 4}), "");
  for (const int fails : {3, 5})
    EXPECT_NE(refusal(model, Strategy::subdivide, {fails, 4, 4, 4, 4, 4, 2}), "");
  const std::string direct = refusal(model, Strategy::direct, {4, 4, 4, 4, 4, 4, 1});
  EXPECT_TRUE(contains(direct, "an odd number of segments around it: use 1 more or less on one of Edge1"))
      << direct;
  EXPECT_EQ(refusal(model, Strategy::direct, {3, 4, 4, 4, 4, 4, 1}), "");
  EXPECT_EQ(refusal(model, Strategy::direct, {4, 4, 4, 4, 4, 4, 2}), "");
}

/// A sheet of rows x rows squares, whose edges all want less than one segment.
struct LargeSheet {
  explicit LargeSheet(int rows) : model(sheet(squares(rows))) {
    const std::size_t edges = model.shape().edges.size();
    targets.stride = 2;
    targets.wanted.assign(edges, 0.4);
    targets.least.assign(edges, 1);
    targets.least_of_grids.assign(edges, 1);
    targets.fixed.assign(edges, 0);
    targets.even.assign(edges, 0);
  }

  static std::vector<testing::Polygon> squares(int rows) {
    std::vector<testing::Polygon> result;
    for (double y = 0; y < rows; ++y)
      for (double x = 0; x < rows; ++x) result.push_back({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
    return result;
  }

  EdgeCounts choose() {
    const FaceFlags used(model.face_count(), 1);
    const TinyFeatures tiny =
        find_tiny_features(model.shape(), used, EdgeFlags(model.shape().edges.size()), 0);
    FaceOutlines sides = find_face_sides(model.shape(), used, tiny, targets.wanted);
    for (FaceSides& face : sides) face.drop_facing();
    return choose_counts(model.shape(), targets, tiny, sides);
  }

  CadModel model;
  CountTargets targets;
};

TEST(EdgeCounts, CheckForTheEndOfTheTimeAllAlong) {
  LargeSheet large(60);
  int calls = 0;
  large.targets.check = [&] { ++calls; };
  large.choose();
  const int edges = static_cast<int>(large.model.shape().edges.size());
  EXPECT_GE(calls, edges);
  ExecutionContext context(1);
  const int enough = calls / 2;
  calls = 0;
  large.targets.check = [&] {
    if (++calls == enough) context.limit_time(1e-9);
    context.check();
  };
  EXPECT_THROW(large.choose(), Error);
  EXPECT_LE(calls, enough + 1);
}

}  // namespace
}  // namespace quadrille
