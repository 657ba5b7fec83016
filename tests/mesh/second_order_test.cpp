/// Jacobians of eight-node elements: known values, folds, and a bound that holds at samples.

#include "mesher/mesh/second_order.hpp"

#include <gtest/gtest.h>

#include <random>

namespace quadrille {
namespace {

CurvedQuad straight(std::array<Vector3, 4> corners) {
  CurvedQuad element{corners, {}};
  for (int k = 0; k < 4; ++k) element.midsides[k] = 0.5 * (corners[k] + corners[(k + 1) % 4]);
  return element;
}

const std::array<Vector3, 4> unit_square{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(1, 1, 0),
                                         Vector3(0, 1, 0)};

TEST(SecondOrder, StraightSquareHasJacobianOne) {
  const CurvedQuad e = straight(unit_square);
  EXPECT_NEAR(jacobian_bound(e), 1, 1e-12);
}

TEST(SecondOrder, SizePlaceAndOrientationDoNotMatter) {
  std::array<Vector3, 4> moved = unit_square;
  for (Vector3& p : moved)
    p = Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()) * Vector3(1e-3 * p) + Vector3(5, 6, 7);
  const CurvedQuad e = straight(moved);
  EXPECT_NEAR(jacobian_bound(e), 1, 1e-6);
}

TEST(SecondOrder, FindsAFoldThatTheCornersDoNotShow) {
  CurvedQuad e = straight(unit_square);
  e.midsides[0].y() = 0.75;  // the lower side bulges up, corner angles stay positive
  e.midsides[2].y() = 0.70;  // the upper one bulges down to meet it
  EXPECT_LE(jacobian_bound(e), 0);
}

TEST(SecondOrder, BoundIsBelowEverySample) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  int positive = 0, negative = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    CurvedQuad e = straight(unit_square);
    for (auto* points : {&e.corners, &e.midsides}) {
      for (Vector3& p : *points) p += Vector3(shift(random), shift(random), 0);
    }
    const double bound = jacobian_bound(e);
    // The map itself, by its shape functions, differentiated numerically.
    const auto at = [&](double xi, double eta) {
      const double s[4] = {-1, 1, 1, -1}, t[4] = {-1, -1, 1, 1};
      Vector3 x = Vector3::Zero();
      for (int k = 0; k < 4; ++k) {
        x += 0.25 * (1 + xi * s[k]) * (1 + eta * t[k]) * (xi * s[k] + eta * t[k] - 1) * e.corners[k];
      }
      x += 0.5 * (1 - xi * xi) * (1 - eta) * e.midsides[0] + 0.5 * (1 + xi) * (1 - eta * eta) * e.midsides[1];
      x += 0.5 * (1 - xi * xi) * (1 + eta) * e.midsides[2] + 0.5 * (1 - xi) * (1 - eta * eta) * e.midsides[3];
      return x;
    };
    const double mean = (e.corners[2] - e.corners[0]).cross(e.corners[3] - e.corners[1]).z() / 8;
    if (mean < 0.05) continue;
    double least = 1e9;
    constexpr double h = 1e-5;
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; j <= 20; ++j) {
        const double xi = 0.1 * i - 1, eta = 0.1 * j - 1;
        const Vector3 a = (at(xi + h, eta) - at(xi - h, eta)) / (2 * h);
        const Vector3 b = (at(xi, eta + h) - at(xi, eta - h)) / (2 * h);
        least = std::min(least, a.cross(b).z() / mean);
      }
    }
    EXPECT_LE(bound, least + 1e-6);
    if (bound > 0) {
      ++positive;
      EXPECT_GT(least, 0);
    } else {
      ++negative;
      EXPECT_LT(least, 0.25);  // not so pessimistic as to call good elements bad
    }
  }
  EXPECT_GT(positive, 50);
  EXPECT_GT(negative, 50);
}

}  // namespace
}  // namespace quadrille
