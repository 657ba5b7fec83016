/// Nodes and elements of a file, in any order and numbering, become a mesh, or a sentence on what is wrong.

#include "mesher/io/mesh_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "geometry/base/error.hpp"

namespace quadrille {
namespace {

FileElement element(std::int64_t number, ElementShape shape, const std::vector<std::int64_t>& nodes) {
  FileElement result{.number = number, .shape = shape};
  std::copy(nodes.begin(), nodes.end(), result.nodes.begin());
  result.node_count = static_cast<int>(nodes.size());
  return result;
}

FileElement quad(std::int64_t number, const std::vector<std::int64_t>& nodes) {
  return element(number, ElementShape::quad, nodes);
}

/// Nodes at (0, 0), (1, 0), (2, 0), then (0, 1) and on, with these numbers.
MeshBuilder with_nodes(const std::vector<std::int64_t>& numbers) {
  MeshBuilder builder("file.inp");
  for (std::size_t i = 0; i < numbers.size(); ++i)
    builder.add_node(numbers[i], {static_cast<double>(i % 3), i < 3 ? 0.0 : 1.0, 0});
  return builder;
}

TEST(MeshBuilder, TakesNumbersOfAnySize) {
  constexpr std::int64_t far = 9000000000000000000;
  for (const std::vector<std::int64_t>& numbers :
       std::vector<std::vector<std::int64_t>>{{1, 2, 3, 4, 5, 6}, {60, 5, far, 3, 1000000, 1}}) {
    MeshBuilder builder = with_nodes(numbers);
    builder.add_element(quad(8, {numbers[0], numbers[1], numbers[4], numbers[3]}));
    builder.add_element(quad(far, {numbers[1], numbers[2], numbers[5], numbers[4]}));
    const ShellMesh mesh = builder.finish();
    EXPECT_EQ(mesh.order, 1);
    ASSERT_EQ(mesh.points.size(), 6U);
    ASSERT_EQ(mesh.quads.size(), 2U);
    for (std::size_t q = 0; q < 2; ++q)
      for (int k = 0; k < 4; ++k)
        EXPECT_EQ(mesh.points[mesh.quads[q][k]],
                  Vector3(static_cast<double>(q) + (k == 1 || k == 2), k > 1 ? 1 : 0, 0));
  }
}

TEST(MeshBuilder, KeepsGroupsOfElementsAndNodes) {
  MeshBuilder builder = with_nodes({1, 2, 3, 4, 5, 6});
  builder.add_element(quad(1, {1, 2, 5, 4}));
  builder.add_element(quad(2, {2, 3, 6, 5}));
  const int left = builder.group("left", 0, 2), all = builder.group("all", 7, 2),
            corner = builder.group("corner", 0, 0);
  EXPECT_EQ(builder.group("left", 0, 2), left);
  EXPECT_EQ(builder.joined(builder.joined(0, left), all), builder.joined(builder.joined(0, all), left));
  EXPECT_TRUE(builder.put_element(1, left) && builder.put_element(1, all) && builder.put_element(2, all));
  EXPECT_TRUE(builder.put_node(6, corner));
  EXPECT_FALSE(builder.put_element(3, all) || builder.put_node(9, corner));
  const ShellMesh mesh = builder.finish();
  ASSERT_EQ(mesh.groups.size(), 3U);
  const auto faces_of = [&](const std::string& name) {
    return std::find_if(mesh.groups.begin(), mesh.groups.end(),
                        [&](const auto& group) { return group.name == name; })
        ->entities;
  };
  EXPECT_NE(mesh.quad_faces[0], mesh.quad_faces[1]);
  EXPECT_EQ(faces_of("left"), std::vector<int>{mesh.quad_faces[0]});
  EXPECT_EQ(faces_of("all").size(), 2U);
  ASSERT_EQ(mesh.corners.size(), 1U);
  EXPECT_EQ(faces_of("corner"), std::vector<int>{mesh.corners[0].vertex});
  EXPECT_EQ(mesh.points[mesh.corners[0].node], Vector3(2, 1, 0));
}

TEST(MeshBuilder, UnitesRepeatedElementsAndDropsUnusedNodes) {
  MeshBuilder builder = with_nodes({1, 2, 3, 4, 5, 6});
  FileElement first = quad(1, {1, 2, 5, 4}), again = quad(2, {2, 5, 4, 1});
  first.groups = builder.joined(0, builder.group("a", 1, 2));
  again.groups = builder.joined(0, builder.group("b", 2, 2));
  builder.add_element(first);
  builder.add_element(again);
  builder.unite_repeated();
  const ShellMesh mesh = builder.finish();
  EXPECT_EQ(mesh.quads.size(), 1U);
  EXPECT_EQ(mesh.points.size(), 4U);
  ASSERT_EQ(mesh.groups.size(), 2U);
  for (const auto& group : mesh.groups) EXPECT_EQ(group.entities, std::vector<int>{mesh.quad_faces[0]});
}

TEST(MeshBuilder, NamesWhatIsWrong) {
  const auto refused = [](const std::string& part, const std::function<void(MeshBuilder&)>& add) {
    MeshBuilder builder = with_nodes({1, 2, 3, 4, 5, 6, 7, 8});
    try {
      add(builder);
      builder.finish();
      ADD_FAILURE() << "no error that says " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::failure);
      EXPECT_EQ(std::string(error.what()).rfind("file.inp", 0), 0U) << error.what();
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused("node number 0", [](MeshBuilder& builder) { builder.add_node(0, {0, 0, 0}); });
  refused("node 3 is defined twice", [](MeshBuilder& builder) { builder.add_node(3, {0, 0, 0}); });
  refused("node 9", [](MeshBuilder& builder) { builder.add_node(9, {0, std::nan(""), 0}); });
  refused("refers to node 99", [](MeshBuilder& builder) { builder.add_element(quad(1, {1, 2, 3, 99})); });
  refused("uses node 2 twice", [](MeshBuilder& builder) { builder.add_element(quad(1, {1, 2, 3, 2})); });
  refused("element 2", [](MeshBuilder& builder) {
    builder.add_element(quad(1, {1, 2, 3, 4}));
    builder.add_element(quad(2, {1, 2, 3, 4, 5, 6, 7, 8}));
  });
  refused("", [](MeshBuilder& builder) { builder.add_element(element(1, ElementShape::line, {1, 2})); });
}

}  // namespace
}  // namespace quadrille
