/// `quadrille recombine` on triangulations that are no good: one sentence that names the element or node.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesher/io/io.hpp"
#include "tests/support/process.hpp"
#include "tests/support/triangulations.hpp"

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

class BadInputs : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, GiveOneSentenceAndNoFile) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", GetParam().text);
  for (const char* mode : {"", "--no-improve"}) {
    const auto result =
        test::run(fmt::format("cd {} && timeout 300 {} recombine in.msh -o out.msh --quiet {} 2>&1",
                              folder.path().string(), program, mode));
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    EXPECT_NE(result.out.find(GetParam().says), std::string::npos) << result.out;
    EXPECT_EQ(folder.file_count(), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Recombine, BadInputs,
    ::testing::Values(
        BadInput{"a triangle twice", square("", 4, two + "3 2 2 0 1 2 3 1\n", 3),
                 "triangle 2 has the same corners as triangle 0"},
        BadInput{
            "one side only",
            square("5 2 0.5 1\n6 2 1 2\n", 6,
                   "1 2 2 0 1 1 2 3\n2 2 2 0 1 2 3 4\n3 2 2 0 1 3 4 5\n4 2 2 0 1 4 5 1\n5 2 2 0 1 5 1 2\n",
                   5),
            "like a Moebius strip"},
        BadInput{"no area", square("5 2 0 0\n", 5, two + "3 2 2 0 1 1 5 2\n", 3), "triangle 2 has no area"},
        BadInput{"a node twice in an element", square("", 4, two + "3 2 2 0 1 1 1 2\n", 3),
                 "element 3 uses node 1 twice"},
        BadInput{"two nodes on one place", square("5 0 0 0\n", 5, two + "3 2 2 0 1 5 4 3\n", 3),
                 "the points 0 and 4 are at the same position, 0 0 0: merge them with --merge 0 ("},
        BadInput{"each triangle a face", square("", 4, "1 2 2 1 1 1 2 3\n2 2 2 2 2 1 3 4\n", 2),
                 "no quad can be made"},
        BadInput{"a node defined twice", square("4 0 2 0\n", 5, two, 2), "node 4 is defined twice"},
        BadInput{"a node that does not exist", square("", 4, two + "3 2 2 0 1 1 2 9\n", 3),
                 "element 3 refers to node 9"},
        BadInput{"a node number out of range", square("99999999999999999999 0 2 0\n", 5, two, 2), "node"},
        BadInput{"no finite position", square("5 nan 0 0\n", 5, two, 2), "node 5 has no finite position"},
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

/// A triangulation as .msh 2.2, each triangle in the CAD face of its tag.
std::string as_msh(const TriangleMesh& mesh) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    text += fmt::format("{} {} {} {}\n", v + 1, mesh.points[v].x(), mesh.points[v].y(), mesh.points[v].z());
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    text += fmt::format("{} 2 2 {} {} {} {} {}\n", t + 1, mesh.tags[t], mesh.tags[t], a + 1, b + 1, c + 1);
  }
  return text + "$EndElements\n";
}

/// Two pieces with holes, apart from each other, the first of two CAD faces.
TriangleMesh two_pieces() {
  TriangleMesh mesh = testing::random_with_holes(900, 4, 3);
  for (const auto& [a, b, c] : mesh.triangles) {
    mesh.tags.push_back((mesh.points[a] + mesh.points[b] + mesh.points[c]).x() < 1.5 ? 4 : 9);
  }
  const TriangleMesh other = testing::random_with_holes(500, 3, 8);
  const int offset = static_cast<int>(mesh.points.size());
  for (const Vector3& p : other.points) mesh.points.emplace_back(p + Vector3(5, 0, 2));
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
    mesh.tags.push_back(6);
  }
  return mesh;
}

/// The sides that one element of a CAD face alone has, by the places of their ends.
template <class Element>
void add_open_sides(const std::vector<Vector3>& points, const std::vector<Element>& elements,
                    const std::vector<int>& faces, std::map<std::string, int>& sides) {
  const auto place = [&](int v) {
    return fmt::format("{:.9f} {:.9f} {:.9f}", points[v].x(), points[v].y(), points[v].z());
  };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    for (std::size_t i = 0; i < elements[e].size(); ++i) {
      const std::string a = place(elements[e][i]), b = place(elements[e][(i + 1) % elements[e].size()]);
      if (++sides[fmt::format("{} {} {}", faces[e], std::min(a, b), std::max(a, b))] == 2) {
        sides.erase(fmt::format("{} {} {}", faces[e], std::min(a, b), std::max(a, b)));
      }
    }
  }
}

TEST(RecombineCommand, TakesPiecesWithHolesEachFaceOnItsOwn) {
  const TemporaryFolder folder;
  const TriangleMesh input = two_pieces();
  test::write_text(folder / "in.msh", as_msh(input));
  std::map<std::string, int> before;
  add_open_sides(input.points, input.triangles, input.tags, before);
  for (const char* mode : {"", "--no-improve", "--no-improve --seed 5"}) {
    const auto result =
        test::run(fmt::format("cd {} && timeout 300 {} recombine in.msh -o out.msh --quiet {} 2>&1",
                              folder.path().string(), program, mode));
    ASSERT_EQ(result.exit_code, 0) << result.out;
    const ShellMesh mesh = read_mesh(folder / "out.msh");
    EXPECT_EQ(static_cast<int>(mesh.triangles.size()), testing::odd_pieces(input)) << mode;
    EXPECT_EQ(std::set<int>(mesh.quad_faces.begin(), mesh.quad_faces.end()), (std::set<int>{4, 6, 9}));
    std::map<std::string, int> after;
    add_open_sides(mesh.points, mesh.quads, mesh.quad_faces, after);
    add_open_sides(mesh.points, mesh.triangles, mesh.triangle_faces, after);
    EXPECT_EQ(after, before) << mode << ": the boundary of a face has changed";
  }
}

TEST(RecombineCommand, TheSeedDecidesThePapersMode) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", as_msh(two_pieces()));
  const auto quads = [&](const std::string& options) {
    const auto result =
        test::run(fmt::format("cd {} && timeout 300 {} recombine in.msh -o out.msh --quiet {} 2>&1",
                              folder.path().string(), program, options));
    EXPECT_EQ(result.exit_code, 0) << result.out;
    return read_mesh(folder / "out.msh").quads;
  };
  EXPECT_EQ(quads("--no-improve --seed 3"), quads("--no-improve --seed 3"));
  EXPECT_NE(quads("--no-improve --seed 3"), quads("--no-improve --seed 4"));
  EXPECT_EQ(quads("--threads 1"), quads("--threads 3"));
}

TEST(RecombineCommand, DropsNodesThatNoElementUses) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", square("7 5 5 5\n", 5, two, 2));
  const auto result = test::run(fmt::format(
      "cd {} && timeout 300 {} recombine in.msh -o out.msh --quiet 2>&1", folder.path().string(), program));
  EXPECT_EQ(result.exit_code, 0) << result.out;
  const ShellMesh mesh = read_mesh(folder / "out.msh");
  EXPECT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.quads.size(), 1U);
}

TEST(RecombineCommand, NamesAreKeptWhateverTheNumbers) {
  const TemporaryFolder folder;
  // The right half of a square is the surface 6, and called Face1.
  TriangleMesh halves = testing::grid(8, 8, 3);
  for (const auto& [a, b, c] : halves.triangles)
    halves.tags.push_back((halves.points[a] + halves.points[b] + halves.points[c]).x() < 12 ? 1 : 6);
  std::string text = as_msh(halves);
  text.insert(text.find("$Nodes"), "$PhysicalNames\n2\n2 1 \"the left\"\n2 6 \"Face1\"\n$EndPhysicalNames\n");
  test::write_text(folder / "in.msh", text);
  for (const char* out : {"out.msh", "out.vtu", "out.inp"}) {
    const auto result = test::run(fmt::format("cd {} && timeout 300 {} recombine in.msh -o {} --quiet 2>&1",
                                              folder.path().string(), program, out));
    ASSERT_EQ(result.exit_code, 0) << result.out;
    const ShellMesh mesh = read_mesh(folder / out);
    ASSERT_EQ(mesh.groups.size(), 2U);
    for (const ShellMesh::Group& group : mesh.groups) {
      EXPECT_TRUE(group.name == "Face1" || group.name == "the left" || group.name == "the_left")
          << group.name;
      for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        if (!std::binary_search(group.entities.begin(), group.entities.end(), mesh.quad_faces[q])) continue;
        for (const int v : mesh.quads[q]) {
          const double inwards = group.name == "Face1" ? 1 : -1;
          EXPECT_GE(inwards * (mesh.points[v].x() - 4), -1e-9);
        }
      }
    }
  }
}

TEST(RecombineCommand, TakesTrianglesAndQuadsAndTurnsWhatDisagrees) {
  const TemporaryFolder folder;
  test::write_text(folder / "in.msh", square("5 2 0 0\n6 2 1 0\n", 6,
                                             "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 4 3\n3 3 2 0 1 2 5 6 3\n", 3));
  const auto result = test::run(fmt::format(
      "cd {} && timeout 300 {} recombine in.msh -o out.msh --quiet 2>&1", folder.path().string(), program));
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_EQ(result.out, "in.msh: 1 triangles were reversed to match their neighbors\n");
  EXPECT_EQ(read_mesh(folder / "out.msh").quads.size(), 2U);
}

TEST(RecombineCommand, CutsUntaggedMeshesAtFeatures) {
  const TemporaryFolder folder;
  // A roof of 90 degrees, each side a grid.
  TriangleMesh roof = testing::grid(8, 5, 4);
  roof.tags.assign(roof.triangles.size(), 0);
  for (Vector3& p : roof.points) p.z() = -std::abs(p.x() - 4);
  test::write_text(folder / "in.msh", as_msh(roof));
  const auto area = [&](const std::string& options, const char* file = "in.msh") {
    const auto result =
        test::run(fmt::format("cd {} && timeout 300 {} recombine {} -o out.msh --quiet {} 2>&1",
                              folder.path().string(), program, file, options));
    EXPECT_EQ(result.exit_code, 0) << result.out;
    const ShellMesh mesh = read_mesh(folder / "out.msh");
    double sum = 0;
    for (const auto& [a, b, c, d] : mesh.quads)
      sum += 0.5 * (mesh.points[c] - mesh.points[a]).cross(mesh.points[d] - mesh.points[b]).norm();
    return sum;
  };
  EXPECT_NEAR(area(""), 40 * std::sqrt(2.0), 1e-9);
  EXPECT_LT(area("--feature-angle 0"), 40 * std::sqrt(2.0) - 0.01);
  // Two faces across the ridge: tags rule, whatever the case of the ending.
  for (std::size_t t = 0; t < roof.triangles.size(); ++t)
    roof.tags[t] = roof.points[roof.triangles[t][0]].y() < 2 ? 1 : 2;
  test::write_text(folder / "IN.MSH", as_msh(roof));
  EXPECT_LT(area("", "IN.MSH"), 40 * std::sqrt(2.0) - 0.01);
  const auto bad = test::run(fmt::format("cd {} && {} recombine in.msh -o out.msh --feature-angle 200 2>&1",
                                         folder.path().string(), program));
  EXPECT_EQ(bad.exit_code, 2) << bad.out;
}

}  // namespace
}  // namespace quadrille
