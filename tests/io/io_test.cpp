/// Writers and readers: what is written reads back the same, here and in the programs that the files are for.

#include "mesher/io/io.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "geometry/base/error.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/settings.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

using test::ShellGrid;
using test::TemporaryFolder;

void expect_same_points(const ShellMesh& a, const ShellMesh& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]) << "node " << i;
}

void expect_same_elements(const ShellMesh& a, const ShellMesh& b) {
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.quads, b.quads);
  EXPECT_EQ(a.midsides, b.midsides);
  EXPECT_EQ(a.quad_faces, b.quad_faces);
  EXPECT_EQ(a.triangles, b.triangles);
}

void expect_same_sides(const ShellMesh& a, const ShellMesh& b) {
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    EXPECT_EQ(a.segments[i].nodes, b.segments[i].nodes);
    EXPECT_EQ(a.segments[i].middle, b.segments[i].middle);
    EXPECT_EQ(a.segments[i].edge, b.segments[i].edge);
  }
  ASSERT_EQ(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < a.corners.size(); ++i) {
    EXPECT_EQ(a.corners[i].node, b.corners[i].node);
    EXPECT_EQ(a.corners[i].vertex, b.corners[i].vertex);
  }
}

/// The sentence of the Error that the call throws; empty when it throws none.
template <class Call>
std::string error_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return {};
}

#define EXPECT_SAYS(call, part) EXPECT_PRED2(contains, error_of([&] { call; }), part)
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class RoundTrip : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Orders, RoundTrip, testing::Values(1, 2));

TEST_P(RoundTrip, Msh2KeepsEverything) {
  const TemporaryFolder folder;
  const ShellGrid grid(5, GetParam());
  write_mesh(grid.mesh(), folder / "grid.msh");
  const ShellMesh back = read_mesh(folder / "grid.msh");
  expect_same_points(grid.mesh(), back);
  expect_same_elements(grid.mesh(), back);
  expect_same_sides(grid.mesh(), back);
}

TEST_P(RoundTrip, Msh4KeepsEverything) {
  const TemporaryFolder folder;
  const ShellGrid grid(5, GetParam());
  WriteOptions options;
  options.msh_version = MshVersion::v4_1;
  write_mesh(grid.mesh(), folder / "grid.msh", options);
  EXPECT_TRUE(contains(test::file_text(folder / "grid.msh"), "$MeshFormat\n4.1 0 8\n"));
  const ShellMesh back = read_mesh(folder / "grid.msh");
  // 4.1 lists nodes and elements by entity: the quads of Face1 first. As sets they are the same.
  ASSERT_EQ(back.points.size(), grid.mesh().points.size());
  const auto located = [](const ShellMesh& mesh) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      std::string line = std::to_string(mesh.quad_faces[i]);
      const auto append = [&](int node) {
        for (const double x : mesh.points[node]) line += fmt::format(" {}", x);
      };
      for (const int node : mesh.quads[i]) append(node);
      if (mesh.order == 2)
        for (const int node : mesh.midsides[i]) append(node);
      lines.push_back(line);
    }
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  EXPECT_EQ(located(grid.mesh()), located(back));
  EXPECT_EQ(back.segments.size(), grid.mesh().segments.size());
  EXPECT_EQ(back.corners.size(), grid.mesh().corners.size());
}

TEST_P(RoundTrip, InpKeepsNodesAndQuadsWithFaces) {
  const TemporaryFolder folder;
  const ShellGrid grid(5, GetParam());
  write_mesh(grid.mesh(), folder / "grid.inp");
  const ShellMesh back = read_mesh(folder / "grid.inp");
  expect_same_points(grid.mesh(), back);
  EXPECT_EQ(back.quads.size(), grid.mesh().quads.size());
  EXPECT_EQ(std::count(back.quad_faces.begin(), back.quad_faces.end(), 1), 25);
  EXPECT_EQ(std::count(back.quad_faces.begin(), back.quad_faces.end(), 2), 25);
  const std::string text = test::file_text(folder / "grid.inp");
  EXPECT_TRUE(contains(text, GetParam() == 2 ? "TYPE=S8R" : "TYPE=S4"));
  for (const char* set :
       {"*NSET, NSET=Face2\n", "*NSET, NSET=Edge7\n", "*NSET, NSET=Vertex6\n", "ELSET=Face1\n"})
    EXPECT_TRUE(contains(text, set)) << set;
}

/// Without them, FreeCAD searches the whole file for each; it multiplies coordinates by the first factor.
TEST(Unv, BeginsWithUnitsAndCoordinateSystem) {
  const TemporaryFolder folder;
  write_mesh(ShellGrid(2, 1).mesh(), folder / "grid.unv");
  const std::string text = test::file_text(folder / "grid.unv");
  const std::size_t units = text.find("    -1\n   164\n"), system = text.find("    -1\n  2420\n"),
                    nodes = text.find("    -1\n  2411\n");
  EXPECT_EQ(units, 0U);
  ASSERT_LT(system, nodes);
  ASSERT_NE(nodes, std::string::npos);
  const std::string one = "    1.0000000000000000E+0", zero = "    0.0000000000000000E+0";
  EXPECT_TRUE(contains(text.substr(0, system), "\n" + one + one + one + "\n"));
  EXPECT_TRUE(contains(text.substr(system, nodes - system),
                       one + zero + zero + "\n" + zero + one + zero + "\n" + zero + zero + one + "\n"));
}

/// Large enough for several pieces of text to be made at once.
TEST(Writers, GiveTheSameBytesOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const ShellGrid grid(150, 2);
  WriteOptions options;
  for (const char* ending : {".msh", "-4.msh", ".inp", ".unv", ".bdf", ".vtk", ".xdmf"}) {
    options.msh_version = ending[0] == '-' ? MshVersion::v4_1 : MshVersion::v2_2;
    std::string one;
    for (const int threads : {1, 2, 8}) {
      options.threads = threads;
      const auto path = folder / (std::to_string(threads) + ending);
      write_mesh(grid.mesh(), path, options);
      if (threads == 1) one = test::file_text(path);
      EXPECT_TRUE(test::file_text(path) == one) << ending << ", " << threads << " threads";
    }
    EXPECT_GT(one.size(), 1'000'000U) << ending;
  }
}

TEST(Writers, LeaveOutUnusedNodes) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(3, 1).mesh();
  mesh.points.insert(mesh.points.begin(), {9, 9, 9});
  const auto shift = [](auto& nodes) {
    for (int& node : nodes) ++node;
  };
  for (auto& quad : mesh.quads) shift(quad);
  for (auto& segment : mesh.segments) shift(segment.nodes);
  for (auto& corner : mesh.corners) ++corner.node;
  for (const char* name : {"a.msh", "a.inp"}) {
    write_mesh(mesh, folder / name);
    EXPECT_EQ(read_mesh(folder / name).points.size(), mesh.points.size() - 1) << name;
    EXPECT_FALSE(contains(test::file_text(folder / name), "9, 9, 9")) << name;
    EXPECT_FALSE(contains(test::file_text(folder / name), "9 9 9")) << name;
  }
}

TEST(Writers, RefuseBrokenMeshes) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(3, 1).mesh();
  mesh.quads[4][2] = 1000;
  EXPECT_SAYS(write_mesh(mesh, folder / "a.msh"), "quad 5");
  mesh = ShellGrid(3, 1).mesh();
  mesh.points[7].x() = std::nan("");
  EXPECT_SAYS(write_mesh(mesh, folder / "a.med"), "node 7");
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Writers, RefuseUnknownEndingsAndVersions) {
  const TemporaryFolder folder;
  const ShellGrid grid(2, 1);
  EXPECT_SAYS(write_mesh(grid.mesh(), folder / "a.stl"), "unknown mesh format");
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Formats, EachRowOfTheTableIsReadAndWritten) {
  const TemporaryFolder folder;
  const ShellGrid grid(2, 1);
  const auto setting = [](std::string_view name) {
    const auto& all = all_settings();
    return std::find_if(all.begin(), all.end(), [&](const Setting& row) { return row.name == name; });
  };
  const auto tables = nlohmann::json::parse(tables_json());
  ASSERT_FALSE(tables.at("formats").empty());
  for (const auto& row : tables.at("formats")) {
    const std::string ending = row.at("ending");
    const auto path = folder / ("a" + ending);
    if (row.at("written")) {
      write_mesh(grid.mesh(), path);
      EXPECT_TRUE(contains(written_endings("or"), ending));
      // What the help of settings says of formats.
      EXPECT_EQ(contains(std::string(setting("order")->otherwise), ending), row.at("for_solvers")) << ending;
      EXPECT_EQ(contains(std::string(setting("nodes")->help), ending), row.at("quad_nodes") == 9) << ending;
    } else {
      EXPECT_SAYS(write_mesh(grid.mesh(), path), "(known are " + written_endings("and") + ")");
    }
    if (!row.at("read")) {
      EXPECT_SAYS(read_mesh(path), "(known are " + read_endings("and") + ")");
    } else if (row.at("written")) {
      EXPECT_EQ(read_mesh(path).quads.size(), grid.mesh().quads.size()) << ending;
    }
    EXPECT_EQ(is_solver_format(path), row.at("for_solvers")) << ending;
  }
}

TEST(Writers, WriteTrianglesToo) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(2, 1).mesh();
  const auto quad = mesh.quads.back();
  mesh.quads.pop_back();
  mesh.quad_faces.pop_back();
  mesh.triangles = {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
  mesh.triangle_faces = {2, 2};
  for (const char* name : {"a.msh", "a.inp"}) {
    write_mesh(mesh, folder / name);
    const ShellMesh back = read_mesh(folder / name);
    EXPECT_EQ(back.triangles.size(), 2u) << name;
    EXPECT_EQ(back.quads.size(), mesh.quads.size()) << name;
    EXPECT_EQ(back.triangle_faces, mesh.triangle_faces) << name;
  }
  for (const char* name : {"a.med", "a.unv", "a.bdf", "a.vtu", "a.su2"})
    EXPECT_NO_THROW(write_mesh(mesh, folder / name)) << name;
}

/// The bytes of the mesh in each format that write_mesh knows.
std::map<std::string, std::string> all_formats(const ShellMesh& mesh, const WriteOptions& options) {
  const TemporaryFolder folder;
  std::map<std::string, std::string> files;
  for (const std::string ending : {"msh", "inp", "unv", "bdf", "med", "vtu", "vtk", "xdmf", "su2"}) {
    if (ending == "su2" && mesh.order == 2) continue;
    const auto file = folder / ("a." + ending);
    write_mesh(mesh, file, options);
    files[ending] = test::file_text(file);
  }
  return files;
}

TEST(Writers, BdfFieldsFitTheirColumns) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(2, 2).mesh();
  mesh.points[1] = {-1.2345678901234567e-105, 0.99999999999999989, -123456789012345678.0};
  mesh.thicknesses = {0, 25};
  mesh.thicknesses[0] = 2.5;
  write_mesh(mesh, folder / "a.bdf");
  std::ifstream file(folder / "a.bdf");
  int grids = 0, quads = 0;
  std::vector<std::string> properties;
  for (std::string line; std::getline(file, line);) {
    EXPECT_LE(line.size(), 72u) << line;
    quads += line.rfind("CQUAD8  ", 0) == 0;
    if (line.rfind("PSHELL", 0) == 0) properties.push_back(line);
    if (line.rfind("GRID*   ", 0) != 0) continue;
    ++grids;
    EXPECT_EQ(std::stoi(line.substr(8, 16)), grids);
    std::string next;
    std::getline(file, next);
    ASSERT_EQ(line.size(), 72u);
    ASSERT_EQ(next.size(), 24u);
    const std::string fields[] = {line.substr(40, 16), line.substr(56, 16), next.substr(8, 16)};
    for (int i = 0; i < 3; ++i) {
      const double expected = mesh.points[grids - 1][i];
      EXPECT_NE(fields[i].find('.'), std::string::npos) << fields[i];
      EXPECT_NEAR(std::stod(fields[i]), expected, 1e-8 * std::abs(expected)) << fields[i];
    }
  }
  EXPECT_EQ(grids, static_cast<int>(mesh.points.size()));
  EXPECT_EQ(quads, 8);
  EXPECT_EQ(properties, (std::vector<std::string>{"PSHELL         1       1     2.5",
                                                  "PSHELL         2       1     25."}));
}

TEST(Writers, NumbersOfPhysicalGroupsAreUniqueOverDimensions) {
  const TemporaryFolder folder;
  write_mesh(ShellGrid(2, 1).mesh(), folder / "a.msh");
  const std::string text = test::file_text(folder / "a.msh");
  // Two faces, seven edges, six vertices.
  for (const char* line : {"\n2 1 \"Face1\"\n", "\n2 2 \"Face2\"\n", "\n1 3 \"Edge1\"\n", "\n1 9 \"Edge7\"\n",
                           "\n0 10 \"Vertex1\"\n", "\n0 15 \"Vertex6\"\n"})
    EXPECT_PRED2(contains, text, line);
  EXPECT_PRED2(contains, text, "$Elements\n28\n1 15 2 10 1 1\n");  // a point of Vertex1 in group 10
}

TEST_P(RoundTrip, GroupsAreWrittenAsAskedFor) {
  const ShellGrid grid(3, GetParam());
  WriteOptions options;
  options.groups = {true, false, false};
  for (const auto& [ending, bytes] : all_formats(grid.mesh(), options)) {
    EXPECT_FALSE(contains(bytes, "Edge1") || contains(bytes, "Vertex1")) << ending;
    const bool has_names = ending != "vtu" && ending != "vtk" && ending != "xdmf" && ending != "su2";
    EXPECT_EQ(contains(bytes, "Face2"), has_names) << ending;
  }
  options.groups = {false, false, false};
  for (const auto& [ending, bytes] : all_formats(grid.mesh(), options))
    EXPECT_FALSE(contains(bytes, "Face1") || contains(bytes, "Edge1") || contains(bytes, "Vertex1"))
        << ending;
  const TemporaryFolder folder;
  write_mesh(grid.mesh(), folder / "none.msh", options);
  const ShellMesh back = read_mesh(folder / "none.msh");
  EXPECT_EQ(back.quads.size(), grid.mesh().quads.size());
  EXPECT_TRUE(back.segments.empty());
  EXPECT_TRUE(back.corners.empty());
  EXPECT_EQ(back.points.size(), grid.mesh().points.size());
}

TEST(Writers, NineNodesAreTheEightAndTheMiddleOfTheElement) {
  const TemporaryFolder folder;
  const ShellGrid grid(3, 2);
  WriteOptions options;
  options.quad_nodes = 9;
  write_mesh(grid.mesh(), folder / "a.msh", options);
  const ShellMesh back = read_mesh(folder / "a.msh");  // which drops the middles
  expect_same_elements(grid.mesh(), back);
  // The first quad's middle, after all other nodes: on the wave, but for what eight nodes cannot follow.
  const std::string text = test::file_text(folder / "a.msh");
  std::istringstream node(text.substr(text.find(fmt::format("\n{} ", grid.mesh().points.size() + 1)) + 1));
  int number = 0;
  double x = 0, y = 0, z = 0;
  node >> number >> x >> y >> z;
  EXPECT_NEAR(x, 1.0 / 6, 1e-12);
  EXPECT_NEAR(y, 1.0 / 6, 1e-12);
  EXPECT_NEAR(z, 0.3 * std::sin(0.5), 2e-3);
  for (const char* name : {"a.inp", "a.unv", "a.bdf"})
    EXPECT_SAYS(write_mesh(grid.mesh(), folder / name, options), "no quads of 9 nodes");
  EXPECT_SAYS(write_mesh(grid.mesh(), folder / "a.su2"), "no quads of 8 nodes");
  EXPECT_SAYS(write_mesh(ShellGrid(3, 1).mesh(), folder / "b.msh", options), "this one is first order");
}

/// The consumers' test has no triangles, and no sets.
TEST(Xdmf, MixesTrianglesAndTellsOfSets) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(1, 1).mesh();
  mesh.groups = {{"a <plate>", 2, 0, {2}}, {"rim", 1, 0, {1}}};
  const auto quad = mesh.quads.back();
  mesh.quads.pop_back();
  mesh.quad_faces.pop_back();
  mesh.triangles = {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
  mesh.triangle_faces = {2, 2};
  write_mesh(mesh, folder / "a.xdmf");
  const std::string text = test::file_text(folder / "a.xdmf");
  EXPECT_TRUE(contains(text, "TopologyType=\"Mixed\" NumberOfElements=\"3\"")) << text;
  EXPECT_TRUE(contains(text, "Dimensions=\"13\">\n5 0 1 4 3 \n4 1 2 5 \n4 1 5 4 \n<")) << text;
  EXPECT_TRUE(contains(text, "\"a _plate_\" AttributeType=\"Scalar\" Center=\"Cell\">")) << text;
  EXPECT_TRUE(contains(text, "Dimensions=\"3\">\n0\n1\n1\n<")) << text;
  EXPECT_TRUE(contains(text, "\"rim\" AttributeType=\"Scalar\" Center=\"Node\">")) << text;
  EXPECT_TRUE(contains(text, "Dimensions=\"6\">\n1\n0\n0\n1\n0\n0\n<")) << text;
}

TEST(Writers, RefuseNamesThatMedCannotHold) {
  const TemporaryFolder folder;
  const ShellGrid grid(2, 1);
  EXPECT_NO_THROW(write_mesh(grid.mesh(), folder / (std::string(64, 'x') + ".med")));
  EXPECT_SAYS(write_mesh(grid.mesh(), folder / (std::string(65, 'x') + ".med")), "has 65 bytes");
  EXPECT_NO_THROW(write_mesh(grid.mesh(), folder / (std::string(65, 'x') + ".msh")));
}

TEST(Writers, InpNumbersFitWhatCalculixReads) {
  // CalculiX takes 20 characters of a number: -2.98507658737106e-16 would lose the 6 and become a third of a
  // unit.
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(2, 1).mesh();
  mesh.points[0] = {-2.98507658737106e-16, -1.2345678901234567e-105, 0.1 + 0.2};
  write_mesh(mesh, folder / "a.inp");
  const std::string text = test::file_text(folder / "a.inp");
  std::istringstream node(text.substr(text.find("\n1, ") + 3));
  std::string field;
  for (const double expected : mesh.points[0]) {
    ASSERT_TRUE(std::getline(node >> std::ws, field, expected == mesh.points[0].z() ? '\n' : ','));
    EXPECT_LE(field.size(), 20u) << field;
    EXPECT_NEAR(std::stod(field), expected, 1e-12 * std::abs(expected)) << field;
  }
}

TEST(Writers, InpHasSurfacesOfSetsWithElementsOnly) {
  const TemporaryFolder folder;
  ShellMesh mesh = ShellGrid(2, 1).mesh();
  mesh.extra_groups = {{"SolidFace1", 2, 0, {1}}, {"SolidFace2", 2, 0, {9}}};
  write_mesh(mesh, folder / "a.inp");
  const std::string text = test::file_text(folder / "a.inp");
  EXPECT_TRUE(contains(text, "*SURFACE, NAME=Surface_SolidFace1, TYPE=ELEMENT\nSolidFace1, SPOS\n"));
  EXPECT_FALSE(contains(text, "SolidFace2"));
}

TEST_P(RoundTrip, BytesDoNotDependOnWhenTheyAreWritten) {
  const ShellGrid grid(4, GetParam());
  const auto now = all_formats(grid.mesh(), {});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // time stamps count seconds
  for (const auto& [ending, bytes] : all_formats(grid.mesh(), {}))
    EXPECT_TRUE(ending == "med" || bytes == now.at(ending)) << ending;  // HDF5 stores times in a .med
}

TEST(Writers, KeepTitlesOnOneLine) {
  WriteOptions options;
  options.title = "part\n*INCLUDE, INPUT=x\r$ a\x1b[2J\x7f.step";
  for (const auto& [ending, bytes] : all_formats(ShellGrid(2, 1).mesh(), options)) {
    for (const char* part : {"\n*INCLUDE", "\r$ a", "\x1b["})
      EXPECT_FALSE(contains(bytes, part)) << ending << ": " << part;
    const bool has_title = ending != "msh" && ending != "unv" && ending != "vtu" && ending != "xdmf";
    EXPECT_EQ(contains(bytes, "part?*INCLUDE"), has_title) << ending;
  }
  options.title = " *INCLUDE, INPUT=x";
  EXPECT_FALSE(contains(all_formats(ShellGrid(2, 1).mesh(), options)["inp"], "\n *INCLUDE"));
}

// ---- readers ----

constexpr const char* two_quads =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n60 2 1 "
    "0\n$EndNodes\n"
    "$Elements\n2\n1 3 2 7 7 1 2 5 4\n2 3 2 7 9 2 3 60 5\n$EndElements\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(MshReader, ReadsScatteredNumbersAndCrLf) {
  std::string text;
  for (const char c : std::string(two_quads)) {
    if (c == '\n') text += '\r';
    text += c;
  }
  const ShellMesh mesh = read_msh(text, "two");
  EXPECT_EQ(mesh.quads.size(), 2u);
  EXPECT_EQ(mesh.points[5], Vector3(2, 1, 0));
  EXPECT_EQ(mesh.quad_faces, (std::vector<int>{7, 9}));
}

TEST(MshReader, NamesWhatIsWrong) {
  const auto reads = [](const std::string& from, const std::string& to) {
    return error_of([&] { read_msh(replaced(two_quads, from, to), "two.msh"); });
  };
  EXPECT_PRED2(contains, reads("60 2 1 0\n", "5 2 1 0\n"), "node 5 is defined twice");
  EXPECT_PRED2(contains, reads("2 3 60 5", "2 3 61 5"), "element 2 refers to node 61");
  EXPECT_PRED2(contains, reads("2 3 60 5", "2 3 3 5"), "element 2 uses node 3 twice");
  EXPECT_PRED2(contains, reads("2 3 2 7 9", "2 4 2 7 9"), "element 2 is a volume");
  EXPECT_PRED2(contains, reads("2 3 2 7 9", "2 99 2 7 9"), "element 2 has type 99");
  EXPECT_PRED2(contains, reads("3 2 0 0", "3 2 zero 0"), "line 8: expected a node's y, found \"zero\"");
  EXPECT_PRED2(contains, reads("3 2 0 0", "3 2 nan 0"), "node 3 has no finite position");
  EXPECT_PRED2(contains, reads("$Nodes\n6", "$Nodes\n7"), "line 12");
  EXPECT_PRED2(contains, reads("$Nodes\n6", "$Nodes\n600000000000"), "does not fit the file's length");
  EXPECT_PRED2(contains, reads("2.2 0 8", "4.0 0 8"), "version 4");
  EXPECT_PRED2(contains, reads("$Elements\n2", "$Elements\n0\n$EndElements\n$Elements\n2"),
               "a second $Elements");
  EXPECT_PRED2(contains, error_of([] { read_msh("solid cube", "a.msh"); }), "is not a Gmsh .msh file");
  EXPECT_PRED2(contains, error_of([] { read_msh("", "a.msh"); }), "is not a Gmsh .msh file");
}

TEST(MshReader, EachTruncationIsOneSentence) {
  const std::string text = two_quads;
  for (std::size_t length = 0; length + 2 < text.size(); ++length)
    EXPECT_FALSE(error_of([&] { read_msh(text.substr(0, length), "cut.msh"); }).empty()) << length;
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

TEST(MshReader, ReadsBinary2) {
  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  append(bytes, 1);
  bytes += "\n$EndMeshFormat\n$Nodes\n4\n";
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
  for (int i = 0; i < 4; ++i) {
    append(bytes, i + 1);
    for (const double x : corners[i]) append(bytes, x);
  }
  bytes += "\n$EndNodes\n$Elements\n1\n";
  for (const int value : {3, 1, 2, 1, 8, 8, 1, 2, 3, 4}) append(bytes, value);
  bytes += "\n$EndElements\n";
  const ShellMesh mesh = read_msh(bytes, "binary");
  EXPECT_EQ(mesh.quads.size(), 1u);
  EXPECT_EQ(mesh.quad_faces, std::vector<int>{8});
  EXPECT_EQ(mesh.points[3], Vector3(0, 1, 0.5));
  for (std::size_t length = 0; length + 2 < bytes.size(); ++length)
    EXPECT_FALSE(error_of([&] { read_msh(bytes.substr(0, length), "cut.msh"); }).empty()) << length;
}

TEST(InpReader, NamesWhatIsWrong) {
  const std::string good =
      "*NODE\n1, 0, 0, 0\n2, 1, 0\n3, 1, 1,\n4, 0, 1, 0\n*Element, type=S4, ELSET=Face4\n1, 1, 2,\n3, 4\n";
  const ShellMesh mesh = read_inp(good, "a.inp");
  EXPECT_EQ(mesh.quads.size(), 1u);
  EXPECT_EQ(mesh.quad_faces, std::vector<int>{4});
  const auto reads = [&](const std::string& from, const std::string& to) {
    return error_of([&] { read_inp(replaced(good, from, to), "a.inp"); });
  };
  EXPECT_PRED2(contains, reads("3, 4\n", "3\n"), "element 1 has 3 nodes instead of 4");
  EXPECT_PRED2(contains, reads("3, 4\n", "3, 4, 5\n"), "element 1 has more than 4 nodes");
  EXPECT_PRED2(contains, reads("3, 4\n", "3, 9\n"), "element 1 refers to node 9");
  EXPECT_PRED2(contains, reads("type=S4", "type=C3D8"), "volumes");
  EXPECT_PRED2(contains, reads("type=S4", "type=XY"), "line 6: elements of type XY");
  EXPECT_PRED2(contains, reads("2, 1, 0\n", "2, 1, x\n"), "line 3: expected a coordinate");
  EXPECT_PRED2(contains, reads("*NODE\n", "*INCLUDE, INPUT=b.inp\n*NODE\n"), "*INCLUDE");
  EXPECT_PRED2(contains, error_of([] { read_inp("", "a.inp"); }), "neither quads nor triangles");
}

TEST(InpReader, SetsGiveFaces) {
  const ShellMesh mesh = read_inp(
      "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,2,0,0\n6,2,1,0\n*ELEMENT,TYPE=CPS4,ELSET=PLATE\n10,1,2,3,"
      "4\n"
      "20,2,5,6,3\n*ELSET,ELSET=FACE2,GENERATE\n10,20,10\n*ELSET,ELSET=Face3\n20\n",
      "a.inp");
  EXPECT_EQ(mesh.quad_faces, (std::vector<int>{2, 3}));
}

TEST(InpReader, ShellsMembranesAndPlaneElementsOfAnyKind) {
  const auto quads_and_triangles = [](const std::string& type, const std::string& nodes) {
    const ShellMesh mesh = read_inp(
        "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,.5,0\n6,1,.5\n7,.5,1\n8,0,.5\n9,.5,.5\n*ELEMENT,TYPE=" + type +
            "\n1," + nodes + "\n",
        "a.inp");
    return std::pair(mesh.quads.size(), mesh.triangles.size());
  };
  for (const char* type : {"S4", "S4R5", "S4RS", "M3D4R", "CPE4RH", "CAX4P", "CPS4", "DC2D4", "R3D4"})
    EXPECT_EQ(quads_and_triangles(type, "1,2,3,4"), (std::pair<std::size_t, std::size_t>(1, 0))) << type;
  for (const char* type : {"S8R", "S8RT", "CPE8H", "DCAX8"})
    EXPECT_EQ(quads_and_triangles(type, "1,2,3,4,5,6,7,8"), (std::pair<std::size_t, std::size_t>(1, 0)))
        << type;
  for (const char* type : {"S3RS", "STRI3", "CAX3", "CPS3"})
    EXPECT_EQ(quads_and_triangles(type, "1,2,3"), (std::pair<std::size_t, std::size_t>(0, 1))) << type;
  for (const char* type : {"STRI65", "CPS6M"})
    EXPECT_EQ(quads_and_triangles(type, "1,2,3,5,6,9"), (std::pair<std::size_t, std::size_t>(0, 1))) << type;
  for (const char* type : {"SC8R", "C3D4", "DC3D4", "SAX1", "COH2D4", "S", "S4RRRRRRRRRRRRRRR"})
    EXPECT_PRED2(contains, error_of([&] { quads_and_triangles(type, "1,2,3,4"); }), type);
}

// ---- other programs ----

TEST_P(RoundTrip, GmshReadsBothVersions) {
  if (!test::has_program("gmsh")) GTEST_SKIP() << "NOT TESTED: gmsh is not installed";
  const TemporaryFolder folder;
  const ShellGrid grid(4, GetParam());
  const std::size_t elements =
      grid.mesh().quads.size() + grid.mesh().segments.size() + grid.mesh().corners.size();
  for (const MshVersion version : {MshVersion::v2_2, MshVersion::v4_1}) {
    WriteOptions options;
    options.msh_version = version;
    const auto file = folder / "grid.msh";
    write_mesh(grid.mesh(), file, options);
    const auto checked = test::run("gmsh -check -v 4 " + file.string() + " 2>&1");
    EXPECT_PRED2(contains, checked.out, fmt::format("{} nodes", grid.mesh().points.size()));
    EXPECT_PRED2(contains, checked.out, fmt::format("{} elements", elements));
    EXPECT_FALSE(contains(checked.out, "Error") || contains(checked.out, "Warning")) << checked.out;
    // Through Gmsh into its binary form, and back: nothing gets lost, groups included.
    for (const char* form : {"msh22", "msh41"}) {
      const auto binary = folder / (std::string(form) + ".msh");
      test::run(
          fmt::format("gmsh -save -bin -format {} -o {} {} 2>&1", form, binary.string(), file.string()));
      const ShellMesh back = read_mesh(binary);
      EXPECT_EQ(back.points.size(), grid.mesh().points.size()) << form;
      EXPECT_EQ(back.quads.size(), grid.mesh().quads.size()) << form;
      EXPECT_EQ(back.segments.size(), grid.mesh().segments.size()) << form;
      EXPECT_EQ(back.corners.size(), grid.mesh().corners.size()) << form;
      EXPECT_EQ(std::count(back.quad_faces.begin(), back.quad_faces.end(), 2), 16) << form;
      EXPECT_TRUE(contains(test::file_text(binary), "\"Face2\"")) << form;
    }
  }
}

/// Counts and groups of each file as FreeCAD sees them, one line a file.
std::string freecad_counts(const TemporaryFolder& folder, const std::vector<std::string>& files) {
  std::string script = "import Fem\n";
  for (const std::string& file : files)
    script += fmt::format(
        "m = Fem.read('{}')\n"
        "g = sorted('%s:%s:%d' % (m.getGroupName(i), m.getGroupElementType(i), len(m.getGroupElements(i))) "
        "for i in "
        "m.Groups)\n"
        "print('RESULT', '{}', m.NodeCount, m.EdgeCount, m.FaceCount, m.QuadrangleCount, "
        "len(m.getElementNodes("
        "m.Faces[0])), ' '.join(g))\n",
        (folder / file).string(), file);
  test::write_text(folder / "count_meshes_for_test.py", script);
  return test::run(fmt::format("cd {} && timeout 120 freecadcmd count_meshes_for_test.py 2>&1",
                               folder.path().string()))
      .out;
}

TEST_P(RoundTrip, FreeCadReadsCountsAndGroups) {
  if (!test::has_program("freecadcmd")) GTEST_SKIP() << "NOT TESTED: freecadcmd is not installed";
  const TemporaryFolder folder;
  const ShellGrid grid(4, GetParam());
  const std::vector<std::string> files{"a.med", "b.unv", "c.vtk", "d.vtu", "e.inp"};
  for (const std::string& file : files) write_mesh(grid.mesh(), folder / file);
  const std::string seen = freecad_counts(folder, files);
  const std::size_t nodes = grid.mesh().points.size();
  const int nodes_of_quad = GetParam() == 2 ? 8 : 4;
  const std::string groups =
      "Edge1:Edge:4 Edge2:Edge:4 Edge3:Edge:4 Edge4:Edge:4 Edge5:Edge:4 Edge6:Edge:4 Edge7:Edge:4 "
      "Face1:Face:16 "
      "Face2:Face:16 Vertex1:Node:1 Vertex2:Node:1 Vertex3:Node:1 Vertex4:Node:1 Vertex5:Node:1 "
      "Vertex6:Node:1";
  for (const char* file : {"a.med", "b.unv"})
    EXPECT_PRED2(contains, seen,
                 fmt::format("RESULT {} {} 28 32 32 {} {}", file, nodes, nodes_of_quad, groups));
  // Later versions of FreeCAD read the edges of .vtu files too.
  for (const char* file : {"c.vtk", "d.vtu", "e.inp"}) {
    const std::regex result(fmt::format("RESULT {} {} (0|28) 32 32 {} ", file, nodes, nodes_of_quad));
    EXPECT_TRUE(std::regex_search(seen, result)) << file << "\n" << seen;
  }
}

/// A strip of length 2 and width 1, clamped at x = 0, under pressure: the beam's deflection is p L^4 / (8 E
/// I) where Poisson's ratio is 0.
TEST_P(RoundTrip, CalculixSolvesTheInp) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  const TemporaryFolder folder;
  write_mesh(ShellGrid(8, GetParam(), 0).mesh(), folder / "strip.inp");
  const std::string model =
      test::file_text(folder / "strip.inp") +
      "*MATERIAL, NAME=M\n*ELASTIC\n210000, 0\n*SHELL SECTION, ELSET=Eall, MATERIAL=M\n0.02\n"
      "*BOUNDARY\nEdge1, 1, 6\n*STEP\n*STATIC\n*DSLOAD\nSurface_Face1, P, -0.001\n"
      "Surface_Face2, P, -0.001\n*NODE PRINT, NSET=Vertex3\nU\n*END STEP\n";
  test::write_text(folder / "strip.inp", model);
  const auto solved = test::run("cd " + folder.path().string() + " && timeout 120 ccx strip 2>&1");
  EXPECT_FALSE(contains(solved.out, "WARNING") || contains(solved.out, "ERROR")) << solved.out;
  std::istringstream result(test::file_text(folder / "strip.dat"));
  std::string word;
  double value = 0, deflection = 0;
  while (result >> word)
    if (word == "1.000000E+00" || word == "0.1000000E+01") break;
  while (result >> value) deflection = value;  // node, u, v, w
  const double moment_of_inertia = 0.02 * 0.02 * 0.02 / 12;
  const double expected = 0.001 * 16 / (8 * 210000 * moment_of_inertia);
  // Four-node shells are too stiff: second order is what shells need.
  EXPECT_NEAR(deflection, expected, (GetParam() == 2 ? 0.01 : 0.1) * expected);
}

/// The same strip, pulled at x = 2 by a load on the sides of its elements: u = f L / (E t).
TEST_P(RoundTrip, CalculixPullsAtAnEdge) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  const TemporaryFolder folder;
  write_mesh(ShellGrid(8, GetParam(), 0).mesh(), folder / "strip.inp");
  const std::string model = test::file_text(folder / "strip.inp") +
                            "*MATERIAL, NAME=M\n*ELASTIC\n210000, 0\n*SHELL SECTION, ELSET=Eall, "
                            "MATERIAL=M\n0.02\n*BOUNDARY\nEdge1, 1, 6\n*STEP\n*STATIC\n*DLOAD\n"
                            "Edge3_Side2, EDNOR2, -2.1\n*NODE PRINT, NSET=Vertex3\nU\n*END STEP\n";
  test::write_text(folder / "strip.inp", model);
  const auto solved = test::run("cd " + folder.path().string() + " && timeout 120 ccx strip 2>&1");
  EXPECT_FALSE(contains(solved.out, "WARNING") || contains(solved.out, "ERROR")) << solved.out;
  std::istringstream result(test::file_text(folder / "strip.dat"));
  std::string word;
  double value = 0;
  std::vector<double> values;
  while (result >> word)
    if (word == "1.000000E+00" || word == "0.1000000E+01") break;
  while (result >> value) values.push_back(value);  // node, u, v, w
  ASSERT_EQ(values.size(), 4u);
  EXPECT_NEAR(values[1], 2.1 * 2 / (210000 * 0.02), 1e-5);
}

TEST(Picture, IsDrawnWithoutAScreen) {
  ::unsetenv("DISPLAY");
  const TemporaryFolder folder;
  write_picture(ShellGrid(6, 2).mesh(), folder / "grid.png", 400, 300);
  const std::string bytes = test::file_text(folder / "grid.png");
  ASSERT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const auto big_endian = [&](std::size_t place) {
    return (static_cast<unsigned char>(bytes[place + 2]) << 8) + static_cast<unsigned char>(bytes[place + 3]);
  };
  EXPECT_EQ(big_endian(16), 400);
  EXPECT_EQ(big_endian(20), 300);
  // An empty white picture of this size takes some hundred bytes.
  EXPECT_GT(bytes.size(), 10000u);
  EXPECT_EQ(::getenv("DISPLAY"), nullptr);
}

}  // namespace
}  // namespace quadrille
