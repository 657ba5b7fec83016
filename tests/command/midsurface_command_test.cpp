/// Thin solids through the command: what it writes, what it refuses.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/cad/cad_model.hpp"
#include "mesher/io/io.hpp"
#include "tests/models/thin_models.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

/// A folder with thin.brep (a sheet of 3 and 2 mm), taper.brep (one of 4 to 2 mm), frame.brep (three profiles
/// that touch), block.brep, both.brep (a plate on a block) and wide_foot.brep (walls that cannot be joined).
class MidsurfaceCommand : public testing::Test {
 protected:
  void SetUp() override {
    for (const ThinModel& model : thin_models()) {
      if (model.name == "stepped_sheet") write(model.make(), "thin.brep");
      if (model.name == "tapering_web") write(model.make(), "taper.brep");
    }
    write(welded_frame(), "frame.brep");
    write(thick_block(), "block.brep");
    write(plate_on_block(), "both.brep");
    // The plate ends inside the foot of a wall that is wider than it.
    write(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(100, 60, 3).Shape(),
                           BRepPrimAPI_MakeBox(gp_Pnt(97, 50, 0), 5, 20, 30).Shape())
              .Shape(),
          "wide_foot.brep");
  }

  /// Runs `quadrille` with these arguments; gives the exit code and what it says on stderr.
  test::ProcessResult quadrille_says(const std::string& arguments) const {
    return test::run(fmt::format("cd {} && timeout 300 {}/quadrille {} 2>&1 >/dev/null",
                                 folder_.path().string(), QUADRILLE_BINARY_DIR, arguments));
  }
  /// What `quadrille` with these arguments says on stdout.
  std::string quadrille_prints(const std::string& arguments) const {
    return test::run(fmt::format("cd {} && timeout 300 {}/quadrille {} 2>/dev/null", folder_.path().string(),
                                 QUADRILLE_BINARY_DIR, arguments))
        .out;
  }
  std::string text(const std::string& name) const { return test::file_text(folder_ / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

 private:
  void write(const TopoDS_Shape& shape, const std::string& name) const {
    ASSERT_TRUE(BRepTools::Write(shape, path(name).c_str()));
  }
  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(MidsurfaceCommand, WritesFacesThatReadBackAlike) {
  const auto result = quadrille_says("midsurface thin.brep -o m.brep -o m.step -o m.json --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_EQ(result.out, "");
  const CadModel brep = CadModel::read(path("m.brep")), step = CadModel::read(path("m.step"));
  EXPECT_EQ(brep.face_count(), 3);
  EXPECT_EQ(step.face_count(), 3);
  EXPECT_EQ(step.edge_count(), brep.edge_count());  // shared where they meet
  EXPECT_NEAR(brep.area(), 5025, 1e-6);
  EXPECT_NEAR(step.area(), 5025, 1e-6);
  const auto told = nlohmann::json::parse(text("m.json"));
  ASSERT_EQ(told["faces"].size(), 3U);
  EXPECT_NEAR(told["faces"][0]["thickness"].get<double>(), 3, 1e-9);
  double written = 0;
  for (const auto& face : told["faces"])
    written += face["area"].get<double>() * face["thickness"].get<double>();
  EXPECT_NEAR(told["area_times_thickness"].get<double>(), written, 1e-6 * written);
  // Two plates count twice where they meet.
  EXPECT_NEAR(told["area_times_thickness"].get<double>() / told["volume"].get<double>(), 1, 0.01);
}

/// Nothing is made there, so nothing stays there if the process is killed.
TEST_F(MidsurfaceCommand, NeedsNoTemporaryFolder) {
  const std::string command = fmt::format("cd {} && TMPDIR=/nowhere timeout 300 {}/quadrille ",
                                          path("").string(), QUADRILLE_BINARY_DIR);
  for (const char* arguments : {"midsurface thin.brep -o a.step --quiet 2>&1", "info a.step 2>&1"}) {
    const auto result = test::run(command + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.out;
  }
}

TEST_F(MidsurfaceCommand, RefusesWhatIsNotThin) {
  const auto block = quadrille_says("midsurface block.brep -o m.brep");
  EXPECT_EQ(block.exit_code, 1);
  EXPECT_PRED2(contains, block.out, "not a thin solid");
  const auto both = quadrille_says("midsurface both.brep -o m.brep");
  EXPECT_EQ(both.exit_code, 1);
  EXPECT_PRED2(contains, both.out, "without a partner: Face");
  EXPECT_FALSE(exists("m.brep"));
  EXPECT_EQ(quadrille_says("midsurface both.brep -o m.brep --partial").exit_code, 0);
  EXPECT_TRUE(exists("m.brep"));
}

TEST_F(MidsurfaceCommand, RefusesUnknownFormats) {
  const auto result = quadrille_says("midsurface thin.brep -o m.msh");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_PRED2(contains, result.out, ".brep, .step or .json");
  EXPECT_FALSE(exists("m.msh"));
}

TEST_F(MidsurfaceCommand, MeshesThinSolidsWithASectionForEachThickness) {
  const auto result =
      quadrille_says("mesh thin.brep --thin --size 10 --keep-features -o m.inp -o m.unv -o m.med --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  const std::string deck = text("m.inp");
  // The face that joins the steps has the smaller thickness.
  EXPECT_PRED2(contains, deck,
               "*ELSET, ELSET=Thickness3\nFace1\n*SHELL SECTION, ELSET=Thickness3, MATERIAL=Material\n3\n");
  EXPECT_PRED2(
      contains, deck,
      "*ELSET, ELSET=Thickness2\nFace2\nFace3\n*SHELL SECTION, ELSET=Thickness2, MATERIAL=Material\n2\n");
  EXPECT_GT(read_mesh(path("m.inp")).quads.size(), 50U);
  EXPECT_PRED2(contains, text("m.unv"), "\nThickness3\n");
  EXPECT_PRED2(contains, text("m.med"), "Thickness2");
  EXPECT_EQ(quadrille_says("mesh block.brep --thin -o b.inp").exit_code, 1);
  EXPECT_FALSE(exists("b.inp"));
}

TEST_F(MidsurfaceCommand, PutsThicknessesIntoEachFormat) {
  const auto result = quadrille_says(
      "mesh thin.brep --thin --size 10 --keep-features --msh-version 4.1 -o m.msh -o m.bdf -o m.vtk -o m.vtu "
      "--quiet");
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_PRED2(contains, text("m.msh"), "\"Thickness3\"\n");
  EXPECT_PRED2(contains, text("m.msh"), "\"Thickness2\"\n");
  std::vector<std::string> groups;
  for (const ShellMesh::Group& group : read_mesh(path("m.msh")).groups) {
    if (group.name.rfind("Thickness", 0) == 0)
      groups.push_back(fmt::format("{} on {} faces", group.name, group.entities.size()));
  }
  EXPECT_EQ(groups, (std::vector<std::string>{"Thickness3 on 1 faces", "Thickness2 on 2 faces"}));
  EXPECT_PRED2(contains, text("m.bdf"), "$ Thickness2: elements\nSET ");
  EXPECT_PRED2(contains, text("m.bdf"), "PSHELL         1       1      3.\n");
  EXPECT_PRED2(contains, text("m.vtk"), "SCALARS thickness double 1\nLOOKUP_TABLE default\n3");
  EXPECT_PRED2(contains, text("m.vtu"), "Name=\"thickness\"");
}

/// The force at the end of a cantilever of length L and width b, whose thickness goes evenly from h to h / 2,
/// bends it by F L^3 / (E I) * 8 (ln 2 - 5 / 8), I = b h^3 / 12 of the thick end.
TEST_F(MidsurfaceCommand, WritesThicknessesThatVaryForCalculix) {
  if (!test::has_program("ccx")) GTEST_SKIP() << "NOT TESTED: ccx is not installed";
  ASSERT_EQ(quadrille_says("mesh taper.brep --thin --size 5 -o m.inp -o m.bdf --quiet").exit_code, 0);
  const std::string deck = text("m.inp");
  EXPECT_PRED2(contains, deck, "ELSET=Thickness2to3.999, MATERIAL=Material, NODAL THICKNESS\n");
  EXPECT_PRED2(contains, deck, "\n*NODAL THICKNESS\n1, ");
  std::vector<int> held, moved;
  const ShellMesh mesh = read_mesh(path("m.inp"));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (mesh.points[i].x() < 1e-6) held.push_back(static_cast<int>(i) + 1);
    if (mesh.points[i].x() > 100 - 1e-6) moved.push_back(static_cast<int>(i) + 1);
  }
  ASSERT_GT(moved.size(), 10U);
  std::string model = "*NSET, NSET=Held\n" + fmt::format("{}\n", fmt::join(held, ",\n"));
  model += "*NSET, NSET=Moved\n" + fmt::format("{}\n", fmt::join(moved, ",\n"));
  model = "*INCLUDE, INPUT=m.inp\n" + model + "*BOUNDARY\nHeld, 1, 6\n";
  model += fmt::format("*STEP\n*STATIC\n*CLOAD\nMoved, 2, {}\n", 100.0 / static_cast<double>(moved.size()));
  model += "*NODE PRINT, NSET=Moved\nU\n*END STEP\n";
  test::write_text(path("taper.inp"), "*MATERIAL, NAME=Material\n*ELASTIC\n210000, 0\n" + model);
  const auto solved =
      test::run(fmt::format("cd {} && timeout 120 ccx taper 2>&1", path("taper.inp").parent_path().string()));
  EXPECT_FALSE(contains(solved.out, "ERROR")) << solved.out;
  std::istringstream result(text("taper.dat"));
  std::string line;
  double sum = 0, count = 0;
  while (std::getline(result, line)) {
    double node = 0, u = 0, v = 0, w = 0;
    if (!(std::istringstream(line) >> node >> u >> v >> w)) continue;
    sum += v;
    count += 1;
  }
  ASSERT_EQ(count, static_cast<double>(moved.size()));
  const double second_moment = 60 * 64 / 12.0;
  const double expected = 100 * 1e6 / (210000 * second_moment) * 8 * (std::log(2) - 0.625);
  EXPECT_NEAR(sum / count / expected, 1, 0.01);
}

/// Whoever meshes in one go learns as much as with the middle surface alone.
TEST_F(MidsurfaceCommand, MeshTellsAllThatIsKnownOfTheMiddleSurface) {
  ASSERT_EQ(quadrille_says("midsurface both.brep --partial -o m.json --quiet").exit_code, 0);
  ASSERT_EQ(
      quadrille_says("mesh both.brep --thin --partial --size 10 -o m.inp --report r.json --quiet").exit_code,
      0);
  const auto told = nlohmann::json::parse(text("m.json")), report = nlohmann::json::parse(text("r.json"));
  EXPECT_EQ(report["middle_surface"], told);
  ASSERT_FALSE(told["problems"].empty());
  EXPECT_FALSE(told["unpaired_solid_faces"].empty());
  for (const auto& problem : told["problems"])
    EXPECT_NE(std::find(report["warnings"].begin(), report["warnings"].end(), problem),
              report["warnings"].end());
  const std::string table = quadrille_prints("midsurface both.brep --partial -o m.json");
  EXPECT_PRED2(contains, table, "thickness  between\nFace1 ");
  EXPECT_PRED2(contains, table, "% without what counts twice where walls meet); 1 part of 1 solid, ");
  EXPECT_PRED2(contains, table, "neither side nor rim of a wall: Face");
  EXPECT_EQ(quadrille_prints("mesh both.brep --thin --partial --size 10 -o m.inp").rfind(table, 0), 0U);
}

/// What is refused can be seen: nothing else is written.
TEST_F(MidsurfaceCommand, DrawsWhatItRefuses) {
  const auto result = quadrille_says("mesh wide_foot.brep --thin --size 5 -o m.inp --picture m.png --quiet");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out, "inside the material between Face");
  EXPECT_PRED2(contains, result.out, "m.png shows it, with edges inside the material in red");
  EXPECT_TRUE(exists("m.png"));
  EXPECT_FALSE(exists("m.inp"));
  const auto block = quadrille_says("mesh block.brep --thin --size 5 -o m.inp --picture b.png --quiet");
  EXPECT_EQ(block.exit_code, 1);
  EXPECT_FALSE(exists("b.png"));
}

TEST_F(MidsurfaceCommand, EndsWithItsTimeLimit) {
  const auto result = quadrille_says("midsurface thin.brep -o late.brep --time-limit 0.001");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out, "the time limit of 0.001 s is reached");
  EXPECT_FALSE(exists("late.brep"));
  EXPECT_EQ(quadrille_says("midsurface thin.brep -o m.brep --time-limit 100").exit_code, 0);
}

TEST_F(MidsurfaceCommand, JoinsSolidsThatTouch) {
  ASSERT_EQ(quadrille_says("midsurface frame.brep -o apart.json --quiet").exit_code, 0);
  ASSERT_EQ(quadrille_says("midsurface frame.brep --join -o joined.json --quiet").exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(text("apart.json"))["parts"], 3);
  EXPECT_EQ(nlohmann::json::parse(text("joined.json"))["parts"], 1);
  const auto told = quadrille_says("mesh frame.brep --thin --join --size 10 -o m.inp");
  EXPECT_EQ(told.exit_code, 0) << told.out;
  EXPECT_EQ(quadrille_says("mesh frame.brep --join --size 10 -o m.inp").exit_code, 2);
}

}  // namespace
}  // namespace quadrille
