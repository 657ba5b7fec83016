/// A mesh as the writers see it: dense numbers, groups by CAD entity, middles of quads, thicknesses.

#include "mesher/io/output_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "geometry/base/error.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

constexpr int n = 3;

TEST(OutputMesh, NumbersTheUsedNodesFromOne) {
  ShellMesh mesh = test::ShellGrid(n, 1).mesh();
  const std::size_t used = mesh.points.size();
  mesh.points.push_back({9, 9, 9});
  const OutputMesh output(mesh);
  ASSERT_EQ(output.nodes().size(), used);
  for (std::size_t i = 0; i < used; ++i) {
    EXPECT_EQ(output.number(output.nodes()[i]), static_cast<int>(i) + 1);
    EXPECT_EQ(output.point(static_cast<int>(i)), mesh.points[output.nodes()[i]]);
  }
}

TEST(OutputMesh, SortsElementsByTheirEntities) {
  const ShellMesh mesh = test::ShellGrid(n, 2).mesh();
  const OutputMesh output(mesh);
  const std::array<std::size_t, 3> entities{6, 7, 2};
  for (const int dimension : {0, 1, 2}) {
    ASSERT_EQ(output.entities(dimension).size(), entities[dimension]);
    ASSERT_EQ(output.groups(dimension).size(), entities[dimension]);
    std::set<int> members;
    for (const CadGroup& entity : output.entities(dimension))
      for (const int member : entity.members) {
        EXPECT_EQ(output.entity(dimension, member), entity.number);
        EXPECT_TRUE(members.insert(member).second);
      }
    EXPECT_EQ(static_cast<int>(members.size()), output.count(dimension));
    for (const NamedGroup& group : output.groups(dimension)) {
      std::set<int> nodes;
      for (const int member : output.members(dimension, group))
        for (const int node : output.element_nodes(dimension, member)) nodes.insert(output.number(node));
      const std::vector<int> numbers = output.node_numbers(dimension, group);
      EXPECT_EQ(std::vector<int>(nodes.begin(), nodes.end()), numbers) << group.name;
    }
  }
  EXPECT_EQ(output.groups(2)[1].name, "Face2");
  EXPECT_EQ(output.groups(1)[6].name, "Edge7");
  GroupKinds faces_only;
  faces_only.edges = faces_only.vertices = false;
  const OutputMesh few(mesh, faces_only);
  EXPECT_EQ(few.count(1) + few.count(0), 0);
}

TEST(OutputMesh, PutsTheNinthNodeInTheMiddleOfTheElement) {
  const ShellMesh mesh = test::ShellGrid(n, 2, 0).mesh();
  const OutputMesh output(mesh, {}, 9);
  EXPECT_EQ(output.nodes().size(), mesh.points.size() + mesh.quads.size());
  for (int quad = 0; quad < output.quad_count(); ++quad) {
    const ElementNodes nodes = output.element_nodes(2, quad);
    ASSERT_EQ(nodes.count, 9);
    Vector3 middle = Vector3::Zero();
    for (int k = 0; k < 4; ++k) middle += 0.25 * output.position(nodes.nodes[k]);
    EXPECT_LT((output.position(nodes.nodes[8]) - middle).norm(), 1e-12);
  }
}

TEST(OutputMesh, GroupsFacesByThickness) {
  ShellMesh mesh = test::ShellGrid(n, 1).mesh();
  EXPECT_TRUE(OutputMesh(mesh).thicknesses().empty());
  mesh.thicknesses = {2.5, 2.5};
  const OutputMesh alike(mesh);
  ASSERT_EQ(alike.thicknesses().size(), 1U);
  EXPECT_EQ(alike.thicknesses()[0].name, "Thickness2.5");
  EXPECT_EQ(alike.thicknesses()[0].entities, (std::vector<int>{1, 2}));
  EXPECT_EQ(mean_thickness(alike, 0), 2.5);
  mesh.thicknesses = {2.5, 1};
  EXPECT_EQ(OutputMesh(mesh).thicknesses().size(), 2U);
}

TEST(OutputMesh, RefusesNodesThatAreNoneOrNowhere) {
  ShellMesh mesh = test::ShellGrid(n, 1).mesh();
  mesh.quads[4][2] = 1000;
  EXPECT_THROW(OutputMesh{mesh}, Error);
  mesh = test::ShellGrid(n, 1).mesh();
  mesh.points[7].x() = std::nan("");
  EXPECT_THROW(OutputMesh{mesh}, Error);
}

}  // namespace
}  // namespace quadrille
