/// Sizes by position: regions, and files of points, which are read or refused with the line that is wrong.

#include "geometry/sizing/spatial_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "geometry/base/error.hpp"
#include "tests/support/sample_models.hpp"

namespace quadrille {
namespace {

constexpr double largest = 4;

SpatialSizes sizes_of(const CadModel& model, SizingOptions options) {
  options.size = largest;
  ExecutionContext context(1);
  BlockCount blocks(1e5);
  return SpatialSizes(model, options, size_limits(model, options), blocks, context);
}

class SpatialSizesTest : public ::testing::Test {
 protected:
  const CadModel box_ = CadModel::read(sample_model("box").path());  // 30 x 20 x 10
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / "quadrille_spatial_sizes_test.csv";

  ~SpatialSizesTest() override { std::filesystem::remove(path_); }
  /// The options with points from such a file.
  SizingOptions points(const std::string& text) const {
    std::ofstream(path_) << text;
    SizingOptions options;
    options.size_points = path_;
    return options;
  }
};

TEST_F(SpatialSizesTest, AreTheLeastThatRegionsAskFor) {
  SizingOptions options;
  options.regions = {
      {SizeRegion::Shape::box, {0, 0, 0}, {5, 5, 5}, 0, 0.5, 0},
      {SizeRegion::Shape::sphere, {30, 20, 10}, {0, 0, 0}, 2, 0.7, 20},
      {SizeRegion::Shape::half_space, {0, 18, 0}, {0, 1, 0}, 0, 6, 0},  // larger than the global size
  };
  const SpatialSizes sizes = sizes_of(box_, options);
  EXPECT_FALSE(sizes.empty());
  EXPECT_TRUE(sizes_of(box_, {}).empty());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  int less = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 p(30 * share(random), 20 * share(random), 10 * share(random));
    const double from_box = 0.5 + options.growth * options.regions[0].distance(p);
    // A transition of 20 is slower than growth allows.
    const double from_sphere =
        0.7 + std::min(options.growth, (largest - 0.7) / 20) * options.regions[1].distance(p);
    EXPECT_NEAR(sizes.at(p), std::min({largest, from_box, from_sphere}), 1e-12);
    EXPECT_LE(sizes.hint(p), sizes.at(p));
    less += sizes.at(p) < largest;
  }
  EXPECT_GT(less, 100);
}

TEST_F(SpatialSizesTest, RefuseARegionBesideTheModel) {
  SizingOptions options;
  options.regions = {{SizeRegion::Shape::sphere, {-5, 0, 0}, {0, 0, 0}, 6, 1, 0}};
  EXPECT_NO_THROW(sizes_of(box_, options));
  options.regions.push_back({SizeRegion::Shape::sphere, {-5, 0, 0}, {0, 0, 0}, 4, 1, 0});
  try {
    sizes_of(box_, options);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::usage);
    EXPECT_NE(std::string(error.what()).find("region 2"), std::string::npos) << error.what();
  }
}

TEST_F(SpatialSizesTest, PointsAskForTheirSizeWithinTheLimits) {
  const SpatialSizes sizes = sizes_of(box_, points("0,0,0,0.8\n30,20,10,0.001\n15,10,10,90\n"));
  ASSERT_EQ(sizes.points().size(), 3U);
  EXPECT_NEAR(sizes.at({0, 0, 0}), 0.8, 1e-6);
  EXPECT_NEAR(sizes.at({30, 20, 10}), largest / 8, 1e-6);  // the least size
  EXPECT_EQ(sizes.at({15, 10, 10}), largest);
  EXPECT_LT(sizes.at({1, 0, 0}), 0.8 + 0.3 * 2);
}

TEST_F(SpatialSizesTest, RefuseFilesThatMakeNoSense) {
  for (const char* text : {"", "x,y,z,size\n", "1,2,3\n", "0,0,0,-1\n", "0,0,0,nan\n", "0,0,0,1,\n",
                           "a,b\nc,d\n", "1,2,3,x\n0,0,0,1\n", "900,0,0,1\n"})
    EXPECT_THROW(sizes_of(box_, points(text)), Error) << text;
  try {
    read_size_points(points("1,2,nan,1\n").size_points);
    FAIL();
  } catch (const Error& problem) {
    EXPECT_NE(std::string(problem.what()).find("line 1 has a coordinate"), std::string::npos)
        << problem.what();
  }
}

}  // namespace
}  // namespace quadrille
