/// `quadrille remesh`: files in, files out, and one sentence for what is no good.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mesher/io/io.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

const std::string program = QUADRILLE_BINARY_DIR "/quadrille";

/// A tetrahedron with right angles at one corner, 10 long, as text.
std::string tetrahedron() {
  const std::array<const char*, 4> points{"0 0 0", "10 0 0", "0 10 0", "0 0 10"};
  const std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  std::string text = "solid Mesh\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) text += fmt::format("vertex {}\n", points[corner]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid Mesh\n";
}

test::ProcessResult remesh(const TemporaryFolder& folder, const std::string& arguments) {
  return test::run(
      fmt::format("cd {} && timeout 300 {} remesh {} 2>&1", folder.path().string(), program, arguments));
}

TEST(RemeshCommand, WritesWhatIsAskedForAndTellsDistances) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.stl", tetrahedron());
  const auto result = remesh(folder, "in.stl -o out.msh -o out.vtu -o out.inp --size 1 --report report.json");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_NE(result.out.find("surface: the mesh is up to"), std::string::npos) << result.out;
  std::ifstream file(folder / "report.json");
  const nlohmann::json report = nlohmann::json::parse(file);
  const auto& fidelity = report["fidelity"];
  EXPECT_LT(fidelity["mesh_from_surface"]["distance"].get<double>(), 1e-6);
  EXPECT_LT(fidelity["surface_from_mesh"]["distance"].get<double>(), 1e-6);
  EXPECT_EQ(report["faces"].size(), 4u);
  EXPECT_EQ(report["counts"]["triangles"], 0);
  EXPECT_EQ(report["order"], 2);  // for the solver's file
  const ShellMesh mesh = read_mesh(folder / "out.msh");
  for (const char* name : {"Face1", "Face4", "Edge1", "Edge6", "Vertex4"})
    EXPECT_TRUE(std::any_of(mesh.groups.begin(), mesh.groups.end(), [&](const auto& g) {
      return g.name == name;
    })) << name;
}

TEST(RemeshCommand, WritesFirstOrderForPictures) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.stl", tetrahedron());
  ASSERT_EQ(remesh(folder, "in.stl -o out.msh --size 2 --quiet").exit_code, 0);
  EXPECT_EQ(read_mesh(folder / "out.msh").order, 1);
  ASSERT_EQ(remesh(folder, "out.msh -o again.msh --size 1.5 --order 2 --quiet").exit_code, 0);
  EXPECT_EQ(read_mesh(folder / "again.msh").order, 2);
}

struct BadUse {
  std::string name, arguments, says;
  int exit_code;
};

void PrintTo(const BadUse& use, std::ostream* out) {
  *out << use.name;
}

class BadUses : public ::testing::TestWithParam<BadUse> {};

TEST_P(BadUses, GiveOneSentenceAndNoFile) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.stl", tetrahedron());
  test::write_text(folder / "empty.stl", "solid nothing\nendsolid nothing\n");
  test::write_text(folder / "nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
  test::write_text(folder / "far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf -2147483648 2 3\n");
  test::write_text(folder / "fin.obj",
                   "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 0 -4 -4\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  const auto files = folder.file_count();
  const auto result = remesh(folder, GetParam().arguments + " --quiet");
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_NE(result.out.find(GetParam().says), std::string::npos) << result.out;
  EXPECT_EQ(folder.file_count(), files);
}

INSTANTIATE_TEST_SUITE_P(
    Remesh, BadUses,
    ::testing::Values(BadUse{"no size", "in.stl -o out.msh", "--size is required", 2},
                      BadUse{"size 0", "in.stl -o out.msh --size 0", "--size must be a positive number", 2},
                      BadUse{"too large", "in.stl -o out.msh --size 50",
                             "--size is 50, larger than the surface", 2},
                      BadUse{"too small", "in.stl -o out.msh --size 1e-5", "million elements", 2},
                      BadUse{"angle", "in.stl -o out.msh --size 1 --feature-angle 190", "feature-angle", 2},
                      BadUse{"ending", "in.stl -o out.stl --size 1", "unknown mesh format", 2},
                      BadUse{"over itself", "in.stl -o ./in.stl --size 1", "in.stl", 2},
                      BadUse{"no file", "none.stl -o out.msh --size 1", "none.stl", 1},
                      BadUse{"empty", "empty.stl -o out.msh --size 1", "empty.stl", 1},
                      BadUse{"not a number", "nan.obj -o out.msh --size 1", "nan.obj", 1},
                      BadUse{"no such point", "far.obj -o out.msh --size 1", "does not define", 1},
                      BadUse{"three on a side", "fin.obj -o out.msh --size 1",
                             "3 triangles meet at the side from (0, 0, 0) to (4, 0, 0)", 1},
                      BadUse{"no time", "in.stl -o out.msh --size 0.02 --time-limit 0.05", "time limit", 1}));

}  // namespace
}  // namespace quadrille
