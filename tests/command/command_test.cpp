/// The command as users meet it: exit codes, one line for each mistake, no partial file, what comes out.

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>
#include <regex>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>
#include <tuple>

#include <fmt/format.h>

#include "mesher/io/io.hpp"
#include "tests/models/trouble_models.hpp"
#include "tests/support/process.hpp"

namespace quadrille {
namespace {

using test::TemporaryFolder;

const std::string program = QUADRILLE_BINARY_DIR "/quadrille";
/// A box of 30 x 20 x 10, diagonal 37.4: small enough to mesh in an instant.
const std::string box = QUADRILLE_SOURCE_DIR "/examples/models/box.brep";
const std::string bracket = QUADRILLE_SOURCE_DIR "/examples/models/bracket.step";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Runs the command in a folder; the result holds stderr alone.
test::ProcessResult stderr_of(const TemporaryFolder& folder, const std::string& arguments) {
  return test::run(
      fmt::format("cd {} && timeout 300 {} {} 2>&1 >/dev/null", folder.path().string(), program, arguments));
}

test::ProcessResult stdout_of(const TemporaryFolder& folder, const std::string& arguments) {
  return test::run(
      fmt::format("cd {} && timeout 300 {} {} 2>/dev/null", folder.path().string(), program, arguments));
}

struct Mistake {
  std::string arguments;  ///< IN stands for the box, OUT for "-o out.msh"
  int exit_code;
  std::string says;
};

std::string filled(std::string text) {
  for (const auto& [from, to] :
       {std::pair{std::string("IN"), box}, std::pair{std::string("OUT"), std::string("-o out.msh")}})
    for (std::size_t place; (place = text.find(from)) != std::string::npos;)
      text.replace(place, from.size(), to);
  return text;
}

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.arguments;
}

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, GiveOneLineAndNoFile) {
  const TemporaryFolder folder;
  test::write_text(folder / "text.step", "this is not CAD\n");
  test::write_text(folder / "empty.step", "");
  test::write_text(folder / "empty.brep", "");
  test::write_text(folder / "cut.brep", test::file_text(box).substr(0, 2000));
  ShellMesh square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.quads = {{0, 1, 2, 3}};
  square.quad_faces = {1};
  write_mesh(square, folder / "square.msh");
  test::write_text(folder / "broken.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n");
  std::filesystem::create_directory(folder / "folder.msh");
  const int before = folder.file_count();
  const auto result = stderr_of(folder, filled(GetParam().arguments));
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_PRED2(contains, result.out, GetParam().says);
  EXPECT_EQ(folder.file_count(), before);
}

INSTANTIATE_TEST_SUITE_P(
    Use, Mistakes,
    testing::Values(
        Mistake{"", 2, "subcommand"}, Mistake{"mash IN OUT", 2, "quadrille: "},
        Mistake{"mesh", 2, "IN is required"}, Mistake{"mesh IN", 2, "--output is required"},
        Mistake{"mesh IN OUT --fast", 2, "--fast"}, Mistake{"mesh IN OUT extra", 2, "extra"},
        Mistake{"mesh IN OUT --size 0", 2, "--size"}, Mistake{"mesh IN OUT --size -1", 2, "--size"},
        Mistake{"mesh IN OUT --size nan", 2, "--size"}, Mistake{"mesh IN OUT --size inf", 2, "--size"},
        Mistake{"mesh IN OUT --size big", 2, "--size"},
        Mistake{"mesh IN OUT --size 38", 2, "larger than the model"},
        Mistake{"mesh IN OUT --size", 2, "--size"},
        Mistake{"mesh IN OUT --size 1 --elements-per-diagonal 9", 2, "--size"},
        Mistake{"mesh IN OUT --elements-per-diagonal 0", 2, "--elements-per-diagonal"},
        Mistake{"mesh IN OUT --size-min 0", 2, "--size-min"},
        Mistake{"mesh IN OUT --size 1 --size-min 2", 2, "--size-min"},
        Mistake{"mesh IN OUT --size 3 --bias Edge4=1.2 --bias-both Edge4=1.2", 2, "--bias-both names Edge4"},
        Mistake{"mesh IN OUT --growth 0", 2, "--growth"},
        Mistake{"mesh IN OUT --curvature -3", 2, "--curvature"},
        Mistake{"mesh IN OUT --order 3", 2, "--order"}, Mistake{"mesh IN OUT --order 0", 2, "--order"},
        Mistake{"mesh IN OUT --threads -1", 2, "--threads"},
        Mistake{"mesh IN OUT --strategy best", 2, "--strategy"}, Mistake{"mesh IN OUT --seed 1", 2, "--seed"},
        Mistake{"recombine IN OUT --seed -1", 2, "a whole number from 0"},
        Mistake{"recombine IN OUT --seed 99999999999999999999", 2, "a whole number from 0"},
        Mistake{"mesh IN OUT --size \'\'", 2, "--size"}, Mistake{"mesh IN OUT --size-min 3", 2, "--size-min"},
        Mistake{"mesh IN OUT --threads 1.5", 2, "--threads"},
        Mistake{"mesh IN OUT --faces \'\'", 2, "--faces"},
        Mistake{"mesh IN OUT --size-on \'\'", 2, "--size-on"},
        Mistake{"mesh IN OUT --size-on Face1=nan", 2, "--size-on"},
        Mistake{"mesh IN OUT --size-field \'\'", 2, "--size-field"},
        Mistake{"mesh IN OUT --merge-tiny 30", 2, "--merge-tiny"},
        Mistake{"mesh IN OUT --sew 100", 2, "--sew"},
        Mistake{"mesh IN OUT --time-limit 0", 2, "--time-limit"},
        Mistake{"info IN --read-time-limit -1", 2, "--read-time-limit"},
        Mistake{"mesh IN OUT --msh-version 3", 2, "--msh-version"},
        Mistake{"mesh IN OUT --faces Fase1", 2, "Fase1"}, Mistake{"mesh IN OUT --faces Face7", 2, "no Face7"},
        Mistake{"mesh IN OUT --faces Face1,Face0", 2, "Face0"},
        Mistake{"mesh IN OUT --size-on Face3", 2, "--size-on"},
        Mistake{"mesh IN OUT --size-on Face3=x", 2, "--size-on"},
        Mistake{"mesh IN OUT --size-on Face3=-1", 2, "--size-on"},
        Mistake{"mesh IN OUT --size-on Face3=1,Face3=2", 2, "Face3 twice"},
        Mistake{"mesh IN OUT --size-on Solid1=1", 2, "Solid1"},
        Mistake{"mesh IN OUT --size-on Edge13=1", 2, "no Edge13"},
        Mistake{"mesh IN OUT --size-on Vertex9=1", 2, "no Vertex9"},
        Mistake{"mesh IN -o out.stl", 2, "unknown mesh format"},
        Mistake{"mesh IN -o out", 2, "unknown mesh format"},
        Mistake{"mesh IN -o none/out.msh", 2, "none does not exist"},
        Mistake{"mesh IN -o folder.msh", 2, "is a folder"}, Mistake{"mesh IN OUT OUT", 2, "same file"},
        Mistake{"mesh IN OUT --report none/r.json", 2, "none does not exist"},
        Mistake{"mesh IN OUT --picture out.jpg", 2, ".png"},
        Mistake{"mesh IN OUT --write-size-field out.txt", 2, ".vdb"},
        Mistake{"mesh IN OUT --picture none/out.png", 2, "none"},
        Mistake{"sizes IN -o out.msh", 2, ".vtu or .json"}, Mistake{"sizes IN -o none/out.vtu", 2, "none"},
        Mistake{"sizes IN --count-only -o out.vtu", 2, "--count-only"},
        Mistake{"sizes IN --wanted-quads 5000", 2, "--count-only"},
        Mistake{"sizes IN --count-only --wanted-quads 5000 --size 2", 2, "--size"},
        Mistake{"sizes IN --size-on Face7=1", 2, "no Face7"},
        Mistake{"sizes IN -o a.vtu -o a.vtu", 2, "same file"}));

INSTANTIATE_TEST_SUITE_P(
    Input, Mistakes,
    testing::Values(
        Mistake{"mesh none.step OUT", 1, "none.step"}, Mistake{"mesh text.step OUT", 1, "text.step"},
        Mistake{"mesh empty.step OUT", 1, "empty.step"}, Mistake{"mesh empty.brep OUT", 1, "empty.brep"},
        Mistake{"mesh cut.brep OUT", 1, "cut.brep"}, Mistake{"mesh folder.msh OUT", 1, "folder"},
        Mistake{"mesh broken.msh OUT", 2, "unknown ending"},
        Mistake{"mesh IN OUT --size-field none.vdb", 1, "none.vdb"},
        Mistake{"info none.step", 1, "none.step"}, Mistake{"info text.step", 1, "text.step"},
        Mistake{"sizes text.step -o out.vtu", 1, "text.step"},
        Mistake{"sizes IN --size 1e-4 -o out.vtu", 2, "million"}, Mistake{"quality none.msh", 1, "none.msh"},
        Mistake{"quality broken.msh", 1, "broken.msh"}, Mistake{"quality text.step", 1, "text.step"},
        Mistake{"quality square.msh --limits none.json", 1, "none.json"},
        Mistake{"quality square.msh --limits text.step", 1, "neither JSON"},
        Mistake{"mesh IN OUT --size 1e-4", 2, "million"}));

const std::pair<const char*, std::vector<const char*>> numeric_options[] = {
    {"recombine square.msh OUT --merge", {"nan", "inf", "-1"}},
    {"recombine square.msh OUT --feature-angle", {"nan", "181", "-1"}},
    {"remesh square.msh OUT --size 1 --merge", {"nan"}},
    {"adapt square.msh square.msh -o a.vdb --count", {"0", "nan", "inf", "-5"}},
    {"adapt square.msh square.msh -o a.vdb --error", {"0", "1", "nan"}},
    {"adapt square.msh square.msh -o a.vdb --growth", {"0", "nan", "inf"}},
    {"adapt square.msh square.msh -o a.vdb --poisson", {"0.5", "nan", "-0.1"}},
    {"adapt square.msh square.msh -o a.vdb --size-min", {"nan", "-1"}},
    {"adapt square.msh square.msh -o a.vdb --size-max", {"inf", "-1"}},
    {"sizes IN --count-only --wanted-quads", {"0", "nan", "inf"}},
    {"quality square.msh --size-min", {"-1", "0", "nan", "inf"}},
    {"mesh IN OUT --time-limit", {"nan", "inf"}},
};

std::vector<Mistake> wrong_numbers() {
  std::vector<Mistake> mistakes;
  for (const auto& [command, values] : numeric_options)
    for (const char* value : values)
      mistakes.push_back({fmt::format("{} {}", command, value), 2, " must be a "});
  return mistakes;
}

INSTANTIATE_TEST_SUITE_P(Numbers, Mistakes, testing::ValuesIn(wrong_numbers()));

/// Points that close coincide to OpenCASCADE, and counts of them are beyond what a double holds.
INSTANTIATE_TEST_SUITE_P(
    TinySizes, Mistakes,
    testing::Values(Mistake{"mesh IN OUT --size 1e-200", 2, "1e-200 mm is requested"},
                    Mistake{"mesh IN OUT --elements-per-diagonal 1e300", 2, "mm is requested"},
                    Mistake{"mesh IN OUT --size-on Face1=1e-200", 2, "mm is requested"},
                    Mistake{"mesh IN OUT --size-on Edge1=1e-300", 2, "mm is requested"},
                    Mistake{"mesh IN OUT --size-on Vertex1=1e-300", 2, "mm is requested"}));

/// Refused before anything is spent: within 5 s of CPU, and 2 GB of memory beyond what libraries map.
class TooMuch : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(TooMuch, IsRefusedWithItsNumber) {
  const TemporaryFolder folder;
  const auto& [arguments, says] = GetParam();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const char* limits = "ulimit -t 20";
#else
  const char* limits = "ulimit -t 5; ulimit -v 3000000";
#endif
  const auto result = test::run(fmt::format("cd {} && {} && {} mesh {} -o out.msh {} 2>&1 >/dev/null",
                                            folder.path().string(), limits, program, bracket, arguments));
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_PRED2(contains, result.out, says);
  EXPECT_PRED2(contains, result.out, "--force");
  const std::string told = std::regex_replace(result.out, std::regex("progress: size .*\n"), "");
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << result.out;
  EXPECT_EQ(folder.file_count(), 0);
}

INSTANTIATE_TEST_SUITE_P(Command, TooMuch,
                         testing::Values(std::pair("--size 1e-3", "million elements"),
                                         std::pair("--size-on Face1=1e-6", "million elements"),
                                         std::pair("--size-on Face1=1e-3 --growth 1e-9", "million elements"),
                                         std::pair("--size-on Vertex1=1e-3 --growth 1e-9",
                                                   "million elements"),
                                         std::pair("--curvature 1e9 --size-min 1e-9", "million elements"),
                                         std::pair("--size-on Edge1=1e-6", "Edge1 of"),
                                         // Below the budget of elements and segments, not that of voxels.
                                         std::pair("--size 1.6 --size-on Face1=6.2e-3", "voxels"),
                                         std::pair("--size-on Edge1=6e-6", "voxels")));

TEST(Command, RefusesElementsThatMemoryHasNoRoomFor) {
  const TemporaryFolder folder;
  const auto run = [&](const char* size) {
    return test::run(
        fmt::format("cd {} && ulimit -v 1500000 && {} mesh {} -o out.msh --quiet --order 2 --size {} 2>&1",
                    folder.path().string(), program, box, size));
  };
  const auto large = run("0.015");
  EXPECT_EQ(large.exit_code, 2) << large.out;
  EXPECT_PRED2(contains, large.out, "GB of memory, and 1.");
  EXPECT_EQ(run("1").exit_code, 0);
}

/// One number of one edge's curve, in a file whose surfaces are as they were.
TEST(Command, RefusesAnEdgeFarOutOfItsModel) {
  const TemporaryFolder folder;
  std::string text = test::file_text(QUADRILLE_SOURCE_DIR "/examples/models/wing.brep");
  const std::string pole = "14.807028263431036 90.924340106511835 0  48 180 0";
  const std::size_t place = text.find(pole, text.find("\nCurves 6"));
  ASSERT_NE(place, std::string::npos);
  text.replace(place, 18, "14807028.263431036");
  test::write_text(folder / "wild.brep", text);
  for (const char* size : {"--size 5", "--size 0.5"}) {
    const auto result =
        test::run(fmt::format("cd {} && ulimit -t 5 && {} mesh wild.brep -o out.msh {} --quiet 2>&1",
                              folder.path().string(), program, size));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_PRED2(contains, result.out,
                 "Edge2 runs 7.403e+06 mm away from the model's surfaces, which span 198.5 mm");
  }
  EXPECT_EQ(folder.file_count(), 1);
  const auto info = stdout_of(folder, "info wild.brep");
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_PRED2(contains, info.out, "problem      Edge2 runs 7.403e+06 mm away");
}

TEST(Command, RefusesAnEnormousEdge) {
  const TemporaryFolder folder;
  // The box's first edge, of 10 mm, as the range of its curve's parameter has it.
  std::string text = test::file_text(box);
  const std::size_t range = text.find("\n1  1 0 0 10\n");
  ASSERT_NE(range, std::string::npos);
  text.replace(range, 13, "\n1  1 0 0 1e8\n");
  test::write_text(folder / "long.brep", text);
  const auto result = stderr_of(folder, "mesh long.brep -o out.msh --size 1 --quiet");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_PRED2(contains, result.out, "million");
}

TEST(Command, AsksForOptionsOnce) {
  const TemporaryFolder folder;
  for (const char* option : {"--size", "--growth", "--report", "--strategy"}) {
    const auto result = test::run(fmt::format("cd {} && {} mesh {} -o out.msh {} 2 {} 3 2>&1",
                                              folder.path().string(), program, box, option, option));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, fmt::format("quadrille: {} is given more than once: give it once (see quadrille "
                                      "--help)\n",
                                      option));
  }
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Command, TakesTheThreadsThatThereAre) {
  const TemporaryFolder folder;
  EXPECT_EQ(stderr_of(folder, "mesh " + box + " -o a.msh --size 4 --quiet --threads 4096").out, "");
  // A user who may have no more processes; root may have any number, and becomes nobody, who here may still
  // read what only root may, such as a checkout in root's own folder.
  std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
  const std::string nobody = ::geteuid() == 0
                                 ? "setpriv --reuid=65534 --clear-groups --inh-caps=-all,+dac_override "
                                   "--ambient-caps=-all,+dac_override "
                                 : "";
  const auto result =
      test::run(fmt::format("cd {} && {} prlimit --nproc=1 {} mesh {} -o b.msh --size 4 --quiet 2>&1",
                            folder.path().string(), nobody, program, box));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(test::file_text(folder / "a.msh"), test::file_text(folder / "b.msh"));
}

/// The count by face, at a size that is given or found, with all other settings.
TEST(Command, CountsQuadsOnly) {
  const TemporaryFolder folder;
  const std::string options = "sizes " + box + " --size-on Face1=0.5 --quiet --report r.json --count-only ";
  const auto report_of = [&](const std::string& more) {
    EXPECT_EQ(stdout_of(folder, options + more).exit_code, 0);
    return nlohmann::json::parse(test::file_text(folder / "r.json"));
  };
  const auto given = report_of("--size 2");
  EXPECT_EQ(given["size"], 2);
  double sum = 0;
  for (const auto& [face, quads] : given["quads_by_face"].items()) sum += quads.get<double>();
  EXPECT_NEAR(sum, given["quads"].get<double>(), 3);
  EXPECT_EQ(given["quads_by_face"].size(), 6U);
  const double wanted = 1.5 * given["quads"].get<double>();
  const auto found = report_of(fmt::format("--wanted-quads {:.0f}", wanted));
  EXPECT_LT(found["size"], 2);
  EXPECT_NEAR(found["quads"].get<double>() / wanted, 1, 0.15);
}

/// What sizes tells is what mesh makes: the count, and .vtu files that other readers take.
TEST(Command, ShowsSizes) {
  const TemporaryFolder folder;
  const std::string options = box + " --size 2 --size-on Face1=0.5 --quiet ";
  const auto shown = stdout_of(folder, "sizes " + options + "-o s.VTU -o s.JSON --report r.json");
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.out, "");
  const auto report = nlohmann::json::parse(test::file_text(folder / "r.json"));
  const auto all = nlohmann::json::parse(test::file_text(folder / "s.JSON"));
  EXPECT_EQ(all["quads"], report["quads"]);
  const auto text = [&](const char* name) { return all[name].get<std::string>(); };
  // Four letters of base64 are three bytes: points have three numbers of four bytes, sizes one.
  EXPECT_NEAR(static_cast<double>(text("points").size()),
              3.0 * static_cast<double>(text("point_sizes").size()), 8);
  EXPECT_EQ(text("point_sizes").size(), text("point_sources").size());
  EXPECT_EQ(
      text("points").find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/="),
      std::string::npos);
  EXPECT_EQ(all["sources"].back()["name"], "size-on");
  EXPECT_NEAR(all["sources"].back()["size_min"].get<double>(), 0.5, 1e-3);
  ASSERT_EQ(stdout_of(folder, "mesh " + options + "-o m.msh --report m.json").exit_code, 0);
  const double made = nlohmann::json::parse(test::file_text(folder / "m.json"))["counts"]["quads"];
  EXPECT_LT(std::abs(std::log(report["quads"].get<double>() / made)), std::log(1.5));
  EXPECT_EQ(stdout_of(folder, "quality s.VTU").exit_code, 0);
}

TEST(Command, MeshesWithTheOrderOfTheElement) {
  const TemporaryFolder folder;
  for (const std::string type : {"CPS4", "CPE8R", "CAX8", "M3D4R"}) {
    const std::string command = fmt::format("mesh {} --faces Face1 -o a.inp --quiet --element {}", box, type);
    EXPECT_EQ(stderr_of(folder, command).out, "");
    EXPECT_PRED2(contains, test::file_text(folder / "a.inp"), fmt::format("TYPE={},", type));
  }
  const auto refused = [&](const std::string& options, const std::string& sentence) {
    const auto result = stderr_of(folder, "mesh " + box + " -o b.inp --quiet " + options);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_PRED2(contains, result.out, sentence);
    EXPECT_FALSE(std::filesystem::exists(folder / "b.inp"));
  };
  refused("--element CPS8 --order 1", "--element CPS8 needs order 2, not 1");
  refused("--element CPS8", "b.inp: --element CPS8 needs a mesh in one plane, and Face");
}

TEST(Command, MeshesTheBox) {
  const TemporaryFolder folder;
  const auto result = stdout_of(
      folder, "mesh " + box +
                  " -o a.msh -o a.inp --order 1 --size 1 --report r.json --size-on Face1=0.7,Edge2=0.7"
                  " --threads 1 --write-size-field s.vdb");
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_PRED2(contains, result.out, "scaled Jacobian");
  const ShellMesh mesh = read_mesh(folder / "a.msh");
  EXPECT_EQ(mesh.corners.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 0u);
  const auto report = nlohmann::json::parse(test::file_text(folder / "r.json"));
  EXPECT_EQ(report["counts"]["quads"], mesh.quads.size());
  EXPECT_EQ(report["counts"]["nodes"], mesh.points.size());
  EXPECT_EQ(report["counts"]["triangles"], 0);
  EXPECT_EQ(report["faces"].size(), 6u);
  EXPECT_EQ(report["faces"][0]["name"], "Face1");
  EXPECT_TRUE(report["warnings"].empty());
  EXPECT_EQ(report["faces"][0]["status"], "meshed");
  EXPECT_EQ(report["versions"]["quadrille"], QUADRILLE_VERSION);
  EXPECT_GT(report["peak_bytes"], 1000000);
  EXPECT_GT(report["quality"]["q_mean"], 0.8);
  EXPECT_EQ(report["criteria"]["quads"], mesh.quads.size());
  // Grids need no pairing.
  for (const char* stage : {"read", "size", "sample", "triangulate", "write"})
    EXPECT_GT(report["seconds"][stage], 0) << stage;
  EXPECT_EQ(report["seconds"]["recombine"], 0);
  for (const auto& face : report["faces"]) EXPECT_EQ(face["note"], "grid");
  EXPECT_TRUE(std::filesystem::exists(folder / "s.vdb"));
  const auto measured = stdout_of(folder, "quality a.inp");
  EXPECT_EQ(measured.exit_code, 0);
  EXPECT_PRED2(contains, measured.out, fmt::format("quads              {}\n", mesh.quads.size()));
}

/// The mesh is written all the same.
TEST(Command, MeshWithLimitsFailsWhereQuadsDo) {
  const TemporaryFolder folder;
  test::write_text(folder / "tight.json", R"({"aspect": 1.0001})");
  const std::string line = "mesh " + bracket + " -o a.msh --size 20 --quiet --limits";
  const auto tight = stderr_of(folder, line + " tight.json");
  EXPECT_EQ(tight.exit_code, 1);
  EXPECT_PRED2(contains, tight.out, "quads are outside the limits\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "a.msh"));
  test::write_text(folder / "wide.json",
                   R"({"aspect": 1000, "warp": 180, "skew": 90, "angle_min": 0, "angle_max": 360,)"
                   R"( "jacobian_ratio": -10, "taper": 10})");
  EXPECT_EQ(stderr_of(folder, line + " wide.json").exit_code, 0);
  EXPECT_EQ(stderr_of(folder, line + " none.json").exit_code, 1);
}

TEST(Command, QualityWithLimitsFailsWhereQuadsDo) {
  const TemporaryFolder folder;
  ShellMesh mesh;  // a square beside a rectangle of 1 to 6
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {7, 0, 0}, {7, 1, 0}};
  mesh.quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  mesh.quad_faces = {1, 2};
  write_mesh(mesh, folder / "slender.msh");
  test::write_text(folder / "wide.json", R"({"aspect": 6.5})");
  const auto plain = stdout_of(folder, "quality slender.msh");
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_PRED2(contains, plain.out, "Face2             1        1\n");
  EXPECT_PRED2(contains, plain.out, "quad 2 on Face2 at (4, 0.5, 0): aspect 6\n");
  const auto usual = stderr_of(folder, "quality slender.msh --limits");
  EXPECT_EQ(usual.exit_code, 1);
  EXPECT_EQ(usual.out, "quadrille: slender.msh: 1 of 2 quads are outside the limits\n");
  EXPECT_EQ(stdout_of(folder, "quality slender.msh --limits wide.json").exit_code, 0);
}

/// Started by name from PATH, in a folder that holds a thing of that name and, there and around, files named
/// as our modules.
TEST(Command, OpensNoModuleOfTheCurrentFolder) {
  const TemporaryFolder folder;
  const std::string by_name = fmt::format("PATH={}:$PATH timeout 300 quadrille", QUADRILLE_BINARY_DIR);
  for (const char* thing : {"echo planted >quadrille", "mkdir quadrille", "cp /bin/true quadrille"}) {
    const auto result = test::run(fmt::format(
        "cd {} && mkdir -p a/b lib && cd a/b && {} && for place in . .. ../.. ../../lib quadrille; do "
        "[ ! -d $place ] || for module in step vdb med; do echo planted >$place/libquadrille_$module.so; "
        "done; "
        "done; {} mesh {} -o a.med --size 20 --write-size-field s.vdb --quiet 2>&1; rm -r ../../*",
        folder.path().string(), thing, by_name, bracket));
    EXPECT_EQ(result.out, "") << thing;
  }
}

/// libmed prints where it fails in lines of its own.
TEST(Command, SaysOneSentenceWhereLibmedHasNoMemory) {
  const TemporaryFolder folder;
  int refused = 0;
  for (int kilobytes = 80000; kilobytes <= 140000; kilobytes += 4000) {
    const auto result =
        test::run(fmt::format("cd {} && ulimit -v {} && {}/quadrille mesh {} -o a.med --size 1 --quiet 2>&1",
                              folder.path().string(), kilobytes, QUADRILLE_BINARY_DIR, bracket));
    refused += result.exit_code != 0;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), result.exit_code == 0 ? 0 : 1)
        << kilobytes << ": " << result.out;
  }
  EXPECT_GT(refused, 0);
}

/// Started ahead of its work, which is the first line of its input.
TEST(Command, StandsBy) {
  const TemporaryFolder folder;
  const auto given = [&](const std::string& line) {
    return test::run(fmt::format("cd {} && printf '{}' | timeout 300 {} standby 2>&1", folder.path().string(),
                                 line, program));
  };
  const auto meshed = given(fmt::format(R"(["mesh", "{}", "-o", "a.med", "--size", "3", "--quiet"]\n)", box));
  EXPECT_EQ(meshed.exit_code, 0) << meshed.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.med"));
  const auto mistaken = given(R"(["mesh", "a b.brep", "-o", "b.med", "--size", "3"]\n)");
  EXPECT_EQ(mistaken.exit_code, 1);
  EXPECT_TRUE(contains(mistaken.out, "a b.brep: ")) << mistaken.out;
  for (const std::string nonsense : {"mesh\\n", "\\n", R"({"mesh": 1}\n)", R"([1]\n)"}) {
    const auto refused = given(nonsense);
    EXPECT_EQ(refused.exit_code, 2) << nonsense;
    EXPECT_EQ(std::count(refused.out.begin(), refused.out.end(), '\n'), 1) << refused.out;
  }
  const auto dismissed = given("");
  EXPECT_EQ(dismissed.exit_code, 0);
  EXPECT_EQ(dismissed.out, "");
}

/// Nor of folders above its own, such as the `lib` beside a `bin`.
TEST(Command, OpensNoModuleOfFoldersAboveItsOwn) {
  const TemporaryFolder folder;
  const auto result = test::run(fmt::format(
      "cd {} && mkdir bin && cp {}/quadrille bin && for place in . lib lib/quadrille lib/$(uname "
      "-m)-linux-gnu/quadrille; do "
      "mkdir -p $place && echo planted >$place/libquadrille_step.so; done; bin/quadrille info {} 2>&1",
      folder.path().string(), QUADRILLE_BINARY_DIR, bracket));
  EXPECT_EQ(result.out.find("cannot be loaded"), std::string::npos) << result.out;
}

/// A model of trouble as a file.
std::string trouble_file(const TemporaryFolder& folder, const std::string& name) {
  for (const TroubleModel& trouble : trouble_models()) {
    if (trouble.name == name) BRepTools::Write(trouble.make(), (folder / (name + ".brep")).c_str());
  }
  return name + ".brep";
}

/// A line without a direction, one end of which is two billion millimeters away.
TEST(Command, RefusesALineWithoutDirectionAtOnce) {
  const TemporaryFolder folder;
  const std::string file = trouble_file(folder, "looped_edge");
  const auto result = test::run(fmt::format(
      "cd {0} && sed -i 's/^1 20 0 0 0 1 0 *$/1 20 0 0 0 0 0 /; s/^20 20 0$/20 20 -2147483648/' "
      "{1} && grep -q '^20 20 -2' {1} && "
      "timeout 300 {2} mesh {1} -o a.msh --elements-per-diagonal 15 --time-limit 200 --quiet 2>&1",
      folder.path().string(), file, program));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_EQ(result.out.find("time limit"), std::string::npos) << result.out;
}

TEST(Command, TellsWhatLeavesTheGeometry) {
  const TemporaryFolder folder;
  const std::string ellipsoid = trouble_file(folder, "ellipsoid");
  const auto result = test::run(fmt::format(
      "cd {} && {} mesh {} -o a.msh --elements-per-diagonal 4 --curvature 0 --order 2 --report r.json 2>&1",
      folder.path().string(), program, ellipsoid));
  ASSERT_EQ(result.exit_code, 0) << result.out;
  EXPECT_PRED2(contains, result.out,
               "nodes lie off the geometry, because elements on it would be invalid, the farthest on Face1");
  EXPECT_PRED2(contains, result.out, "inverted           0");
  const auto report = nlohmann::json::parse(test::file_text(folder / "r.json"));
  EXPECT_GT(report["quality"]["jacobian_min"], 0);
  EXPECT_EQ(report["quality"]["inverted"], 0);
  const auto& off = report["off_geometry"];
  ASSERT_GT(off.size(), 0u);
  EXPECT_EQ(report["faces"][0]["off_geometry"]["nodes"], off.size());
  double largest = 0;
  const ShellMesh mesh = read_mesh(folder / "a.msh");
  for (const auto& entry : off) {
    largest = std::max(largest, entry["distance"].get<double>());
    EXPECT_TRUE(std::any_of(mesh.midsides.begin(), mesh.midsides.end(), [&](const auto& midsides) {
      return std::find(midsides.begin(), midsides.end(), entry["node"].get<int>() - 1) != midsides.end();
    }));
  }
  EXPECT_EQ(report["faces"][0]["off_geometry"]["largest"], largest);
}

TEST(Command, SewsFacesThatTouch) {
  const TemporaryFolder folder;
  const std::string faces = trouble_file(folder, "touching_faces");
  ASSERT_EQ(stdout_of(folder, "mesh " + faces + " -o apart.msh --size 2").exit_code, 0);
  ASSERT_EQ(stdout_of(folder, "mesh " + faces + " -o sewn.msh --size 2 --sew 0.01").exit_code, 0);
  // The ten segments of the common side have eleven nodes, once.
  EXPECT_EQ(read_mesh(folder / "sewn.msh").points.size() + 11, read_mesh(folder / "apart.msh").points.size());
}

/// Parts that touch are told with what joins them; joined by it, nothing is told. Sewing refuses to lay quads
/// on quads.
TEST(Command, ImprintsPartsThatTouch) {
  const TemporaryFolder folder;
  BRepTools::Write(rod_in_sleeve(), (folder / "rod.brep").c_str());
  const std::string mesh_it = "mesh rod.brep -o a.msh --size 1 --report r.json ";
  const auto report = [&] { return nlohmann::json::parse(test::file_text(folder / "r.json")); };

  EXPECT_PRED2(contains, stdout_of(folder, "info rod.brep").out, "--imprint joins parts that touch or cross");
  EXPECT_PRED2(contains, stderr_of(folder, mesh_it).out, "--imprint joins parts that touch");
  EXPECT_GT(report()["coincident"]["nodes"], 0);
  EXPECT_EQ(report()["coincident"]["remedy"], "--imprint");
  EXPECT_FALSE(report().contains("imprinted"));

  EXPECT_FALSE(contains(stdout_of(folder, "info rod.brep --imprint").out, "joins parts that touch"));
  EXPECT_EQ(stdout_of(folder, mesh_it + "--imprint").exit_code, 0);
  EXPECT_EQ(report()["coincident"]["nodes"], 0);
  EXPECT_EQ(report()["coincident"]["remedy"], nullptr);
  const nlohmann::json imprinted = report()["imprinted"];
  const auto count_of = [&](std::string_view kind) {
    int count = 0;
    for (const auto& [name, pieces] : imprinted.items()) count += name.starts_with(kind);
    return count;
  };
  EXPECT_EQ(count_of("Face"), 7);
  EXPECT_GT(count_of("Edge"), 0);
  EXPECT_GT(count_of("Vertex"), 0);
  EXPECT_EQ(imprinted["Face2"], nlohmann::json({"Face2"}));
}

TEST(Command, SewingRefusesFacesOnFaces) {
  const TemporaryFolder folder;
  BRepTools::Write(rod_in_sleeve(10), (folder / "rod.brep").c_str());
  const auto sewn = stderr_of(folder, "mesh rod.brep -o a.msh --size 1 --sew 0.01 --quiet");
  EXPECT_EQ(sewn.exit_code, 1);
  EXPECT_PRED2(contains, sewn.out, "--imprint");
  EXPECT_EQ(stdout_of(folder, "mesh rod.brep -o a.msh --size 1 --sew 0.01 --imprint").exit_code, 0);
}

TEST(Command, MergesTinyFaces) {
  const TemporaryFolder folder;
  const std::string sliver = trouble_file(folder, "sliver");
  const auto quads_on_sliver = [&](const std::string& arguments) {
    EXPECT_EQ(stdout_of(folder, "mesh " + sliver + " -o a.msh --size 5 " + arguments).exit_code, 0);
    const ShellMesh mesh = read_mesh(folder / "a.msh");
    return std::count(mesh.quad_faces.begin(), mesh.quad_faces.end(), 2);
  };
  EXPECT_EQ(quads_on_sliver(""), 0);  // far below the least size
  EXPECT_GT(quads_on_sliver("--keep-features"), 0);
  EXPECT_EQ(quads_on_sliver("--keep-features --merge-tiny 0.1"), 0);
}

TEST(Command, EndsAtTheTimeLimit) {
  const TemporaryFolder folder;
  const auto result = stderr_of(folder, "mesh " + bracket + " -o a.msh --size 0.05 --time-limit 0.5 --quiet");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out, "time limit");
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(Command, GivesSolversSecondOrder) {
  const TemporaryFolder folder;
  const auto order_in = [&](const std::string& arguments) {
    EXPECT_EQ(stderr_of(folder, "mesh " + box + " --size 4 --quiet --report r.json " + arguments).out, "");
    return nlohmann::json::parse(test::file_text(folder / "r.json"))["order"].get<int>();
  };
  for (const char* solver : {"inp", "unv", "bdf", "med"}) {
    EXPECT_EQ(order_in(fmt::format("-o a.{}", solver)), 2) << solver;
    EXPECT_EQ(order_in(fmt::format("-o a.msh -o a.{}", solver)), 2) << solver;
    EXPECT_EQ(order_in(fmt::format("-o a.{} --order 1", solver)), 1) << solver;
  }
  for (const char* other : {"msh", "vtu", "vtk", "xdmf", "su2"})
    EXPECT_EQ(order_in(fmt::format("-o a.{}", other)), 1) << other;
}

/// A named pipe that nobody writes to: reading it never ends.
TEST(Command, GivesUpReadingAfterItsLimit) {
  for (const char* subcommand : {"mesh pipe.brep -o a.msh", "info pipe.brep"}) {
    SCOPED_TRACE(subcommand);
    const TemporaryFolder folder;
    const auto read = [&](const std::string& limit) {
      return test::
          run(fmt::format(
                  "cd {} && rm -f pipe.brep && mkfifo pipe.brep && (sleep 500 > pipe.brep & echo $! > pid); "
                  "timeout 300 {} {} {} 2>&1; kill $(cat pid)",
                  folder.path().string(), program, subcommand, limit))
              .out;
    };
    EXPECT_EQ(read("--read-time-limit 0.3"),
              "quadrille: pipe.brep: reading it takes longer than 0.3 s: it may be damaged; "
              "--read-time-limit allows more\n");
    EXPECT_EQ(read("--time-limit 0.3"),
              "quadrille: the time limit of 0.3 s is reached, and nothing was written\n");
  }
}

/// setitimer() counts microseconds, and takes none for "never".
TEST(Command, TheShortestTimeLimitHolds) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.brep").c_str(), 0600), 0);
  const auto result =
      test::run(fmt::format("cd {} && timeout 20 {} mesh pipe.brep -o a.msh --time-limit 1e-7 2>&1",
                            folder.path().string(), program));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "quadrille: the time limit of 1e-07 s is reached, and nothing was written\n");
}

/// All inputs count, not only the model: nobody writes to the pipe of limits.
TEST(Command, TheTimeLimitHoldsForEveryInput) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "limits.json").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder / "points.csv").c_str(), 0600), 0);
  for (const char* option : {"--limits limits.json", "--size-points points.csv"}) {
    const auto result =
        test::run(fmt::format("cd {} && timeout 20 {} mesh {} -o a.msh {} --time-limit 0.3 2>&1",
                              folder.path().string(), program, box, option));
    EXPECT_EQ(result.exit_code, 1) << option;
    EXPECT_EQ(result.out, "quadrille: the time limit of 0.3 s is reached, and nothing was written\n")
        << option;
  }
}

TEST(Command, LimitsMayComeThroughAPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "limits.json").c_str(), 0600), 0);
  const auto result =
      test::run(fmt::format("cd {} && {{ echo '{{\"aspect\": 1.0001}}' > limits.json & }}; timeout 20 {} "
                            "mesh {} -o a.msh --size 2.9 --quiet "
                            "--limits limits.json 2>&1",
                            folder.path().string(), program, box));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out, "quads are outside the limits");
}

struct TwoRoles {
  std::string command, input, output;
};

/// Through a symbolic and a hard link as well.
TEST(Command, NoOutputReplacesAnInput) {
  const TemporaryFolder folder;
  for (const auto& [command, input, output] :
       {TwoRoles{"mesh " + box + " -o a.msh --limits @", "limits.json", "--report"},
        TwoRoles{"mesh " + box + " --limits @", "limits.msh", "-o"},
        TwoRoles{"mesh " + box + " -o a.msh --size-points @", "points.csv", "--report"},
        TwoRoles{"remesh none.stl -o a.msh --size 1 --limits @", "limits.json", "--report"},
        TwoRoles{"adapt none.inp none.frd -o a.vdb --before @", "before.json", "--report"},
        TwoRoles{"sizes " + box + " -o a.vtu --size-points @", "points.csv", "--report"}}) {
    const std::string text = "{\"aspect\": 5}\n";
    test::write_text(folder / input, text);
    for (const char* none : {"none.stl", "none.inp", "none.frd"}) test::write_text(folder / none, "");
    const std::string ending = std::filesystem::path(input).extension().string(), soft = "soft" + ending,
                      hard = "hard" + ending;
    std::filesystem::remove(folder / soft);
    std::filesystem::remove(folder / hard);
    std::filesystem::create_symlink(input, folder / soft);
    std::filesystem::create_hard_link(folder / input, folder / hard);
    for (const std::string& name : {input, soft, hard}) {
      std::string line = command;
      line.replace(line.find('@'), 1, input);
      const auto result = stderr_of(folder, fmt::format("{} {} {}", line, output, name));
      EXPECT_EQ(result.exit_code, 2) << line << ' ' << name;
      EXPECT_PRED2(contains, result.out, "is the same file as");
      EXPECT_EQ(test::file_text(folder / input), text);
    }
  }
}

/// Whoever could act as the owner of the older file's program must not as that of the mesh.
TEST(Command, AnOverwrittenFileKeepsNoRightsOfItsOwner) {
  const TemporaryFolder folder;
  test::write_text(folder / "a.msh", "");
  ASSERT_EQ(::chmod((folder / "a.msh").c_str(), 06751), 0);
  EXPECT_EQ(stderr_of(folder, "mesh " + box + " -o a.msh --quiet").exit_code, 0);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.msh").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0751U);
}

/// Escape sequences, as bytes and as UTF-8, a mark that turns the direction of writing, a byte that is no
/// UTF-8.
TEST(Command, TerminalsGetNothingToObey) {
  const std::string hostile = "a\x1b]0;x\x07\xc2\x9b\xe2\x80\xae\xff",
                    shown = "a\\x1b]0;x\\x07\\u009b\\u202e\\xff";
  const TemporaryFolder folder;
  const auto told = [&](const std::string& arguments) {
    const std::string out =
        test::run(fmt::format("cd {} && timeout 60 {} {} 2>&1", folder.path().string(), program, arguments))
            .out;
    for (const char* part : {"\x1b", "\x07", "\xc2\x9b", "\xe2\x80\xae", "\xff"})
      EXPECT_FALSE(contains(out, part)) << arguments;
    return out;
  };
  test::write_text(folder / "limits.json", "{\"a\xe2\x80\xae\": 1}");
  EXPECT_PRED2(contains, told("mesh " + box + " -o a.msh --limits limits.json"), "a\\u202e");
  for (const std::string& arguments :
       {"info '" + hostile + ".step'", "mesh " + box + " -o '" + hostile + "'",
        "info in.step '" + hostile + "'", "mesh " + box + " -o a.msh --size '" + hostile + "'",
        "mesh " + box + " -o a.msh --faces '" + hostile + "'"})
    EXPECT_PRED2(contains, told(arguments), shown);
  // Into files, group names go without what was escaped.
  test::write_text(folder / "a.msh",
                   "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"" + hostile +
                       "\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                       "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n");
  for (const char* ending : {"msh", "inp", "unv", "bdf", "vtk", "xdmf", "su2"}) {
    told(fmt::format("recombine a.msh -o out.{} --report r.json", ending));
    const std::string text = test::file_text(folder / fmt::format("out.{}", ending));
    EXPECT_FALSE(text.empty());
    for (const char* part : {"\x1b", "\x07", "\xc2\x9b", "\xe2\x80\xae", "\xff"})
      EXPECT_FALSE(contains(text, part)) << ending;
  }
}

/// A device and a file of four terabytes, as each kind of input.
TEST(Command, WhatHasNoEndIsRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"large.brep", "large.json", "large.csv", "large.msh"}) {
    test::write_text(folder / name, "");
    std::filesystem::resize_file(folder / name, std::uintmax_t{1} << 42);
    std::filesystem::create_symlink("/dev/zero", folder / ("zero" + std::string(name).substr(5)));
  }
  const int before = folder.file_count();
  for (const std::string kind : {"large", "zero"}) {
    for (const std::string& arguments :
         {"mesh " + kind + ".brep -o a.msh", "info " + kind + ".brep", "quality " + kind + ".msh",
          "mesh " + box + " -o a.msh --limits " + kind + ".json",
          "mesh " + box + " -o a.msh --size-points " + kind + ".csv"}) {
      const auto result = test::run(
          fmt::format("cd {} && ulimit -t 20 && {} {} 2>&1", folder.path().string(), program, arguments));
      EXPECT_EQ(result.exit_code, 1) << arguments;
      EXPECT_PRED2(contains, result.out, "cannot be read: it ") << arguments;
    }
  }
  EXPECT_EQ(folder.file_count(), before);
}

TEST(Command, NamesThePictureThatCannotBeDrawn) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const TemporaryFolder folder;
  for (const int megabytes : {300, 500, 700}) {
    const auto result =
        test::run(fmt::format("cd {} && ulimit -v {}000 && {} mesh {} -o a.msh --picture a.png --quiet "
                              "--threads 1 2>&1",
                              folder.path().string(), megabytes, program, box));
    EXPECT_EQ(result.exit_code, 1) << megabytes;
    EXPECT_EQ(result.out.rfind("quadrille: a.png: ", 0), 0u) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    EXPECT_EQ(folder.file_count(), 1) << "the mesh itself is there";
  }
#endif
}

/// OpenVDB ends the program where it cannot make its threads.
TEST(Command, DoesNotBlameTheModelWhereOpenVdbCannotRun) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const TemporaryFolder folder;
  int refused = 0;
  for (int megabytes = 90; megabytes <= 240; megabytes += 15) {
    const auto result = test::run(fmt::format(
        "cd {} && ulimit -v {}000 && {} mesh {} -o a.msh --size 20 --write-size-field a.vdb --quiet "
        "--threads 1 2>&1",
        folder.path().string(), megabytes, program, box));
    if (result.exit_code == 0) continue;
    ++refused;
    EXPECT_EQ(result.exit_code, 1) << megabytes << ": " << result.out;
    EXPECT_EQ(result.out.find("it may be damaged"), std::string::npos) << megabytes << ": " << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  }
  EXPECT_GT(refused, 0);
#endif
}

TEST(Command, SuggestsSizesThatGiveWhatTheyPromise) {
  for (const std::string& model : {box, bracket}) {
    const TemporaryFolder folder;
    const std::string info = stdout_of(folder, "info " + model).out;
    int lines = 0;
    std::istringstream stream(info);
    for (std::string line; std::getline(stream, line);) {
      double size = 0, quads = 0;
      if (std::sscanf(line.c_str(), "size --size %lf for about %lf quads", &size, &quads) != 2) continue;
      ++lines;
      ASSERT_EQ(
          stderr_of(folder, fmt::format("mesh {} -o a.vtk --size {} --quiet --report r.json", model, size))
              .exit_code,
          0);
      const double made = nlohmann::json::parse(test::file_text(folder / "r.json"))["counts"]["quads"];
      EXPECT_LT(made / quads, 1.5) << line;
      EXPECT_GT(made / quads, 1 / 1.5) << line;
    }
    EXPECT_EQ(lines, 3) << info;
  }
}

TEST(Command, QuietSaysNothing) {
  const TemporaryFolder folder;
  const auto result = test::run(fmt::format("cd {} && {} mesh {} -o a.msh --size 2 --quiet 2>&1",
                                            folder.path().string(), program, box));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
}

/// As the help shows them ("..."): several values after one option, wherever the input file stands.
TEST(Command, TakesListsWithSpaces) {
  const std::pair<const char*, const char*> lists[] = {
      {"--segments Edge1=20 Edge5=24", "--segments Edge1=20 --segments Edge5=24"},
      {"--segments=Edge1=20 Edge5=24", "--segments Edge1=20 --segments Edge5=24"},
      {"--bias Edge1=1.2 Edge5=0.9", "--bias Edge1=1.2 --bias Edge5=0.9"},
      {"--bias-both Edge1=1.2 Edge5=0.9", "--bias-both Edge1=1.2 --bias-both Edge5=0.9"},
      {"--size-on Face1=1 Edge5=0.7,Vertex2=0.5 Vertex3=1",
       "--size-on Face1=1,Edge5=0.7,Vertex2=0.5,Vertex3=1"},
      {"--size-in box:0,0,0,5,5,5=1 sphere:30,20,10,4=0.8",
       "--size-in box:0,0,0,5,5,5=1 --size-in sphere:30,20,10,4=0.8"},
      {"--faces Face1 Face2,Face3 Face4", "--faces Face1,Face2,Face3,Face4"},
      {"--groups faces edges", "--groups faces,edges"}};
  for (const auto& [spaces, plain] : lists) {
    SCOPED_TRACE(spaces);
    const TemporaryFolder folder;
    const auto expect_done = [&](const std::string& arguments) {
      const auto result = stderr_of(folder, "mesh --quiet " + arguments);
      EXPECT_EQ(result.exit_code, 0) << result.out;
    };
    expect_done(fmt::format("{} {} --size 2 -o a.msh", spaces, box));
    expect_done(fmt::format("{} --size 2 {} -o b.msh", box, spaces));
    expect_done(fmt::format("{} --size 2 {} -o c.msh", box, plain));
    expect_done(fmt::format("{} --size 2 -o d.msh", box));
    const std::string wanted = test::file_text(folder / "c.msh");
    EXPECT_EQ(test::file_text(folder / "a.msh") == wanted, true);
    EXPECT_EQ(test::file_text(folder / "b.msh") == wanted, true);
    EXPECT_EQ(test::file_text(folder / "d.msh") == wanted, false);
  }
}

TEST(Command, MeshesChosenFacesOnly) {
  const TemporaryFolder folder;
  ASSERT_EQ(stdout_of(folder, "mesh " + box + " -o a.msh --size 2 --faces Face2,Face5 --order 2").exit_code,
            0);
  const ShellMesh mesh = read_mesh(folder / "a.msh");
  EXPECT_EQ(mesh.order, 2);
  EXPECT_TRUE(std::all_of(mesh.quad_faces.begin(), mesh.quad_faces.end(),
                          [](int face) { return face == 2 || face == 5; }));
  EXPECT_NE(std::count(mesh.quad_faces.begin(), mesh.quad_faces.end(), 5), 0);
}

TEST(Command, TellsWhatAModelHolds) {
  const TemporaryFolder folder;
  const auto result = stdout_of(folder, "info " + box);
  EXPECT_EQ(result.exit_code, 0);
  for (const char* line :
       {"solids       1\n", "faces        6\n", "edges        12\n", "vertices     8\n", "37.4166 mm"})
    EXPECT_PRED2(contains, result.out, line);
}

TEST(Command, AnswersHelpAndVersion) {
  const TemporaryFolder folder;
  EXPECT_EQ(stdout_of(folder, "--version").out, "quadrille " QUADRILLE_VERSION "\n");
  EXPECT_EQ(stdout_of(folder, "mesh --help").exit_code, 0);
  EXPECT_PRED2(contains, stdout_of(folder, "mesh --help").out, "--size-on");
  EXPECT_PRED2(contains, stdout_of(folder, "quality --help").out, ".msh, .inp, .stl");
}

/// Runs the command in a small file system of its own, mounted where nobody else sees it, with what it says
/// on stderr and then "exit CODE" and the files that are left. `prepare` is a shell command run before in
/// there. Nothing where this machine lets us mount nothing.
std::string outcome_on_small_disk(const std::string& arguments, const std::string& prepare = "true") {
  const TemporaryFolder folder;
  const std::string unshare = ::geteuid() == 0 ? "unshare -m" : "unshare -rm";
  const std::string mount = fmt::format("mount -t tmpfs -o size=80k none {}", folder.path().string());
  if (test::run(fmt::format("{} sh -c '{}' 2>/dev/null", unshare, mount)).exit_code != 0) return {};
  return test::run(fmt::format("{} sh -c '{} && cd {} && {} && {{ {} {} 2>&1; echo exit $?; ls -A; }}'",
                               unshare, mount, folder.path().string(), prepare, program, arguments))
      .out;
}

class FullDisk : public testing::TestWithParam<const char*> {};

TEST_P(FullDisk, GivesOneSentenceAndNoFile) {
  const std::string out = fmt::format("out.{}", GetParam());
  // Some fifty times what there is room for.
  const std::string outcome =
      outcome_on_small_disk(fmt::format("mesh {} -o {} --size 0.25 --quiet", box, out));
  if (outcome.empty()) GTEST_SKIP() << "NOT TESTED: no file system can be mounted here";
  EXPECT_EQ(outcome, fmt::format("quadrille: {}: cannot be written: No space left on device\nexit 1\n", out));
}

INSTANTIATE_TEST_SUITE_P(Command, FullDisk,
                         testing::Values("msh", "inp", "unv", "bdf", "vtu", "vtk", "med", "xdmf", "su2"));

TEST(Command, ReportsAFullDisk) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full.msh");
  const auto result = stderr_of(folder, "mesh " + box + " -o full.msh --size 2");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out, "No space left on device");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
}

TEST(Command, ReportsADiskTooFullForTheSizeField) {
  const std::string outcome =
      outcome_on_small_disk(fmt::format("mesh {} -o a.msh --size 3 --write-size-field s.vdb --quiet", box),
                            "head -c 78k /dev/zero >filling");
  if (outcome.empty()) GTEST_SKIP() << "NOT TESTED: no file system can be mounted here";
  EXPECT_EQ(outcome, "quadrille: s.vdb: cannot be written: No space left on device\nexit 1\nfilling\n");
}

class FileSizeLimit : public testing::TestWithParam<const char*> {};

TEST_P(FileSizeLimit, GivesOneSentenceAndNoFile) {
  const TemporaryFolder folder;
  const auto result =
      test::run(fmt::format("cd {} && ulimit -f 1 && timeout 300 {} mesh {} {} --size 0.5 --quiet 2>&1",
                            folder.path().string(), program, box, GetParam()));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_PRED2(contains, result.out,
               "cannot be written: it would be larger than this process may write (ulimit -f)\n");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_EQ(folder.file_count(), 0);
}

INSTANTIATE_TEST_SUITE_P(Command, FileSizeLimit,
                         testing::Values("-o a.msh", "-o a.med", "-o a.vtu",
                                         "-o a.msh --write-size-field s.vdb"));

TEST(Command, ReportsTheLimitOfCpuTime) {
  const TemporaryFolder folder;
  const auto result = test::run(
      fmt::format("cd {} && ulimit -S -t 1 && timeout 300 {} mesh {} -o a.msh --elements-per-diagonal 2000 "
                  "--force --quiet 2>&1",
                  folder.path().string(), program, bracket));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "quadrille: the CPU time limit of this process (ulimit -t) is reached\n");
  EXPECT_EQ(folder.file_count(), 0);
}

/// Where /proc is hidden, a file without a name cannot get one: named files stand in.
TEST(Command, WritesWithoutProc) {
  const TemporaryFolder folder;
  const std::string unshare = ::geteuid() == 0 ? "unshare -m" : "unshare -rm";
  const std::string hide = "mount -t tmpfs none /proc";
  if (test::run(fmt::format("{} {} 2>/dev/null", unshare, hide)).exit_code != 0)
    GTEST_SKIP() << "NOT TESTED: no file system can be mounted here";
  test::write_text(folder / "a.msh", "old");
  const auto result =
      test::run(fmt::format("cd {} && {} sh -c '{} && {} mesh {} -o a.msh --size 5 --quiet 2>&1'",
                            folder.path().string(), unshare, hide, program, box));
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_FALSE(read_mesh(folder / "a.msh").quads.empty());
  EXPECT_EQ(folder.file_count(), 1);
}

class OneFileTwice : public testing::TestWithParam<const char*> {};

/// What is written replaces neither what is read nor what was written before, links followed.
TEST_P(OneFileTwice, IsRefused) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(box, folder / "in.brep");
  test::write_text(folder / "tri.msh", "a triangulation");
  std::filesystem::create_symlink("in.brep", folder / "link.msh");
  std::filesystem::create_hard_link(folder / "in.brep", folder / "hard.msh");
  std::filesystem::create_symlink("new.msh", folder / "dangling.msh");
  const int before = folder.file_count();
  const auto result = stderr_of(folder, GetParam());
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_PRED2(contains, result.out, "is the same file as");
  EXPECT_EQ(folder.file_count(), before);
  EXPECT_EQ(test::file_text(folder / "in.brep"), test::file_text(box));
}

INSTANTIATE_TEST_SUITE_P(Command, OneFileTwice,
                         testing::Values("mesh in.brep -o x.msh --report x.msh", "mesh in.brep -o link.msh",
                                         "mesh in.brep -o hard.msh",
                                         "mesh in.brep -o new.msh -o dangling.msh",
                                         "mesh in.brep -o a.msh -o ../$(basename $PWD)/a.msh",
                                         "mesh in.brep -o a.msh --report ./in.brep",
                                         "mesh in.brep -o a.msh --report p.png --picture p.png",
                                         "mesh in.brep -o a.msh --report s.vdb --write-size-field s.vdb",
                                         "mesh in.brep -o a.msh --size-field in.brep",
                                         "mesh in.brep -o a.msh --report tri.msh --size-points tri.msh",
                                         "midsurface in.brep -o ./in.brep", "recombine tri.msh -o tri.msh",
                                         "recombine tri.msh -o a.msh --report a.msh"));

TEST(Command, WritesManyToOneDevice) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/null", folder / "a.msh");
  EXPECT_EQ(stderr_of(folder, "mesh " + box + " -o a.msh --report /dev/null --size 5 --quiet").exit_code, 0);
}

TEST(Command, ReportsAFullStandardOutput) {
  const TemporaryFolder folder;
  const auto result = test::run(fmt::format("{} info {} 2>&1 >/dev/full", program, box));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "quadrille: cannot write to the standard output: No space left on device\n");
}

TEST(Command, ReportsAReadOnlyFolder) {
  const std::string outcome =
      outcome_on_small_disk(fmt::format("mesh {} -o a.msh", box), "mount -o remount,ro .");
  if (outcome.empty()) GTEST_SKIP() << "NOT TESTED: no file system can be mounted here";
  EXPECT_EQ(outcome, "quadrille: a.msh: the folder . is not writable: Read-only file system\nexit 2\n");
}

TEST(Command, ReportsAFolderThatTakesNoFiles) {
  const TemporaryFolder folder;
  const auto result = stderr_of(folder, "mesh " + box + " -o /proc/a.msh --size 3 --quiet");
  EXPECT_EQ(result.exit_code, ::geteuid() == 0 ? 1 : 2);
  EXPECT_PRED2(contains, result.out, "/proc/a.msh: ");
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
}

TEST(Command, ReportsAPipeWhoseReaderHasGone) {
  const TemporaryFolder folder;
  const auto result = test::run(fmt::format(
      "cd {} && mkfifo out.msh && {{ head -c 10 out.msh >/dev/null & timeout 300 {} mesh {} -o out.msh "
      "--size 0.25 --quiet 2>&1; }}",
      folder.path().string(), program, box));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "quadrille: out.msh: cannot be written: Broken pipe\n");
}

TEST(Command, ReportsAClosedPipe) {
  const TemporaryFolder folder;
  const auto result = test::run(fmt::format(
      "cd {} && {{ {{ sleep 0.3; {} info {} 2>err; echo $? >code; }} | true; }}; sleep 0.5; cat err code",
      folder.path().string(), program, box));
  EXPECT_PRED2(contains, result.out, "Broken pipe");
  EXPECT_PRED2(contains, result.out, "\n1\n");
}

/// The command at work in a folder, its stderr in the file "err" there.
class Running {
 public:
  Running(const TemporaryFolder& folder, const std::string& arguments) : id_(::fork()) {
    if (id_ != 0) return;
    if (::chdir(folder.path().c_str()) != 0) ::_exit(126);
    const std::string line = fmt::format("exec {} {} 2>err </dev/null", program, arguments);
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  void send(int signal_number) const { ::kill(id_, signal_number); }
  /// Until the program handles the signal: starting takes long on busy machines and under sanitizers.
  void wait_until_handled(int signal_number) const {
    for (int i = 0; i < 20000; ++i) {
      std::ifstream status(fmt::format("/proc/{}/status", id_));
      for (std::string line; std::getline(status, line);) {
        if (line.rfind("SigCgt:", 0) != 0) continue;
        if (std::stoull(line.substr(7), nullptr, 16) >> (signal_number - 1) & 1) return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  int exit_code() const {
    int status = 0;
    ::waitpid(id_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t id_;
};

class Interrupted : public testing::TestWithParam<std::tuple<int, int>> {};

/// Reading, sizing, the faces: the signal comes at different times. Fine enough to be at work for minutes.
TEST_P(Interrupted, EndsAtOnceWithoutPartialFile) {
  const auto [signal_number, milliseconds] = GetParam();
  const TemporaryFolder folder;
  const Running command(folder, "mesh " + bracket + " -o a.msh --elements-per-diagonal 4000 --force --quiet");
  command.wait_until_handled(signal_number);
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  command.send(signal_number);
  EXPECT_EQ(command.exit_code(), 130);
  EXPECT_EQ(test::file_text(folder / "err"), "quadrille: the work was cancelled\n");
  EXPECT_EQ(folder.file_count(), 1);
}

INSTANTIATE_TEST_SUITE_P(Command, Interrupted,
                         testing::Combine(testing::Values(SIGINT, SIGTERM), testing::Values(100, 600, 1600)));

/// Reading waits for what is written into the pipe: nothing.
TEST(Command, AdaptEndsWithoutPartialFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "m.inp").c_str(), 0600), 0);
  test::write_text(folder / "r.frd", "");
  const Running command(folder, "adapt m.inp r.frd -o s.vdb");
  command.wait_until_handled(SIGTERM);
  command.send(SIGTERM);
  EXPECT_EQ(command.exit_code(), 130);
  EXPECT_EQ(test::file_text(folder / "err"), "quadrille: the work was cancelled\n");
  EXPECT_EQ(folder.file_count(), 3);
}

/// The box with a seventh face beside it that no mesher can fill: its wire crosses itself.
void write_with_folded_face(const std::filesystem::path& path) {
  const BRep_Builder builder;
  TopoDS_Shape solid;
  ASSERT_TRUE(BRepTools::Read(solid, box.c_str(), builder));
  BRepBuilderAPI_MakePolygon wire(gp_Pnt(40, 0, 0), gp_Pnt(50, 10, 0), gp_Pnt(50, 0, 0), gp_Pnt(40, 10, 0),
                                  true);
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  builder.Add(compound, solid);
  builder.Add(compound, BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), wire.Wire()).Face());
  ASSERT_TRUE(BRepTools::Write(compound, path.c_str()));
}

TEST(Command, ListsWhatPartialLeavesOut) {
  const TemporaryFolder folder, models;
  const std::filesystem::path folded = models / "folded.brep";
  write_with_folded_face(folded);
  const std::string faces = "mesh " + folded.string() + " -o a.msh --size 2 --quiet";
  const auto whole = stderr_of(folder, faces);
  EXPECT_EQ(whole.exit_code, 1);
  EXPECT_PRED2(contains, whole.out, "Face7");
  EXPECT_EQ(std::count(whole.out.begin(), whole.out.end(), '\n'), 1) << whole.out;
  EXPECT_EQ(folder.file_count(), 0);
  const auto part = stderr_of(folder, faces + " --partial");
  EXPECT_EQ(part.exit_code, 0);
  EXPECT_EQ(part.out.rfind("quadrille: left out: Face7: ", 0), 0u) << part.out;
  EXPECT_EQ(std::count(part.out.begin(), part.out.end(), '\n'), 1) << part.out;
  const ShellMesh mesh = read_mesh(folder / "a.msh");
  EXPECT_EQ(std::set<int>(mesh.quad_faces.begin(), mesh.quad_faces.end()).size(), 6u);
}

}  // namespace
}  // namespace quadrille
