/// Faces as grids, and the counts and spacings on edges that make them so.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/faces/face_grid.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

ShellMesh mesh_sample(const std::string& name, double size, Strategy strategy = Strategy::subdivide) {
  MeshOptions options;
  options.sizing.size = size;
  options.strategy = strategy;
  ExecutionContext context;
  return mesh(CadModel::read(sample_model(name).path()), options, context);
}

/// Nodes inside faces that do not have four quads.
int irregular_inside(const ShellMesh& shell, int face) {
  std::map<int, int> valence;
  std::map<int, bool> inside;
  for (std::size_t i = 0; i < shell.quads.size(); ++i) {
    for (const int node : shell.quads[i]) {
      ++valence[node];
      const bool here = shell.quad_faces[i] == face;
      inside[node] = (inside.contains(node) ? inside[node] : true) && here;
    }
  }
  for (const auto& segment : shell.segments) inside[segment.nodes[0]] = inside[segment.nodes[1]] = false;
  return static_cast<int>(std::count_if(inside.begin(), inside.end(), [&](const auto& node) {
    return node.second && valence[node.first] != 4;
  }));
}

TEST(FaceGrid, TakesFourSidedFacesAndWalls) {
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    const ShellMesh box = mesh_sample("box", 1.7, strategy);
    for (const auto& face : box.faces) {
      EXPECT_EQ(face.note, "grid") << face.face;
      EXPECT_GT(face.q_min, 0.99);
      EXPECT_EQ(irregular_inside(box, face.face), 0);
    }
    const ShellMesh cylinder = mesh_sample("cylinder", 2.5, strategy);
    int grids = 0;
    for (const auto& face : cylinder.faces) {
      grids += face.note == "grid";
      if (face.note != "grid") continue;
      EXPECT_EQ(irregular_inside(cylinder, face.face), 0);
    }
    EXPECT_EQ(grids, 1);
  }
}

TEST(FaceGrid, LeavesOtherFacesAlone) {
  for (const char* name : {"disc", "plate_with_holes", "sphere"}) {
    const ShellMesh shell = mesh_sample(name, 3);
    for (const auto& face : shell.faces) EXPECT_NE(face.note, "grid") << name;
  }
}

/// Between grids a count need not be even, so that strips narrower than the size get one row.
TEST(FaceGrid, NeedsNoSubdivision) {
  const ShellMesh shell = mesh_sample("box", 9);
  std::map<int, int> segments;
  for (const auto& segment : shell.segments) ++segments[segment.edge];
  EXPECT_EQ(segments.size(), 12U);
  std::map<int, int> counts;
  for (const auto& [edge, count] : segments) ++counts[count];
  EXPECT_EQ(counts, (std::map<int, int>{{1, 4}, {2, 4}, {3, 4}}));
}

/// Edges that run along each other across faces have their nodes at the same shares of their lengths, and the
/// spacing is that of the tightest.
TEST(Chords, ShareTheirSpacing) {
  const CadModel model = CadModel::read(sample_model("box").path());
  SizingOptions sizing;
  sizing.size = 2;
  sizing.vertex_sizes[1] = 0.4;
  ExecutionContext context;
  const SizingField field = SizingField::build(model, sizing, context);
  const BoundaryNodes nodes =
      sample_edges(model.shape(), field, 2, std::vector<char>(6, 1), SamplingPlan(model.shape()), context);
  const auto shares = [&](const SideEdge& side) {
    std::vector<double> result;
    const auto& edge = nodes.edges[side.edge];
    for (const int node : edge.nodes)
      result.push_back((nodes.points[node] - nodes.points[edge.nodes.front()]).norm() /
                       model.shape().edges[side.edge].length);
    if (side.forward) return result;
    std::reverse(result.begin(), result.end());
    for (double& share : result) share = 1 - share;
    return result;
  };
  int pairs = 0;
  for (const FaceSides& sides : nodes.sides) {
    EXPECT_EQ(sides.outline, FaceSides::Outline::four);
    for (const FacingPair& pair : sides.facing) {
      ASSERT_EQ(pair.first.size(), 1U);
      ASSERT_EQ(pair.second.size(), 1U);
      const std::vector<double> a = shares(pair.first[0]), b = shares(pair.second[0]);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
      ++pairs;
      double shortest = 1, longest = 0;
      for (std::size_t i = 1; i < a.size(); ++i) {
        shortest = std::min(shortest, a[i] - a[i - 1]);
        longest = std::max(longest, a[i] - a[i - 1]);
      }
      EXPECT_GT(longest, 2 * shortest);
    }
  }
  EXPECT_EQ(pairs, 12);
}

}  // namespace
}  // namespace quadrille
