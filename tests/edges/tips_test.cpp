/// Faces end where they narrow towards a tip.

#include "mesher/edges/tips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesher/edges/tiny_features.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/shell/validate.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

using namespace testing;

/// A plate of 100 by 100, with a wedge between two faces: its tip lies at (10, 50), its base at x = 100.
CadModel plate_with_wedge(double base) {
  const double low = 50 - 0.5 * base, high = 50 + 0.5 * base;
  return sheet({{{10, 50}, {100, low}, {100, high}},
                {{0, 0}, {100, 0}, {100, low}, {10, 50}, {0, 50}},
                {{0, 50}, {10, 50}, {100, high}, {100, 100}, {0, 100}}});
}

std::vector<Tip> tips_of(const CadModel& model, double width) {
  const FaceFlags used(model.face_count(), 1);
  const TinyFeatures tiny = find_tiny_features(model.shape(), used, EdgeFlags(model.shape().edges.size()), 0);
  return find_tips(model.shape(), used, tiny, width);
}

ShellMesh meshed(const CadModel& model, MeshOptions options = {}) {
  options.sizing.size = 10;
  ExecutionContext context(1);
  return mesh(model, options, context);
}

/// Whether the face's note says that it ends early.
bool ends_early(const ShellMesh& mesh, int face) {
  return mesh.faces[face - 1].note.find("tip") != std::string::npos;
}

TEST(Tips, AreFoundWhereTwoEdgesStayCloserThanTheWidth) {
  const CadModel model = plate_with_wedge(10);
  const auto tips = tips_of(model, 0.625);
  ASSERT_EQ(tips.size(), 1U);
  EXPECT_EQ(tips[0].face.number(), 1);
  const CadShape& shape = model.shape();
  const double share = 0.625 / 10;  // of the wedge
  for (const Tip::Flank& side : {tips[0].before, tips[0].after}) {
    const CadEdge& edge = shape.edges[side.edge];
    const double from_tip = side.at_end ? edge.last - side.parameter : side.parameter - edge.first;
    EXPECT_NEAR(from_tip / (edge.last - edge.first), share, 0.1 * share);
    const Vector3& tip = shape.vertices[side.at_end ? edge.last_vertex : edge.first_vertex];
    EXPECT_NEAR((tip - Vector3(10, 50, 0)).norm(), 0, 1e-6);
  }
}

TEST(Tips, AreNoneWithoutAWidthOrInBluntCorners) {
  EXPECT_TRUE(tips_of(plate_with_wedge(10), 0).empty());
  EXPECT_TRUE(tips_of(plate_with_wedge(60), 0.625).empty());
  EXPECT_TRUE(tips_of(plate_with_wedge(10), 6).empty());  // most of the wedge
}

TEST(Tips, AreLeftOutOfTheMesh) {
  const CadModel model = plate_with_wedge(10);
  const ShellMesh early = meshed(model);
  MeshOptions options;
  options.keep_features = true;
  const ShellMesh whole = meshed(model, options);
  for (const ShellMesh* mesh : {&early, &whole}) EXPECT_EQ(validate(*mesh), std::vector<std::string>{});
  EXPECT_TRUE(ends_early(early, 1));
  EXPECT_FALSE(ends_early(whole, 1));
  EXPECT_LE(check_criteria(early).failing, check_criteria(whole).failing);
  // The wedge is 5.6 long where it is narrower than half the minimum size, 0.625.
  const auto first = [](const ShellMesh& mesh) {
    double least = 100;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      if (mesh.quad_faces[i] != 1) continue;
      for (const int node : mesh.quads[i]) least = std::min(least, mesh.points[node].x());
    }
    return least;
  };
  EXPECT_NEAR(first(whole), 10, 1e-6);
  EXPECT_GT(first(early), 11);
  EXPECT_LT(first(early), 17);
  // Nothing is open but the rim of the plate, and the whole plate is covered.
  double area = 0;
  for (const auto& [a, b, c, d] : early.quads) {
    const auto& p = early.points;
    area += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm();
  }
  EXPECT_NEAR(area, 100 * 100, 1e-6);
}

TEST(Tips, StayBesideEdgesThatUsersDivide) {
  const CadModel model = plate_with_wedge(10);
  const auto tips = tips_of(model, 0.625);
  MeshOptions options;
  options.sizing.spacings[model.shape().edges[tips.at(0).before.edge].number] = {.segments = 40};
  EXPECT_FALSE(ends_early(meshed(model, options), 1));
}

TEST(Tips, EndMeshesOfTheSecondOrderToo) {
  MeshOptions options;
  options.order = 2;
  const ShellMesh mesh = meshed(plate_with_wedge(10), options);
  EXPECT_TRUE(ends_early(mesh, 1));
  EXPECT_EQ(validate(mesh), std::vector<std::string>{});
}

}  // namespace
}  // namespace quadrille
