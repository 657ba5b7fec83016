/// Sizes from points of a result, as a field, and in files that give them back.

#include "geometry/sizing/size_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "geometry/base/error.hpp"
#include "geometry/sizing/size_cascade.hpp"
#include "geometry/sizing/vdb_module.hpp"

namespace quadrille {
namespace {

/// Where sizes change, those between points are looked up, on all levels, and not the least of all in a
/// voxel.
TEST(SizeFile, MeansOfPointsAreWhatTheyAskFor) {
  constexpr double slope = 0.2;
  const auto wanted = [](double x) { return 0.1 + slope * x; };
  std::vector<SizePoint> points;
  double x = 0;
  while (x < 20) {
    const double step = 0.5 * wanted(x);
    for (int k = 0; k * step < 10; ++k) points.push_back({{x, k * step, 0.3}, wanted(x)});
    x += step;
  }
  ExecutionContext context;
  const SizeCascade field = mean_sizes(points, 0.3, context);
  EXPECT_GT(field.levels(), 4);
  SizeCascade::Lookup size_at(field);
  double sum = 0, count = 0;
  for (int k = 5; k < 190; ++k) {
    const double ratio = size_at({0.1 * k, 5, 0.3}) / wanted(0.1 * k);
    EXPECT_GT(ratio, 0.85) << k;
    EXPECT_LT(ratio, 1.15) << k;
    sum += std::log(ratio);
    ++count;
  }
  EXPECT_NEAR(std::exp(sum / count), 1, 0.05);
}

TEST(SizeFile, GivesBackTheFieldThatWasWritten) {
  const auto path = std::filesystem::temp_directory_path() / "quadrille_size_file_test.vdb";
  const std::vector<SizePoint> points{{{0, 0, 0}, 0.1}, {{6, 1, 2}, 0.7}, {{-3, 4, 0}, 2}};
  const SizeCascade field = mean_sizes(points, 0.3, ExecutionContext(1));
  write_cascade(field, path);
  const ExternalSizes read = opened_size_field(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(read.between_voxels);
  EXPECT_NEAR(read.voxel, field.frame().voxel(field.levels() - 1), 1e-9);
  for (const SizePoint& at : points)
    EXPECT_TRUE((at.point.array() >= read.low.array()).all() &&
                (at.point.array() <= read.high.array()).all());
  SizeCascade::Lookup size_at(field);
  for (double x = -3; x < 6; x += 0.13)
    for (const double y : {-0.2, 0.0, 1.7})
      EXPECT_NEAR(read.at({x, y, 0.1}), size_at({x, y, 0.1}), 1e-6) << x;
}

TEST(SizeFile, FailsWithASentenceWhereThereIsNone) {
  const auto folder = std::filesystem::temp_directory_path() / "quadrille_size_file_test";
  const SizeCascade field = mean_sizes({{{0, 0, 0}, 1}}, 0.3, ExecutionContext(1));
  EXPECT_THROW(write_cascade(field, folder / "nowhere" / "sizes.vdb"), Error);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "sizes.vdb") << "no grid";
  for (const char* name : {"missing.vdb", "sizes.vdb"}) {
    try {
      opened_size_field(folder / name);
      ADD_FAILURE() << "no error for " << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::failure);
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace quadrille
