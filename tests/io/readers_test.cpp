/// Meshes of other programs: their elements, names and sets, and one sentence for what is damaged.

#include "mesher/io/readers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "geometry/base/error.hpp"
#include "mesher/io/io.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shell_grid.hpp"

namespace quadrille {
namespace {

using test::ShellGrid;
using test::TemporaryFolder;

/// Where the members of each group lie, by the group's dimension and name.
std::map<std::string, std::multiset<std::string>> members(const ShellMesh& mesh) {
  std::map<std::string, std::multiset<std::string>> result;
  for (const ShellMesh::Group& group : mesh.groups) {
    auto& places = result[fmt::format("{} {}", group.dimension, group.name)];
    const auto has = [&](int entity) {
      return std::binary_search(group.entities.begin(), group.entities.end(), entity);
    };
    const auto add = [&](const auto& nodes) {
      Vector3 sum = Vector3::Zero();
      for (const int node : nodes) sum += mesh.points[node];
      sum /= static_cast<double>(nodes.size());
      places.insert(fmt::format("{:.6f} {:.6f} {:.6f}", sum.x(), sum.y(), sum.z()));
    };
    for (std::size_t i = 0; i < mesh.quads.size(); ++i)
      if (group.dimension == 2 && has(mesh.quad_faces[i])) add(mesh.quads[i]);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (group.dimension == 2 && has(mesh.triangle_faces[i])) add(mesh.triangles[i]);
    for (const ShellMesh::Segment& segment : mesh.segments)
      if (group.dimension == 1 && has(segment.edge)) add(segment.nodes);
    for (const ShellMesh::Corner& corner : mesh.corners)
      if (group.dimension == 0 && has(corner.vertex)) add(std::array{corner.node});
  }
  return result;
}

/// The grid of two faces with names that have nothing to do with their numbers, and overlap.
ShellMesh named_grid(int order = 1) {
  ShellMesh mesh = ShellGrid(3, order).mesh();
  mesh.groups = {{"Face1", 2, 12, {2}},
                 {"the whole plate", 2, 5, {1, 2}},
                 {"left rim", 1, 7, {1}},
                 {"outer edges", 1, 3, {4, 6}},
                 {"support", 0, 9, {1, 4}}};
  return mesh;
}

class Named : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Formats, Named, testing::Values("a.msh", "4.msh", "a.vtu"), [](const auto& file) {
  std::string name = file.param;
  name[1] = '_';
  return name;
});

TEST_P(Named, GroupsComeBackAsTheyWentOut) {
  const TemporaryFolder folder;
  for (const int order : {1, 2}) {
    const ShellMesh mesh = named_grid(order);
    WriteOptions options;
    options.msh_version = GetParam()[0] == '4' ? MshVersion::v4_1 : MshVersion::v2_2;
    write_mesh(mesh, folder / GetParam(), options);
    const ShellMesh back = read_mesh(folder / GetParam());
    EXPECT_EQ(members(back), members(mesh));
    EXPECT_EQ(back.quads.size(), mesh.quads.size());
    EXPECT_EQ(back.segments.size(), mesh.segments.size());
    EXPECT_EQ(back.order, order);
    if (GetParam() == "a.vtu") continue;  // it has no numbers
    for (const ShellMesh::Group& group : back.groups) {
      const auto same = std::find_if(mesh.groups.begin(), mesh.groups.end(),
                                     [&](const auto& other) { return other.name == group.name; });
      ASSERT_NE(same, mesh.groups.end());
      EXPECT_EQ(group.number, same->number);
    }
  }
}

TEST(Readers, InpKeepsSetsOfElementsAndOfNodes) {
  const TemporaryFolder folder;
  const ShellMesh mesh = named_grid();
  write_mesh(mesh, folder / "a.inp");
  const auto back = members(read_mesh(folder / "a.inp"));
  const auto before = members(mesh);
  EXPECT_EQ(back.at("2 Face1"), before.at("2 Face1"));
  EXPECT_EQ(back.at("2 the_whole_plate"), before.at("2 the whole plate"));
  EXPECT_EQ(back.at("0 support"), before.at("0 support"));
  EXPECT_EQ(back.at("0 left_rim").size(), 4U);  // lines are the nodes on them
  EXPECT_EQ(back.size(), 5U);
}

TEST(Readers, InpSetsMayNameOthersAndOverlap) {
  const ShellMesh mesh = read_inp(
      "*NODE, NSET=every one\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,2,0,0\n6,2,1,0\n"
      "*ELEMENT, TYPE=S3, ELSET=Plate\n1,1,2,3\n2,1,3,4\n*ELEMENT, TYPE=S4, ELSET=Plate\n3,2,5,6,3\n"
      "*ELSET, ELSET=Tip\n3,\n*ELSET, ELSET=Both\ntip, 1\n*NSET, NSET=Ends, "
      "GENERATE\n1,5,4\n*NSET,NSET=Tip\n5,6\n",
      "a.inp");
  const auto groups = members(mesh);
  ASSERT_EQ(groups.size(), 5U);
  EXPECT_EQ(groups.at("2 Plate").size(), 3U);
  EXPECT_EQ(groups.at("2 Tip").size(), 1U);
  EXPECT_EQ(groups.at("2 Both").size(), 2U);
  EXPECT_EQ(groups.at("0 Ends"),
            (std::multiset<std::string>{"0.000000 0.000000 0.000000", "2.000000 0.000000 0.000000"}));
  EXPECT_EQ(groups.at("0 everyone").size(), 6U);
  EXPECT_EQ(std::set<int>(mesh.triangle_faces.begin(), mesh.triangle_faces.end()).size(), 2U);
}

/// A set of elements and the set of its nodes under one name, which .inp has as one anyway.
TEST(Readers, SetsOfElementsAndOfTheirNodesAreOneInInp) {
  const TemporaryFolder folder;
  const ShellMesh mesh = read_msh(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"top\"\n0 2 \"top\"\n"
      "$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 1 1 0\n$EndNodes\n$Elements\n4\n"
      "1 2 2 1 1 1 2 3\n2 15 2 2 1 1\n3 15 2 2 2 2\n4 15 2 2 3 3\n$EndElements\n",
      "a.msh");
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.corners.size(), 3U);
  write_mesh(mesh, folder / "a.inp");
  const std::string text = test::file_text(folder / "a.inp");
  EXPECT_NE(text.find("NSET=top\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("top_2"), std::string::npos) << text;
}

/// Gmsh writes an element of two physical groups twice in version 2.2.
TEST(Readers, MshUnitesElementsOfSeveralGroups) {
  const ShellMesh mesh = read_msh(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"all of it\"\n2 2 "
      "\"top\"\n$EndPhysicalNames\n"
      "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n3\n1 2 2 1 6 1 2 3\n2 2 2 1 7 1 "
      "3 4\n"
      "3 2 2 2 7 1 3 4\n$EndElements\n",
      "a.msh");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangle_faces, (std::vector<int>{6, 7}));
  EXPECT_EQ(members(mesh).at("2 all of it").size(), 2U);
  EXPECT_EQ(members(mesh).at("2 top").size(), 1U);
}

/// Gmsh writes the middle last. It is dropped, and midside nodes keep their sides.
TEST(Readers, QuadsOfNineNodesLoseTheirMiddle) {
  const TemporaryFolder folder;
  const double at[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  std::string inp = "*NODE\n";
  for (int i = 0; i < 9; ++i) inp += fmt::format("{}, {}, {}, 0\n", i + 1, at[i][0], at[i][1]);
  inp += "*ELEMENT, type=M3D9, ELSET=all\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9\n";
  test::write_text(folder / "a.inp", inp);
  const ShellMesh mesh = read_mesh(folder / "a.inp");
  ASSERT_EQ(mesh.quads.size(), 1U);
  EXPECT_EQ(mesh.points.size(), 8U);
  EXPECT_EQ(mesh.order, 2);
  for (int side = 0; side < 4; ++side) {
    const Vector3 &a = mesh.points[mesh.quads[0][side]], &b = mesh.points[mesh.quads[0][(side + 1) % 4]];
    EXPECT_EQ(mesh.points[mesh.midsides[0][side]], (0.5 * (a + b)).eval());
  }
}

TEST(Readers, MshOfTheFirstVersionHasNoHeader) {
  const TemporaryFolder folder;
  test::write_text(
      folder / "a.msh",
      "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$ENDNOD\n$ELM\n3\n1 1 7 5 2 1 2\n2 2 9 3 3 1 2 3\n"
      "3 2 9 3 3 1 3 4\n$ENDELM\n");
  const ShellMesh mesh = read_mesh(folder / "a.msh");
  EXPECT_EQ(mesh.triangle_faces, (std::vector<int>{3, 3}));
  ASSERT_EQ(mesh.segments.size(), 1U);
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].number + mesh.groups[1].number, 16);
}

TEST(Readers, InpHasTheMiddleOfALineBetweenItsEnds) {
  const TemporaryFolder folder;
  test::write_text(folder / "a.inp",
                   "*NODE\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 2, 0\n4, 1, 0, 0\n5, 2, 1, 0\n6, 1, 1, 0\n"
                   "*ELEMENT, TYPE=S6, ELSET=all\n1, 1, 2, 3, 4, 5, 6\n"
                   "*ELEMENT, TYPE=T3D3, ELSET=rim\n2, 1, 4, 2\n");
  const ShellMesh mesh = read_mesh(folder / "a.inp");
  ASSERT_EQ(mesh.segments.size(), 1U);
  const auto& [a, b] = mesh.segments[0].nodes;
  EXPECT_EQ(mesh.points[a], Vector3(0, 0, 0));
  EXPECT_EQ(mesh.points[b], Vector3(2, 0, 0));
}

TEST(Readers, VtkReadsWhatWeWrite) {
  const TemporaryFolder folder;
  for (const char* name : {"a.vtu", "a.vtk"}) {
    const ShellMesh mesh = ShellGrid(3, 1).mesh();
    write_mesh(mesh, folder / name);
    const ShellMesh back = read_mesh(folder / name);
    EXPECT_EQ(back.quads, mesh.quads) << name;
    EXPECT_EQ(back.quad_faces, mesh.quad_faces) << name;
    EXPECT_EQ(back.segments.size(), std::string(name) == "a.vtu" ? mesh.segments.size() : 0U);
  }
}

TEST(Readers, VtkKeepsSetsThoseOfSidesAsNodes) {
  const TemporaryFolder folder;
  const ShellMesh mesh = named_grid();
  write_mesh(mesh, folder / "a.vtk");
  const auto before = members(mesh), after = members(read_mesh(folder / "a.vtk"));
  for (const char* name : {"2 Face1", "2 the whole plate", "0 support"})
    EXPECT_EQ(after.at(name), before.at(name)) << name;
  EXPECT_EQ(after.at("0 left rim").size(), 4U);
  EXPECT_EQ(after.count("1 left rim"), 0U);
  // Names that arrays of ours have.
  ShellMesh odd = named_grid();
  odd.groups = {{"q", 2, 0, {2}}, {"face", 2, 0, {1}}, {"50 % \"w\" \xc3\xa4", 2, 0, {1, 2}}};
  for (const char* file : {"c.vtk", "c.vtu"}) {
    write_mesh(odd, folder / file);
    const ShellMesh back = read_mesh(folder / file);
    EXPECT_EQ(back.quad_faces, odd.quad_faces) << file;
    const auto found = members(back), wanted = members(odd);
    EXPECT_EQ(found.at("2 q_"), wanted.at("2 q")) << file;
    EXPECT_EQ(found.at("2 face_"), wanted.at("2 face")) << file;
    EXPECT_EQ(found.count("2 50 % _w_ \xc3\xa4"), 1U) << file;
  }
  // What the array `face` tells is not told again, and a mesh without names has no sets.
  write_mesh(ShellGrid(3, 1).mesh(), folder / "b.vtk");
  EXPECT_EQ(test::file_text(folder / "b.vtk").find("unsigned_char"), std::string::npos);
  EXPECT_TRUE(read_mesh(folder / "b.vtk").groups.empty());
}

const std::string two_solids =
    "solid lower part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
    "0\nendloop\nendfacet\n"
    "endsolid\nsolid upper part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid\n";

TEST(Readers, StlObjAndPlyShareTheirNodes) {
  const TemporaryFolder folder;
  test::write_text(folder / "a.stl", two_solids);
  const ShellMesh stl = read_mesh(folder / "a.stl");
  EXPECT_EQ(stl.points.size(), 4U);
  EXPECT_EQ(stl.triangles.size(), 2U);
  EXPECT_EQ(members(stl).at("2 lower part").size(), 1U);
  EXPECT_EQ(members(stl).at("2 upper part").size(), 1U);
  test::write_text(folder / "a.obj",
                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 6 5\n");
  const ShellMesh obj = read_mesh(folder / "a.obj");
  EXPECT_EQ(obj.points.size(), 5U);
  EXPECT_EQ(obj.quads.size(), 1U);
  EXPECT_EQ(obj.triangles.size(), 1U);
  test::write_text(
      folder / "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
      "3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(read_mesh(folder / "a.ply").triangles.size(), 2U);
}

/// What VTK's readers crash on is a sentence all the same.
TEST(Readers, DamagedPlyIsASentence) {
  const TemporaryFolder folder;
  test::write_text(
      folder / "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 99999\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
  test::write_text(
      folder / "b.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n");
  for (const char* name : {"a.ply", "b.ply"}) {
    try {
      read_mesh(folder / name);
      ADD_FAILURE() << name << ": nothing was refused";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

struct Damaged {
  std::string file, text, says;
};

/// A file of one quad with these points.
std::string vtk_quad(const std::string& points) {
  return "# vtk DataFile Version 2.0\nA quad\nASCII\nDATASET UNSTRUCTURED_GRID\n" + points +
         "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n";
}

class DamagedFiles : public testing::TestWithParam<Damaged> {};
INSTANTIATE_TEST_SUITE_P(
    Readers, DamagedFiles,
    testing::Values(
        Damaged{"a.stl", "rubbish\n", "a.stl"}, Damaged{"a.ply", "ply\nformat ascii 1.0\n", "a.ply"},
        Damaged{"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3 4 5\n",
                "polygon with 5 corners"},
        Damaged{"a.vtu", "<VTKFile", "a.vtu"}, Damaged{"a.vtk", "# vtk DataFile", "a.vtk"},
        Damaged{"a.inp", "*NODE\n1,0,0\n*ELSET,ELSET=A\n7\n", "the set A holds element 7"},
        Damaged{"a.msh",
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 top\n$EndPhysicalNames\n",
                "line 6: expected a name in quotes"},
        Damaged{
            "b.ply",
            "ply\nformat ascii 1.0\nelement vertex -1\nproperty float x\nproperty float y\nproperty float z\n"
            "element face -1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
            "not enough memory"},
        // One coordinate too many, and too few; a place whose squares are infinite; counts of 10^9 in 200
        // bytes.
        Damaged{"b.vtk", vtk_quad("POINTS 4 double\n0 0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), "b.vtk"},
        Damaged{"c.vtk", vtk_quad("POINTS 4 double\n0 0 0\n1 0 0\n1 0\n0 1 0\n"), "c.vtk"},
        Damaged{"d.vtk", vtk_quad("POINTS 4 double\n0 0 0\n1 0 0\n1e308 1 0\n0 1 0\n"),
                "node 3 has no finite"},
        Damaged{"e.vtk", vtk_quad("POINTS 1000000000 double\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), "e.vtk"},
        Damaged{"a.xyz", "", "unknown mesh format (known are .msh, .inp, .stl, "},
        Damaged{"a.unv", "", "Gmsh and meshio convert others to .msh"}),
    [](const auto& file) {
      std::string name = file.param.file;
      name[1] = '_';
      return name;
    });

TEST_P(DamagedFiles, GiveOneSentenceThatNamesTheFile) {
  const TemporaryFolder folder;
  test::write_text(folder / GetParam().file, GetParam().text);
  try {
    read_mesh(folder / GetParam().file);
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(GetParam().says), std::string::npos) << what;
    EXPECT_NE(what.find(GetParam().file), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    for (const char* inner : {"std::", "vector::", "_M_"})
      EXPECT_EQ(what.find(inner), std::string::npos) << what;
  }
}

TEST(Readers, WhatHasNoEndIsNotRead) {
  const TemporaryFolder folder;
  for (const char* name : {"zero.msh", "zero.stl", "large.inp", "large.vtk"}) {
    if (name[0] == 'z') std::filesystem::create_symlink("/dev/zero", folder / name);
    if (name[0] == 'l') {
      test::write_text(folder / name, "");
      std::filesystem::resize_file(folder / name, std::uintmax_t{1} << 42);
    }
    try {
      read_mesh(folder / name);
      ADD_FAILURE() << name << ": nothing was refused";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string(name) + ": cannot be read"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace quadrille
