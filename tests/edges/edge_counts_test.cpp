/// Counts that users prescribe, and long work that looks at its time limit.

#include "mesher/edges/edge_counts.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesher/quadrille.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

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

TEST(EdgeCounts, NameTheNearestNumbersThatWork) {
  // No grid fills it.
  const CadModel model = sheet({{{0, 0}, {20, 0}, {30, 10}, {26, 24}, {10, 30}, {-4, 22}, {-6, 8}}});
  const std::string whole = refusal(model, Strategy::subdivide, {4, 4, 4, 4, 4, 4, 2});
  EXPECT_TRUE(contains(whole, "use 2 or 6 on Edge1, or 2 or 6 on Edge2")) << whole;
  EXPECT_TRUE(contains(whole, "or 4 on Edge7")) << whole;
  EXPECT_TRUE(contains(whole, "multiple of four")) << whole;
  for (const int works : {2, 6})
    EXPECT_EQ(refusal(model, Strategy::subdivide, {works, 4, 4, 4, 4, 4, 2}), "");
  EXPECT_EQ(refusal(model, Strategy::subdivide, {4, 4, 4, 4, 4, 4, 4}), "");
  for (const int fails : {3, 5})
    EXPECT_NE(refusal(model, Strategy::subdivide, {fails, 4, 4, 4, 4, 4, 2}), "");
  const std::string direct = refusal(model, Strategy::direct, {4, 4, 4, 4, 4, 4, 1});
  EXPECT_TRUE(contains(direct, "an odd number of segments around it: use 3 or 5 on Edge1")) << direct;
  EXPECT_TRUE(contains(direct, "or 2 on Edge7")) << direct;
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
