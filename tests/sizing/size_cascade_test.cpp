/// Sizes in voxels: what was put in comes out, grows outward no faster than asked, and takes the room
/// allowed.

#include "geometry/sizing/size_cascade.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "geometry/base/error.hpp"

namespace quadrille {
namespace {

constexpr CascadeFrame frame{8, 0.3, 20};

/// Points far apart, with sizes from a thousandth of the largest on.
std::vector<SizePoint> scattered() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1, 1), power(-10, -0.1);
  std::vector<SizePoint> result;
  for (int i = 0; i < 60; ++i)
    result.push_back(
        {Vector3(40.0 * i + place(random), place(random), place(random)), 8 * std::exp2(power(random))});
  return result;
}

SizeCascade graded(const std::vector<SizePoint>& points, double slope, const SizeCascade::Near& near = {}) {
  SizeCascade cascade(frame);
  BlockCount blocks(1e6);
  for (const SizePoint& at : points) cascade.add(at.point, at.size, blocks);
  EXPECT_TRUE(cascade.is_fresh());
  cascade.grade(slope, near, blocks, ExecutionContext());
  EXPECT_FALSE(cascade.is_fresh());
  return cascade;
}

std::map<std::tuple<int, int, int, int>, float> voxels(const SizeCascade& cascade) {
  std::map<std::tuple<int, int, int, int>, float> result;
  cascade.for_each([&](int level, const Coord& c, float value) {
    result[{level, c.x(), c.y(), c.z()}] = value;
  });
  return result;
}

TEST(SizeCascade, SortsSizesIntoLevelsOfHalfTheSize) {
  for (const SizePoint& at : scattered()) {
    const int level = level_for(frame.size_max, at.size);
    EXPECT_GE(frame.size(level), at.size);
    EXPECT_LT(frame.size(level), 2 * at.size);
  }
}

TEST(SizeCascade, GivesBackTheSizesAtTheirPoints) {
  const SizeCascade cascade = graded(scattered(), 0.3);
  SizeCascade::Lookup size_at(cascade);
  for (const SizePoint& at : scattered()) EXPECT_NEAR(size_at(at.point), at.size, 1e-6 * at.size);
  EXPECT_EQ(size_at({0, 500, 0}), frame.size_max);
}

/// Along a ray from one small size; voxels are as wide as the size there, by which the field may be late.
TEST(SizeCascade, GrowsByTheSlope) {
  constexpr double source = 0.05, slope = 0.3;
  const SizeCascade cascade = graded({{{0, 0, 0}, source}}, slope);
  SizeCascade::Lookup size_at(cascade);
  double before = source;
  for (double x = 0.1; x < 8; x += 0.1) {
    const double size = size_at({x, 0.4 * x, 0}), wanted = source + slope * std::hypot(x, 0.4 * x);
    EXPECT_LE(size, wanted * (1 + 2 * slope)) << x;
    EXPECT_GE(size, 0.6 * wanted) << x;
    EXPECT_GE(size, 0.8 * before) << x;
    before = size;
  }
}

TEST(SizeCascade, DoesNotDependOnTheOrder) {
  std::vector<SizePoint> points = scattered();
  const auto voxels_before = voxels(graded(points, 0.3));
  EXPECT_GT(voxels_before.size(), 1000U);
  std::shuffle(points.begin(), points.end(), std::mt19937(2));
  EXPECT_EQ(voxels(graded(points, 0.3)), voxels_before);
}

TEST(SizeCascade, GrowsOnlyWhereSizesAreNeeded) {
  const SizeCascade cascade =
      graded({{{0, 0, 0}, 0.1}}, 0.3, [](const Vector3& p, double) { return p.x() < 1; });
  for (const auto& [voxel, value] : voxels(cascade))
    EXPECT_LT(std::get<1>(voxel) * frame.voxel(std::get<0>(voxel)), 1 + frame.voxel(0));
  SizeCascade::Lookup size_at(cascade);
  EXPECT_EQ(size_at({20, 0, 0}), frame.size_max);
  EXPECT_LT(size_at({-3, 0, 0}), 2);
}

TEST(SizeCascade, EndsWhereItsRoomEnds) {
  SizeCascade cascade(frame);
  BlockCount blocks(20);
  try {
    for (const SizePoint& at : scattered()) cascade.add(at.point, at.size, blocks);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::usage);
  }
}

}  // namespace
}  // namespace quadrille
