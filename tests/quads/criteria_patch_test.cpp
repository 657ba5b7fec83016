/// The smooth objective at the square and at each limit, and its lanes against the exact measure.

#include "mesher/quads/criteria_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadrille {
namespace {

TEST(CriteriaPatch, ObjectiveIsLeastForTheSquare) {
  const auto of = [](const Vector3& c) { return measure_objective({0, 0, 0}, {1, 0, 0}, c, {0, 1, 0}); };
  const QuadObjective square = of({1, 1, 0});
  EXPECT_NEAR(square.value, 1.0 / 625, 1e-5);  // the aspect's share of it
  EXPECT_DOUBLE_EQ(square.least_sine, 1);
  EXPECT_NEAR((square.normal - Vector3(0, 0, 1)).norm(), 0, 1e-12);
  EXPECT_GT(of({1.2, 1.1, 0}).value, square.value);
  EXPECT_GT(of({1.5, 1.1, 0}).value, of({1.2, 1.1, 0}).value);
  EXPECT_LT(of({0.4, 0.4, 0}).least_sine, 0);
}

TEST(CriteriaPatch, EachCriterionCountsOneAtItsLimit) {
  // Four corners and the mid-lines off by 40 degrees.
  const double s = std::sin(40 * M_PI / 180), c = std::cos(40 * M_PI / 180);
  const double corners = std::pow(s / std::sin(50 * M_PI / 180), 4);
  EXPECT_NEAR(
      measure_objective({0, 0, 0}, {1, 0, 0}, {1 + s, c, 0}, {s, c, 0}).value * 1.0,
      [&] {
        const double sum = 1 + 4 * corners + 1.0 / 625;
        return sum / (1 + sum / 1000);
      }(),
      1e-5);
  // A rectangle of 1 to 5.
  EXPECT_NEAR(measure_objective({0, 0, 0}, {5, 0, 0}, {5, 1, 0}, {0, 1, 0}).value, 1 / (1 + 1.0 / 1000),
              1e-12);
}

TEST(CriteriaPatch, SquarenessCountsEachCorner) {
  const auto of = [](const Vector3& c, double squareness) {
    return measure_objective({0, 0, 0}, {1, 0, 0}, c, {0, 1, 0}, squareness).value;
  };
  EXPECT_NEAR(of({1, 1, 0}, 3), of({1, 1, 0}, 0), 1e-12);
  // A parallelogram whose corners are 10 degrees off, with sides of one.
  const double s = std::sin(10 * M_PI / 180), c = std::cos(10 * M_PI / 180);
  const auto leaning = [&](double squareness) {
    return measure_objective({0, 0, 0}, {1, 0, 0}, {1 + s, c, 0}, {s, c, 0}, squareness).value;
  };
  EXPECT_LT(leaning(0), 0.02);
  EXPECT_NEAR(leaning(3) - leaning(0), 3 * 4 * s * s, 1e-3);
}

TEST(CriteriaPatch, LanesAgreeWithTheExactMeasure) {
  const Vector3 a(0.1, 0.05, 0), b(1, 0.1, 0), c(1.2, 1.1, 0), d(-0.1, 0.9, 0), e(-1, 0, 0), f(-0.9, 1, 0);
  const Vector3 u(1, 0, 0), v(0, 1, 0);
  constexpr double weight = 0.3;
  for (const double squareness : {0.0, 3.0}) {
    CriteriaPatch patch(u, v, squareness);
    ASSERT_TRUE(patch.add(a, b, c, d));
    ASSERT_TRUE(patch.add(a, d, f, e, weight));
    const CriteriaPatch::Lanes x{0, 0.1, -0.1, 0.2, 0, 0, 0.1, 5}, y{0, 0, 0, 0, 0.1, -0.1, 0.1, 5};
    const auto values = patch.evaluate(x, y);
    for (int k = 0; k + 1 < CriteriaPatch::lanes; ++k) {
      const Vector3 p = a + x[k] * u + y[k] * v;
      EXPECT_NEAR(values[k],
                  measure_objective(p, b, c, d, squareness).value +
                      weight * measure_objective(p, d, f, e, squareness).value,
                  1e-12);
    }
    EXPECT_GT(values[7], 1e29);  // not convex
  }
}

}  // namespace
}  // namespace quadrille
