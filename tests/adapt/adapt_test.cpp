/// Errors of stresses by patch recovery, from displacements as CalculiX writes them, and the sizes that
/// follow.

#include "mesher/adapt/adapt.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <string>

#include "geometry/base/error.hpp"
#include "mesher/adapt/error_estimate.hpp"
#include "mesher/adapt/peak_stress.hpp"
#include "mesher/adapt/shell_stress.hpp"
#include "mesher/io/result_reader.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

using Place = std::function<Vector3(double, double)>;

/// n x n quads over the unit square, put into space.
ShellMesh grid(int n, const Place& place) {
  ShellMesh mesh;
  mesh.order = 2;
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) mesh.points.push_back(place(1.0 * column / n, 1.0 * row / n));
  for (int k = 0; k < n * n; ++k) {
    const int a = k / n * (n + 1) + k % n;
    mesh.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
  }
  return mesh;
}

Vector3 flat(double x, double y) {
  return {10 * x, 10 * y, 0};
}

/// The .frd file of a mesh as bricks of eight nodes, 0.2 thick, that move.
std::string frd(const ShellMesh& mesh, const std::function<Vector3(const Vector3&)>& moved) {
  std::string nodes, elements, values;
  int number = 0;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const auto& corners = mesh.quads[quad];
    const Vector3 normal = (mesh.points[corners[2]] - mesh.points[corners[0]])
                               .cross(mesh.points[corners[3]] - mesh.points[corners[1]])
                               .normalized();
    elements += fmt::format(" -1{:10}{:5}{:5}{:5}\n -2", quad + 1, 1, 0, 1);
    for (int k = 0; k < 8; ++k) {
      const Vector3 p = mesh.points[corners[k % 4]] + (k < 4 ? -0.1 : 0.1) * normal, u = moved(p);
      elements += fmt::format("{:10}", ++number);
      nodes += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, p.x(), p.y(), p.z());
      values += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", number, u.x(), u.y(), u.z());
    }
    elements += "\n";
  }
  return fmt::format("    1C\n    2C{:30}{:37}\n{} -3\n    3C{:30}{:37}\n{} -3\n", number, 1, nodes,
                     mesh.quads.size(), 1, elements) +
         fmt::format(
             "  100CL  101 1.000000000{:12}{:22}{:5}{:10}{:2}\n -4  DISP        4    1\n -5  D1          1   "
             " 2    "
             "1    0\n{} -3\n 9999\n",
             number, 0, 1, 1, 1, values);
}

std::vector<std::array<ShellStress, 4>> stresses_of(const ShellMesh& mesh,
                                                    const std::function<Vector3(const Vector3&)>& moved,
                                                    double poisson) {
  return shell_stresses(mesh, read_frd(frd(mesh, moved), "t.frd"), poisson, "t.frd");
}

TEST(ShellStress, IsHookesInThePlaneAndInBending) {
  const ShellMesh mesh = grid(2, [](double x, double y) { return Vector3(10 * x + y, 9 * y + x, 0); });
  const auto stretched = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(1e-3 * p.x(), 0, 0); }, 0.3);
  for (const auto& quad : stretched) {
    for (const ShellStress& stress : quad) {
      EXPECT_NEAR(stress.membrane[0], 1e-3 / 0.91, 1e-6);
      EXPECT_NEAR(stress.membrane[1], 0.3e-3 / 0.91, 1e-6);
      EXPECT_NEAR(stress.membrane[3], 0, 1e-6);
      EXPECT_LT(stress.bending.norm(), 1e-6);
      EXPECT_NEAR(stress.thickness, 0.2, 1e-6);
    }
  }
  // Fibers stretch by their height times 0.02: at the top, 0.1 up, by 2e-3.
  const auto bent = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(0.02 * p.z() * p.x(), 0, 0); }, 0.3);
  double area = 0;
  for (const auto& quad : bent) {
    for (const ShellStress& stress : quad) {
      area += stress.area;
      EXPECT_LT(stress.membrane.norm(), 1e-6);
      EXPECT_NEAR(stress.bending[0], 2e-3 / 0.91, 2e-6);
      EXPECT_NEAR(stress.bending[1], 0.3 * 2e-3 / 0.91, 2e-6);
    }
  }
  EXPECT_NEAR(area, 89, 1e-3);
}

TEST(ShellStress, TurnsWithQuadsThatSolversTurnOver) {
  const ShellMesh mesh = grid(3, flat);
  ShellMesh turned = mesh;
  for (auto& [a, b, c, d] : turned.quads) std::swap(b, d);
  const auto moved = [](const Vector3& p) { return Vector3(0.02 * p.z() * p.x() * p.y(), 0, 0); };
  const SolverResult result = read_frd(frd(turned, moved), "t.frd");
  const auto same = shell_stresses(mesh, result, 0, "t.frd"), straight = stresses_of(mesh, moved, 0);
  for (std::size_t quad = 0; quad < same.size(); ++quad) {
    for (int k = 0; k < 4; ++k) {
      EXPECT_LT((same[quad][k].point - straight[quad][k].point).norm(), 1e-5);
      EXPECT_LT((same[quad][k].bending - straight[quad][k].bending).norm(), 1e-5);
    }
  }
}

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

TEST(Adapt, ReadsVtuAsItReadsFrd) {
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

/// Stresses that are given by place.
std::vector<std::array<ShellStress, 4>> given(const ShellMesh& mesh,
                                              const std::function<double(int quad, const Vector3&)>& value) {
  auto stresses = stresses_of(
      mesh, [](const Vector3& p) { return Vector3(p.x(), 0, 0); }, 0.3);
  for (std::size_t quad = 0; quad < stresses.size(); ++quad) {
    for (ShellStress& stress : stresses[quad]) {
      stress.membrane.setZero();
      stress.bending.setZero();
      stress.membrane[0] = stress.bending[3] = value(static_cast<int>(quad), stress.point);
    }
  }
  return stresses;
}

TEST(ErrorEstimate, IsNoneForStressesThatArePolynomials) {
  const ShellMesh mesh = grid(6, flat);
  const auto smooth =
      given(mesh, [](int, const Vector3& p) { return 1 + p.x() * p.y() - 0.3 * p.x() * p.x(); });
  EXPECT_LT(estimate_error(mesh, smooth, 0.3).relative(), 1e-6);
}

TEST(ErrorEstimate, IsWhereStressesJump) {
  const ShellMesh mesh = grid(8, flat);
  const auto jumping =
      given(mesh, [](int quad, const Vector3&) { return quad == 0 || quad == 9 ? 2.0 : 1.0; });
  const ErrorEstimate estimate = estimate_error(mesh, jumping, 0.3);
  EXPECT_GT(estimate.relative(), 0.05);
  double near = 0;
  for (std::size_t quad = 0; quad < estimate.squares.size(); ++quad) {
    if (quad % 8 < 4 && quad / 8 < 4) near += estimate.squares[quad];
  }
  EXPECT_GT(near, 0.999 * estimate.sum());
}

TEST(ErrorEstimate, FoldsAreNoErrors) {
  const auto bent = [](double x, double y) {
    return x <= 0.5 ? Vector3(10 * x, 10 * y, 0) : Vector3(5, 10 * y, 10 * x - 5);
  };
  const ShellMesh mesh = grid(6, bent);
  const auto two = given(mesh, [](int quad, const Vector3&) { return quad % 6 < 3 ? 1.0 : -2.0; });
  EXPECT_LT(estimate_error(mesh, two, 0.3).relative(), 1e-6);
  const ShellMesh straight = grid(6, flat);
  EXPECT_GT(estimate_error(straight, two, 0.3).relative(), 0.1);
}

TEST(ErrorEstimate, SizesSpreadItEvenly) {
  const ShellMesh mesh = grid(10, flat);  // quads of side 1
  ErrorEstimate estimate;
  estimate.squares.assign(100, 1e-4);
  estimate.all = 1;
  for (const double size : even_sizes(mesh, estimate)) EXPECT_NEAR(size, even_sizes(mesh, estimate)[0], 1e-9);
  // Second order: the square of a quad's error goes with the sixth power of its new size, over as many.
  for (int quad = 0; quad < 100; ++quad) {
    if (quad % 10 < 5) estimate.squares[quad] = 64e-4;
  }
  auto sizes = even_sizes(mesh, estimate);
  EXPECT_NEAR(sizes[3] / sizes[8], 0.5, 1e-6);
  EXPECT_GT(sizes[5], 1.05 * sizes[4]);
  EXPECT_LT(sizes[5], 0.95 * sizes[6]);
  // A single quad is believed by a quarter at each of its corners.
  estimate.squares.assign(100, 1e-4);
  estimate.squares[55] = 64e-4;
  sizes = even_sizes(mesh, estimate);
  EXPECT_NEAR(sizes[5 * 11 + 5] / sizes[0], std::pow(67.0 / 4, -1.0 / 6), 1e-6);
}

/// Writes the sizes for a solution on a mesh, and deletes the files at the end.
class Adapted {
 public:
  Adapted(const ShellMesh& mesh, const std::function<Vector3(const Vector3&)>& moved,
          const AdaptOptions& options) {
    std::ofstream(solution_) << frd(mesh, moved);
    ExecutionContext context;
    result = adapt(mesh, solution_, sizes, options, context);
  }
  ~Adapted() {
    std::filesystem::remove(solution_);
    std::filesystem::remove(sizes);
  }
  Adapted(const Adapted&) = delete;
  Adapted& operator=(const Adapted&) = delete;

  AdaptResult result;
  std::filesystem::path sizes = std::filesystem::temp_directory_path() / "quadrille_adapted_test.vdb";

 private:
  std::filesystem::path solution_ = std::filesystem::temp_directory_path() / "quadrille_adapted_test.frd";
};

/// Quads that the box has with the sizes in a file.
int quads_with(const CadModel& box, const Adapted& adapted) {
  MeshOptions options;
  options.sizing.size = adapted.result.largest;
  options.sizing.size_min = adapted.result.least;
  options.sizing.size_field = adapted.sizes;
  options.sizing.elements_per_circle = 0;
  ExecutionContext context;
  return static_cast<int>(mesh(box, options, context).quads.size());
}

TEST(Adapt, TheNextMeshHasAsManyQuadsAsItTells) {
  const CadModel box = CadModel::read(sample_model("box").path());
  MeshOptions options;
  options.sizing.size = (box.box_max() - box.box_min()).norm() / 20;
  ExecutionContext context;
  ShellMesh first = mesh(box, options, context);
  first.order = 2;
  const Vector3 at = box.box_max();
  const double length = (at - box.box_min()).norm();
  // Steep at a corner, and everywhere with noise, whose wave is shorter than a quad.
  const auto moved = [&](const Vector3& p) {
    const double noise = 1e-4 * std::sin(1e3 * p.dot(Vector3(1, 1.7, 2.3)) / length);
    return Vector3(std::exp(-20 * (p - at).norm() / length) + noise, noise, -noise);
  };
  AdaptOptions wanted;
  for (const double count : {1000.0, 4000.0}) {
    wanted.count = count;
    const Adapted adapted(first, moved, wanted);
    EXPECT_NEAR(adapted.result.quads_wanted / count, 1, 0.02);
    EXPECT_NEAR(quads_with(box, adapted) / count, 1, 0.3);
    EXPECT_GT(adapted.result.largest, 2 * adapted.result.least);
  }
}

TEST(Adapt, ASmallerErrorTakesMoreQuads) {
  const ShellMesh mesh = grid(10, flat);
  const auto moved = [](const Vector3& p) { return Vector3(std::exp(0.3 * p.x()), 0, 0); };
  AdaptOptions options;
  options.count = 100;
  const Adapted same(mesh, moved, options);
  EXPECT_LT(same.result.error_wanted, same.result.error);
  options.count = 0;
  options.error = same.result.error / 4;
  const Adapted finer(mesh, moved, options);
  EXPECT_NEAR(finer.result.error_wanted / (0.9 * options.error), 1, 0.02);
  // Not below the half of what it takes where all sizes become smaller alike.
  EXPECT_GT(finer.result.quads_wanted, 200);
  EXPECT_LT(finer.result.quads_wanted, 400);
}

TEST(Adapt, TheLeastSizeIsOneOfTheField) {
  const ShellMesh mesh = grid(10, flat);
  const auto last = [](const Vector3& p) { return Vector3(std::exp(0.3 * p.x()), 0, 0); };
  const auto first = [](const Vector3& p) { return Vector3(-std::exp(0.3 * (10 - p.x())), 0, 0); };
  AdaptOptions options;
  options.count = 100;
  const double least = Adapted(mesh, last, options).result.least;
  EXPECT_NEAR(Adapted(mesh, first, options).result.least, least, 0.01 * least);
}

TEST(Adapt, AsksForNoCoarserMeshWhereTheTargetIsMet) {
  const ShellMesh mesh = grid(10, flat);  // quads of side 1
  const auto moved = [](const Vector3& p) { return Vector3(std::exp(0.3 * p.x()), 0, 0); };
  AdaptOptions options;
  options.error = 0.5;
  const Adapted met(mesh, moved, options);
  EXPECT_TRUE(met.result.is_met);
  EXPECT_LT(met.result.error, options.error);
  EXPECT_EQ(met.result.quads_wanted, 100);
  EXPECT_EQ(met.result.error_wanted, met.result.error);
  EXPECT_NEAR(met.result.least, 1, 1e-6);
  EXPECT_NEAR(met.result.largest, 1, 1e-6);
  options.error = 0.99 * met.result.error;
  EXPECT_FALSE(Adapted(mesh, moved, options).result.is_met);
  options.count = 25;  // who wants fewer elements gets them
  const Adapted coarser(mesh, moved, options);
  EXPECT_FALSE(coarser.result.is_met);
  EXPECT_LT(coarser.result.quads_wanted, 30);
}

/// A plate of n x n quads without the quarter at (10, 10): an L with a re-entrant corner at (5, 5).
ShellMesh l_plate(int n) {
  ShellMesh mesh = grid(n, flat);
  std::erase_if(mesh.quads, [&](const auto& quad) {
    return mesh.points[quad[0]].x() > 5 - 1e-9 && mesh.points[quad[0]].y() > 5 - 1e-9;
  });
  return mesh;
}

TEST(PeakStress, AtASharpCornerIsSingular) {
  const Vector3 corner(5, 5, 0);
  const auto singular = [&](int, const Vector3& p) { return std::pow((p - corner).norm(), -0.455); };
  const ShellMesh coarse = l_plate(8), fine = l_plate(16);
  const auto before = stress_peaks(coarse, given(coarse, singular)),
             now = stress_peaks(fine, given(fine, singular));
  ASSERT_EQ(now.size(), 1u);
  EXPECT_TRUE(now[0].sharp_corner);
  EXPECT_LT((now[0].at - corner).norm(), 1e-9);
  EXPECT_NEAR(now[0].size, 0.625, 1e-9);
  const auto changes = changes_of_peaks(before, now);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_NEAR(changes[0].change, std::pow(2, 0.455) - 1, 1e-6);
  EXPECT_TRUE(changes[0].is_singular());
  const std::string sentence = changes[0].sentence();
  EXPECT_NE(sentence.find("(5, 5, 0)"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("grown by 37.1 %"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("singular"), std::string::npos) << sentence;
  // On the same mesh again nothing has changed, nor does what has no place in common.
  EXPECT_TRUE(changes_of_peaks(now, now).empty());
  auto elsewhere = before;
  elsewhere[0].at.x() -= 3;
  EXPECT_TRUE(changes_of_peaks(elsewhere, now).empty());
}

TEST(PeakStress, ElsewhereItSettles) {
  // Two hills on a square plate, of heights 3 and 2.
  const auto hills = [](double height) {
    return [height](int, const Vector3& p) {
      return height * std::exp(-(p - Vector3(2.5, 2.5, 0)).squaredNorm()) +
             2 * std::exp(-(p - Vector3(7.5, 7.5, 0)).squaredNorm());
    };
  };
  const ShellMesh mesh = grid(20, flat);
  const auto before = stress_peaks(mesh, given(mesh, hills(3))),
             now = stress_peaks(mesh, given(mesh, hills(2.4)));
  ASSERT_EQ(before.size(), 2u);
  EXPECT_LT((before[0].at - Vector3(2.5, 2.5, 0)).norm(), 1e-9);
  EXPECT_LT((before[1].at - Vector3(7.5, 7.5, 0)).norm(), 1e-9);
  EXPECT_NEAR(before[0].stress / before[1].stress, 1.5, 1e-6);
  // Stretched by 1 and sheared in bending by 1: at the surface 1 along and 1 in shear.
  EXPECT_NEAR(before[1].stress, 4, 0.4);
  const auto changes = changes_of_peaks(before, now);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_NEAR(changes[0].change, -0.2, 1e-6);
  EXPECT_FALSE(changes[0].is_singular());
  EXPECT_NE(changes[0].sentence().find("20 % lower"), std::string::npos) << changes[0].sentence();
  EXPECT_FALSE(now[0].sharp_corner);
}

TEST(ErrorEstimate, TellsWhereItIsConcentrated) {
  constexpr int n = 8;
  const ShellMesh mesh = grid(n, flat);
  ErrorEstimate estimate;
  estimate.squares.assign(mesh.quads.size(), 1);
  const int node = 4 * (n + 1) + 4;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    if (std::count(mesh.quads[quad].begin(), mesh.quads[quad].end(), node) > 0) estimate.squares[quad] = 8;
  }
  std::vector<char> wanted(mesh.points.size(), 0);
  wanted[node] = 1;
  EXPECT_EQ(singular_corners(mesh, estimate), wanted);
  // A slope is none, nor a rough field.
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad)
    estimate.squares[quad] = std::pow(1.3, static_cast<double>(quad % n)) * (1 + quad % 3);
  EXPECT_EQ(singular_corners(mesh, estimate), std::vector<char>(mesh.points.size(), 0));
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

TEST(Adapt, WritesSizesAndRefusesWhatDoesNotFit) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto result = folder / "quadrille_adapt_test.frd", sizes = folder / "quadrille_adapt_test.vdb";
  const ShellMesh mesh = grid(6, flat);
  const auto moved = [](const Vector3& p) { return Vector3(std::exp(0.3 * p.x()), 0, 0); };
  std::ofstream(result) << frd(mesh, moved);
  ExecutionContext context;
  AdaptOptions options;
  const AdaptResult done = adapt(mesh, result, sizes, options, context);
  EXPECT_GT(done.error, 0.001);
  EXPECT_LT(done.error, 0.5);
  EXPECT_LT(done.least, done.largest);
  EXPECT_TRUE(std::filesystem::exists(sizes));
  const auto refused = [&](const ShellMesh& other, const AdaptOptions& asked, Error::Kind kind) {
    try {
      adapt(other, result, sizes, asked, context);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
    }
  };
  refused(grid(5, flat), options, Error::Kind::failure);
  refused(grid(6, [](double x, double y) { return Vector3(10 * x, 10 * y, 50); }), options,
          Error::Kind::failure);
  for (const double error : {0.0, -1.0, 1.0, std::nan("")}) {
    AdaptOptions wrong;
    wrong.error = error;
    refused(mesh, wrong, Error::Kind::usage);
  }
  AdaptOptions wrong;
  wrong.poisson = 0.5;
  refused(mesh, wrong, Error::Kind::usage);
  std::ofstream(result) << frd(mesh, [](const Vector3&) { return Vector3(1, 2, 3); });
  refused(mesh, options, Error::Kind::failure);
  std::filesystem::remove(result);
  std::filesystem::remove(sizes);
}

}  // namespace
}  // namespace quadrille
