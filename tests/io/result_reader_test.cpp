/// Results as .frd and .vtu files.

#include "mesher/io/result_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "geometry/base/error.hpp"
#include "tests/support/solved_plates.hpp"

namespace quadrille {
namespace {

/// The same as .vtu.
std::string vtu(const SolverResult& result, const char* name, bool quadratic) {
  std::string points, moved, nodes, offsets, types;
  for (const Vector3& p : result.points) points += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const Vector3& u : result.displacements) moved += fmt::format("{} {} {}\n", u.x(), u.y(), u.z());
  std::size_t end = 0;
  for (const SolverResult::Element& element : result.elements) {
    // VTK has the sides of the top before the upright ones.
    for (std::size_t i = 0; i < element.nodes.size(); ++i)
      nodes += fmt::format("{} ", element.nodes[i < 12 ? i : i < 16 ? i + 4 : i - 4]);
    offsets += fmt::format("{} ", end += element.nodes.size());
    types += quadratic ? "25 " : "12 ";
  }
  return fmt::format(
      "<?xml version='1.0'?><VTKFile type='UnstructuredGrid' version='0.1' byte_order='LittleEndian'>"
      "<UnstructuredGrid><Piece NumberOfPoints='{}' NumberOfCells='{}'>"
      "<PointData><DataArray type='Float64' Name='{}' NumberOfComponents='3' format='ascii'>{}</DataArray>"
      "</PointData><Points><DataArray type='Float64' NumberOfComponents='3' "
      "format='ascii'>{}</DataArray></Points>"
      "<Cells><DataArray type='Int64' Name='connectivity' format='ascii'>{}</DataArray>"
      "<DataArray type='Int64' Name='offsets' format='ascii'>{}</DataArray>"
      "<DataArray type='UInt8' Name='types' format='ascii'>{}</DataArray></Cells></Piece></UnstructuredGrid>"
      "</VTKFile>",
      result.points.size(), result.elements.size(), name, moved, points, nodes, offsets, types);
}

/// Bricks of twenty nodes on those of eight, with the middles of their sides.
SolverResult with_middles(SolverResult result) {
  constexpr int sides[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5},
                                {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
  for (SolverResult::Element& element : result.elements) {
    element.type = SolverResult::Element::twenty_nodes;
    for (const auto& [a, b] : sides) {
      const int one = element.nodes[a], other = element.nodes[b];
      element.nodes.push_back(static_cast<int>(result.points.size()));
      result.points.push_back(0.5 * (result.points[one] + result.points[other]));
      result.displacements.push_back(0.5 * (result.displacements[one] + result.displacements[other]));
    }
  }
  return result;
}

TEST(VtuReader, ReadsWhatTheFrdReaderReads) {
  const ShellMesh mesh = grid(3, flat);
  const auto moved = [](const Vector3& p) { return Vector3(0.02 * p.z() * p.x() * p.y(), 1e-3 * p.x(), 0); };
  const SolverResult eight = read_frd(frd(mesh, moved), "t.frd");
  const auto path = std::filesystem::temp_directory_path() / "quadrille_result_test.VTU";
  for (const bool quadratic : {false, true}) {
    const SolverResult result = quadratic ? with_middles(eight) : eight;
    std::ofstream(path) << vtu(result, quadratic ? "Displacement" : "U", quadratic);
    const auto expected = shell_stresses(mesh, result, 0.3, "t.frd");
    const auto found = shell_stresses(mesh, read_result(path), 0.3, "t.vtu");
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t quad = 0; quad < found.size(); ++quad) {
      for (int k = 0; k < 4; ++k) {
        EXPECT_LT((found[quad][k].membrane - expected[quad][k].membrane).norm(), 1e-12);
        EXPECT_LT((found[quad][k].bending - expected[quad][k].bending).norm(), 1e-12);
        EXPECT_GT(found[quad][k].membrane.norm() + found[quad][k].bending.norm(), 1e-6);
      }
    }
  }
  std::ofstream(path) << vtu(eight, "Temperature", false);
  try {
    read_result(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no displacements"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
  std::filesystem::remove(path);
}

TEST(FrdReader, SaysWhatIsWrong) {
  const ShellMesh mesh = grid(2, flat);
  const std::string good = frd(mesh, [](const Vector3& p) { return p; });
  EXPECT_EQ(read_frd(good, "t.frd").elements.size(), 4u);
  const auto refused = [](const std::string& text, const std::string& part) {
    try {
      read_frd(text, "t.frd");
      ADD_FAILURE() << "no error that says " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("t.frd"), std::string::npos) << error.what();
    }
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, from.size(), to);
  };
  refused("", "no nodes");
  refused("solid nonsense\n", "no nodes");
  refused(good.substr(0, good.find("    3C") - 4), "middle of a block");
  refused(good.substr(0, good.find("    3C") - 20), "t.frd");
  refused(good.substr(0, good.find("  100C")), "no displacements");
  refused(with("DISP", "TEMP"), "no displacements");
  refused(with("1.00000E+01", "        nan"), "not finite");
  refused(with("1.00000E+01", "1.0000xE+01"), "not a number");
  refused(with(" -1         2 ", " -1         1 "), "twice");
  refused(with("\n -2         1", "\n -2        99"), "no node 99");
  std::string binary = good;
  binary[binary.find('\n', binary.find("    2C")) - 1] = '2';
  refused(binary, "binary");
}

}  // namespace
}  // namespace quadrille
