/// Sizes that follow the errors of stresses, from displacements as CalculiX writes them.

#include "mesher/adapt/adapt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "geometry/base/error.hpp"
#include "mesher/quadrille.hpp"
#include "tests/support/sample_models.hpp"
#include "tests/support/solved_plates.hpp"

namespace quadrille {
namespace {

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
