/// `quadrille recombine` on triangulations that are no good: one sentence that names the element or node.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/io/io.hpp"
#include "tests/process.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

const std::string program = QUADRILLE_BINARY_DIR "/quadrille";

/// Two triangles of the unit square and what else is asked for, as .msh 2.2.
std::string square(const std::string& more_nodes, int node_count, const std::string& elements,
                   int element_count) {
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 "
      "0\n{}$EndNodes\n$Elements\n"
      "{}\n{}$EndElements\n",
      node_count, more_nodes, element_count, elements);
}

const std::string two = "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n";

struct BadInput {
  std::string name, text, says;
};

void PrintTo(const BadInput& input, std::ostream* out) {
  *out << input.name;
}

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, GiveOneSentenceAndNoFile) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", GetParam().text);
  for (const char* mode : {"", "--no-improve"}) {
    const auto result =
        test::run(fmt::format("cd {} && timeout 60 {} recombine in.msh -o out.msh --quiet {} 2>&1",
                              folder.path().string(), program, mode));
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    EXPECT_NE(result.out.find(GetParam().says), std::string::npos) << result.out;
    EXPECT_EQ(folder.file_count(), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Recombine, BadInputs,
    testing::Values(
        BadInput{"not manifold", square("5 0.5 0.5 1\n", 5, two + "3 2 2 0 1 1 3 5\n", 3),
                 "triangle 2 is the third on the side 0-2"},
        BadInput{"not oriented alike", square("", 4, "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 4 3\n", 2),
                 "triangle 1 runs along its side 2-0 the same way as triangle 0"},
        BadInput{"no area", square("5 2 0 0\n", 5, two + "3 2 2 0 1 1 5 2\n", 3), "triangle 2 has no area"},
        BadInput{"a node twice in an element", square("", 4, two + "3 2 2 0 1 1 1 2\n", 3),
                 "element 3 uses node 1 twice"},
        BadInput{"two nodes on one place", square("5 0 0 0\n", 5, two + "3 2 2 0 1 5 4 3\n", 3),
                 "the points 0 and 4"},
        BadInput{"a node defined twice", square("4 0 2 0\n", 5, two, 2), "node 4 is defined twice"},
        BadInput{"a node that does not exist", square("", 4, two + "3 2 2 0 1 1 2 9\n", 3),
                 "element 3 refers to node 9"},
        BadInput{"a node number out of range", square("99999999999999999999 0 2 0\n", 5, two, 2), "node"},
        BadInput{"no finite position", square("5 nan 0 0\n", 5, two, 2), "node 5 has no finite position"},
        BadInput{"a quad mixed in", square("5 2 0 0\n6 2 1 0\n", 6, two + "3 3 2 0 1 2 5 6 3\n", 3),
                 "holds 1 quads"},
        BadInput{"a volume mixed in", square("5 0 0 1\n", 5, two + "3 4 2 0 1 1 2 3 5\n", 3),
                 "element 3 is a volume"},
        BadInput{"truncated", square("", 4, two, 2).substr(0, 100), "the file ends where"},
        BadInput{"binary of another byte order", std::string("$MeshFormat\n2.2 1 8\n\0\0\0\1\n", 25),
                 "another byte order"},
        BadInput{"binary rubbish",
                 std::string("\x7f"
                             "ELF\2\1\1\0\0\0",
                             10),
                 "is not a Gmsh .msh file"}),
    [](const auto& input) {
      std::string name = input.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

TEST(RecombineCommand, DropsNodesThatNoElementUses) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", square("7 5 5 5\n", 5, two, 2));
  const auto result = test::run(fmt::format("cd {} && timeout 60 {} recombine in.msh -o out.msh --quiet 2>&1",
                                            folder.path().string(), program));
  EXPECT_EQ(result.exit_code, 0) << result.out;
  const ShellMesh mesh = read_mesh(folder / "out.msh");
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.quads.size(), 1U);
}

}  // namespace
}  // namespace quadrille
