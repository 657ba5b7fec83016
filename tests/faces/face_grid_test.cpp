/// Faces as grids, and the counts and spacings on edges that make them so.

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

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

bool is_told_as_grid(const ShellMesh::Face& face) {
  return face.note.find("grid") != std::string::npos;
}

TEST(FaceGrid, LeavesOtherFacesAlone) {
  for (const char* name : {"disc", "plate_with_holes", "sphere"}) {
    const ShellMesh shell = mesh_sample(name, 3);
    ASSERT_EQ(static_cast<int>(shell.faces.size()), sample_model(name).faces) << name;
    for (const auto& face : shell.faces) {
      EXPECT_FALSE(is_told_as_grid(face)) << name << ": " << face.note;
      EXPECT_GT(irregular_inside(shell, face.face), 0) << name;
    }
  }
  const ShellMesh box = mesh_sample("box", 3);  // where there are grids, they are told
  EXPECT_TRUE(std::all_of(box.faces.begin(), box.faces.end(), is_told_as_grid));
}

/// A plate of the outline, 4 thick.
CadModel plate_of(const std::vector<std::array<double, 2>>& outline) {
  BRepBuilderAPI_MakePolygon wire;
  for (const auto& [x, y] : outline) wire.Add(gp_Pnt(x, y, 0));
  wire.Close();
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(wire.Wire(), true);
  return CadModel(std::make_shared<CadShape>(BRepPrimAPI_MakePrism(face, gp_Vec(0, 0, 4)).Shape(), "plate"));
}

/// Plates whose outlines turn by right angles both ways need no grids: hardly a node is irregular.
TEST(FaceGrid, IsNotNeededForSteps) {
  const std::map<std::string, std::vector<std::array<double, 2>>> outlines{
      {"L", {{0, 0}, {40, 0}, {40, 11}, {13, 11}, {13, 35}, {0, 35}}},
      {"T", {{20, 0}, {30, 0}, {30, 25}, {52, 25}, {52, 33}, {0, 33}, {0, 25}, {20, 25}}},
      {"U", {{0, 0}, {50, 0}, {50, 30}, {38, 30}, {38, 9}, {11, 9}, {11, 27}, {0, 27}}},
      {"Z", {{0, 0}, {30, 0}, {30, 20}, {55, 20}, {55, 28}, {22, 28}, {22, 8}, {0, 8}}},
      {"stairs",
       {{0, 0}, {40, 0}, {40, 40}, {30, 40}, {30, 30}, {20, 30}, {20, 18}, {9, 18}, {9, 8}, {0, 8}}},
      {"cross",
       {{20, 0},
        {31, 0},
        {31, 20},
        {50, 20},
        {50, 30},
        {31, 30},
        {31, 52},
        {20, 52},
        {20, 30},
        {0, 30},
        {0, 20},
        {20, 20}}}};
  for (const auto& [name, outline] : outlines) {
    const CadModel plate = plate_of(outline);
    for (const double size : {1.4, 2.0, 3.1}) {
      MeshOptions options;
      options.sizing.size = size;
      ExecutionContext context;
      const ShellMesh shell = mesh(plate, options, context);
      EXPECT_EQ(check_criteria(shell).failing, 0) << name << " / " << size;
      for (const auto& face : shell.faces) {
        EXPECT_GT(face.q_min, 0.5) << name << " / " << size << " Face" << face.face;
        EXPECT_LE(irregular_inside(shell, face.face), 6) << name << " / " << size << " Face" << face.face;
      }
    }
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
      sample_edges(model.shape(), field, 2, FaceFlags(6, 1), SamplingPlan(model.shape()), context);
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
  for (const FacePlan& plan : nodes.plans) {
    const FaceSides& sides = plan.sides;
    EXPECT_EQ(sides.kind, GridKind::four);
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
