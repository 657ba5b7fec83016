/// Rows of flat quads beside edges: layers and divisions that grids carry.

#include "mesher/edges/grid_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/ids.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/sheet.hpp"

namespace quadrille {
namespace {

ShellMesh mesh_of(const CadModel& model, const MeshOptions& options) {
  ExecutionContext context;
  return mesh(model, options, context);
}

int count_grids(const ShellMesh& mesh) {
  return static_cast<int>(
      std::count_if(mesh.faces.begin(), mesh.faces.end(),
                    [](const ShellMesh::Face& face) { return face.note.find("grid") != std::string::npos; }));
}

/// The distances from an edge of a straight-sided face at which the nodes of its quads stand, ascending.
std::vector<double> heights_on(const CadModel& model, const ShellMesh& mesh, int edge, int face) {
  const CadEdge& cad = model.shape().edges[edge_id(edge)];
  const EdgeCurve curve(cad);
  const Vector3 a = curve.point(cad.first), along = (curve.point(cad.last) - a).normalized();
  std::vector<double> heights;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (mesh.quad_faces[i] != face) continue;
    for (const int node : mesh.quads[i]) {
      const Vector3 from = mesh.points[node] - a;
      const double height = (from - from.dot(along) * along).norm();
      const auto near = [&](double other) { return std::abs(other - height) < 1e-6; };
      if (std::none_of(heights.begin(), heights.end(), near)) heights.push_back(height);
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// On the two faces of an edge, rows of the heights asked for, all over the faces, and nothing finer along
/// it.
TEST(GridRows, LayersAreFlatRows) {
  const CadModel box = CadModel::read(sample_model("box").path());  // 30 x 20 x 10
  for (const Strategy strategy : {Strategy::subdivide, Strategy::direct}) {
    for (const int edge : {1, 4, 7}) {
      MeshOptions options;
      options.strategy = strategy;
      options.sizing.size = 2;
      options.sizing.layers.edges[edge] = {0.1, 1.2, 6};
      const ShellMesh mesh = mesh_of(box, options);
      EXPECT_EQ(count_grids(mesh), 6);
      for (const FaceId face : box.shape().edges[edge_id(edge)].faces) {
        const std::vector<double> heights = heights_on(box, mesh, edge, face.number());
        ASSERT_GT(heights.size(), 7u);
        double height = 0;
        for (int i = 0; i <= 6; ++i) {
          EXPECT_NEAR(heights[i], height, 1e-6)
              << "layer " << i << " of Edge" << edge << " on Face" << face.number();
          height += 0.1 * std::pow(1.2, i);
        }
        // Then they grow on, by no more than sizes may, up to the size.
        for (std::size_t i = 7; i < heights.size(); ++i) {
          EXPECT_LT(heights[i] - heights[i - 1], 1.5 * (heights[i - 1] - heights[i - 2]));
          EXPECT_LT(heights[i] - heights[i - 1], 1.3 * options.sizing.size);
        }
      }
      const double length = box.shape().edges[edge_id(edge)].length;
      const auto on_edge =
          std::count_if(mesh.segments.begin(), mesh.segments.end(),
                        [&](const ShellMesh::Segment& segment) { return segment.edge == edge; });
      EXPECT_NEAR(static_cast<double>(on_edge), length / 2, 1 + 0.2 * length / 2);
    }
  }
}

/// Between slanted sides, layers are as high as on a rectangle.
TEST(GridRows, LayersAreFlatRowsBetweenSlantedSides) {
  const CadModel sheet = testing::sheet({{{0, 0}, {40, 0}, {30, 12}, {6, 12}}});
  const auto& edges = sheet.shape().edges;
  const auto longest = std::max_element(
      edges.begin(), edges.end(), [](const CadEdge& a, const CadEdge& b) { return a.length < b.length; });
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.layers.edges[longest->number] = {0.1, 1.2, 4};
  const ShellMesh mesh = mesh_of(sheet, options);
  EXPECT_EQ(count_grids(mesh), 1);
  const std::vector<double> heights = heights_on(sheet, mesh, longest->number, 1);
  ASSERT_GT(heights.size(), 5u);
  double height = 0;
  for (int i = 0; i <= 4; ++i) {
    EXPECT_NEAR(heights[i], height, 1e-6) << "layer " << i;
    height += 0.1 * std::pow(1.2, i);
  }
}

TEST(GridRows, LayersFromBothSidesMeet) {
  const CadModel box = CadModel::read(sample_model("box").path());
  const CadShape& shape = box.shape();
  const FaceId face = shape.edges[edge_id(1)].faces.front();
  const auto& coedges = shape.faces[face].wires.front().coedges;
  ASSERT_EQ(coedges.size(), 4u);
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.layers.edges[coedges[0].edge.number()] = {0.1, 1.2, 5};
  options.sizing.layers.edges[coedges[2].edge.number()] = {0.2, 1.5, 3};
  const ShellMesh mesh = mesh_of(box, options);
  const std::vector<double> one = heights_on(box, mesh, coedges[0].edge.number(), face.number());
  const std::vector<double> other = heights_on(box, mesh, coedges[2].edge.number(), face.number());
  ASSERT_GT(one.size(), 9u);
  EXPECT_NEAR(one[1], 0.1, 1e-6);
  EXPECT_NEAR(one[2], 0.22, 1e-6);
  EXPECT_NEAR(other[1], 0.2, 1e-6);
  EXPECT_NEAR(other[2], 0.5, 1e-6);
}

/// A division in grids alone leaves them grids, however uneven it is.
TEST(GridRows, BiasKeepsGrids) {
  const CadModel box = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = 2;
  options.sizing.spacings[4] = {24, 1.2, 1};
  const ShellMesh mesh = mesh_of(box, options);
  EXPECT_EQ(count_grids(mesh), 6);
  std::set<int> nodes;
  double shortest = 1e9, longest = 0;
  for (const ShellMesh::Segment& segment : mesh.segments) {
    if (segment.edge != 4) continue;
    const double length = (mesh.points[segment.nodes[0]] - mesh.points[segment.nodes[1]]).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
    nodes.insert(segment.nodes.begin(), segment.nodes.end());
  }
  EXPECT_EQ(nodes.size(), 25u);
  EXPECT_NEAR(longest / shortest, std::pow(1.2, 23), 1e-3 * std::pow(1.2, 23));
}

/// Where the edges that run away from the edge go on into faces that are no grids, sizes are as small as
/// layers are high.
TEST(GridRows, OtherEdgesHaveSmallSizes) {
  const CadModel plate = CadModel::read(sample_model("plate_with_holes").path());
  const auto& edges = plate.shape().edges;
  const auto shortest = std::min_element(edges.begin(), edges.end(), [](const CadEdge& a, const CadEdge& b) {
    return std::pair(a.faces.front() == a.faces.back(), a.length) <
           std::pair(b.faces.front() == b.faces.back(), b.length);
  });
  const double height = shortest->length / 20;
  MeshOptions options;
  options.sizing.size = plate.diagonal() / 15;
  options.sizing.layers.edges[shortest->number] = {height, 1.2, 4};
  const ShellMesh mesh = mesh_of(plate, options);
  const auto on_edge =
      std::count_if(mesh.segments.begin(), mesh.segments.end(),
                    [&](const ShellMesh::Segment& segment) { return segment.edge == shortest->number; });
  EXPECT_GT(static_cast<double>(on_edge), 0.5 * shortest->length / height);
}

}  // namespace
}  // namespace quadrille
