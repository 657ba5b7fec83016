/// Every criterion on quads whose values are known, in any orientation.

#include "mesher/mesh/criteria.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadrille {
namespace {

constexpr double pi = std::numbers::pi;

double value(Criterion criterion, const std::array<Vector3, 4>& quad) {
  return measure_criteria(quad[0], quad[1], quad[2], quad[3])[static_cast<std::size_t>(criterion)];
}

const std::array<Vector3, 4> rectangle{{{0, 0, 0}, {6, 0, 0}, {6, 1, 0}, {0, 1, 0}}};
/// Sides of 2 and of the root of 2, corners of 45 and 135 degrees.
const std::array<Vector3, 4> sheared{{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}}};
/// Parallel sides of 3 and 1, a unit apart.
const std::array<Vector3, 4> trapezium{{{0, 0, 0}, {3, 0, 0}, {2, 1, 0}, {1, 1, 0}}};
/// A unit square with a corner lifted by one.
const std::array<Vector3, 4> bent{{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}};
/// Concave at the third corner.
const std::array<Vector3, 4> arrow{{{0, 0, 0}, {1, 0, 0}, {0.25, 0.25, 0}, {0, 1, 0}}};

TEST(Criteria, OfTheRectangle) {
  EXPECT_DOUBLE_EQ(value(Criterion::aspect, rectangle), 6);
  EXPECT_NEAR(value(Criterion::warp, rectangle), 0, 1e-12);
  EXPECT_NEAR(value(Criterion::skew, rectangle), 0, 1e-12);
  EXPECT_NEAR(value(Criterion::angle_min, rectangle), 90, 1e-12);
  EXPECT_NEAR(value(Criterion::angle_max, rectangle), 90, 1e-12);
  EXPECT_NEAR(value(Criterion::jacobian_ratio, rectangle), 1, 1e-12);
  EXPECT_NEAR(value(Criterion::taper, rectangle), 0, 1e-12);
}

TEST(Criteria, OfTheShearedQuad) {
  EXPECT_NEAR(value(Criterion::aspect, sheared), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(value(Criterion::skew, sheared), 45, 1e-12);
  EXPECT_NEAR(value(Criterion::angle_min, sheared), 45, 1e-12);
  EXPECT_NEAR(value(Criterion::angle_max, sheared), 135, 1e-12);
  EXPECT_NEAR(value(Criterion::jacobian_ratio, sheared), 1, 1e-12);
  EXPECT_NEAR(value(Criterion::taper, sheared), 0, 1e-12);
}

TEST(Criteria, OfTheTrapezium) {
  // The width falls linearly from 3 to 1: 2 + 1 / root 3 and 2 - 1 / root 3 at the Gauss points.
  const double change = 1 / std::sqrt(3.0);
  EXPECT_NEAR(value(Criterion::jacobian_ratio, trapezium), (2 - change) / (2 + change), 1e-12);
  // Area 2, the least corner triangle 1 / 2.
  EXPECT_NEAR(value(Criterion::taper, trapezium), 0.5, 1e-12);
  EXPECT_NEAR(value(Criterion::skew, trapezium), 0, 1e-12);
  EXPECT_NEAR(value(Criterion::angle_max, trapezium), 135, 1e-12);
}

TEST(Criteria, OfTheBentQuad) {
  // The triangles' normals: (0, -1, 1) and (-1, 0, 1), at 60 degrees; over the other diagonal (0, 0, 1) and
  // (-1, -1, 1), at acos(1 / root 3), less.
  EXPECT_NEAR(value(Criterion::warp, bent), 60, 1e-12);
  // Middles: (0.5, 1, 0.5) - (0.5, 0, 0) and (1, 0.5, 0.5) - (0, 0.5, 0), both (.., .., 0.5).
  const double cosine = 0.25 / 1.25;
  EXPECT_NEAR(value(Criterion::skew, bent), 90 - std::acos(cosine) * 180 / pi, 1e-12);
}

TEST(Criteria, OfTheConcaveQuad) {
  // At the reflex corner the sides run to (0.75, -0.25) and (-0.25, 0.75).
  const double inner = std::acos((2 * 0.75 * -0.25) / (0.625)) * 180 / pi;
  EXPECT_NEAR(value(Criterion::angle_max, arrow), 360 - inner, 1e-9);
  EXPECT_LT(value(Criterion::jacobian_ratio, arrow), 0.6);
}

TEST(Criteria, SidesAreTooShortUnderHalfTheLeastSize) {
  ShellMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 0.4, 0}, {0, 0.4, 0}};
  mesh.quads = {{0, 1, 2, 3}};
  const auto failing = [&](double least) {
    mesh.size_min = least;
    return check_criteria(mesh, limits_of(mesh)).failing_by[static_cast<std::size_t>(Criterion::min_length)];
  };
  EXPECT_EQ(failing(0), 0);
  EXPECT_EQ(failing(0.79), 0);
  EXPECT_EQ(failing(0.81), 1);
  EXPECT_DOUBLE_EQ(limits_of(mesh).severity(Criterion::min_length, 0.2025), 2);
  EXPECT_EQ(check_criteria(mesh, limits_of(mesh)).worst.at(0).value, 0.4);
}

TEST(Criteria, DoNotDependOnOrientationOrFirstCorner) {
  const std::array<Vector3, 4> quad{{{0, 0, 0.1}, {2, 0.3, 0}, {1.7, 1, 0.3}, {-0.2, 1.4, 0}}};
  const CriteriaValues values = measure_criteria(quad[0], quad[1], quad[2], quad[3]);
  const CriteriaValues turned = measure_criteria(quad[1], quad[2], quad[3], quad[0]);
  const CriteriaValues mirrored = measure_criteria(quad[3], quad[2], quad[1], quad[0]);
  for (std::size_t i = 0; i < criterion_count; ++i) {
    EXPECT_NEAR(turned[i], values[i], 1e-12) << criteria_info[i].name;
    EXPECT_NEAR(mirrored[i], values[i], 1e-12) << criteria_info[i].name;
  }
}

TEST(Criteria, SeverityIsOneAtTheLimit) {
  const CriteriaLimits limits;
  for (std::size_t i = 0; i < criterion_count; ++i) {
    const auto criterion = static_cast<Criterion>(i);
    if (criterion == Criterion::min_length) continue;  // has no limit of its own
    EXPECT_DOUBLE_EQ(limits.severity(criterion, criteria_info[i].usual_limit), 1);
    EXPECT_DOUBLE_EQ(limits.severity(criterion, criteria_info[i].ideal), 0);
    EXPECT_FALSE(limits.fails(criterion, criteria_info[i].usual_limit));
    const double beyond = 1.01 * criteria_info[i].usual_limit - 0.01 * criteria_info[i].ideal;
    EXPECT_TRUE(limits.fails(criterion, beyond)) << criteria_info[i].name;
  }
}

TEST(Criteria, OfAMeshAreCountedByFaceAndWorstFirst) {
  ShellMesh mesh;  // the square, the sheared quad and the rectangle, apart
  const std::array<Vector3, 4> square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const auto& quad : {square, sheared, rectangle}) {
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), quad.begin(), quad.end());
    mesh.quads.push_back({first, first + 1, first + 2, first + 3});
  }
  mesh.quad_faces = {4, 4, 7};
  const CriteriaSummary usual = check_criteria(mesh);
  EXPECT_EQ(usual.quads, 3);
  EXPECT_EQ(usual.failing, 2);
  EXPECT_EQ(usual.outside, 2);
  EXPECT_EQ(usual.failing_by, (std::array<int, criterion_count>{1, 0, 1, 0, 0, 0, 0}));
  ASSERT_EQ(usual.faces.size(), 2u);
  EXPECT_EQ(usual.faces[0].face, 4);
  EXPECT_EQ(usual.faces[0].quads, 2);
  EXPECT_EQ(usual.faces[0].failing, 1);
  ASSERT_EQ(usual.worst.size(), 2u);
  EXPECT_EQ(usual.worst[0].quad, 2);  // 6 of 5 misses by a fourth, 45 of 40 degrees by an eighth
  EXPECT_EQ(usual.worst[0].criterion, Criterion::aspect);
  EXPECT_DOUBLE_EQ(usual.worst[0].value, 6);
  EXPECT_EQ(usual.worst[1].face, 4);
  EXPECT_EQ(usual.worst[1].criterion, Criterion::skew);

  CriteriaLimits other;
  other.values[static_cast<std::size_t>(Criterion::skew)] = CriteriaLimits::unchecked;
  const CriteriaSummary unskewed = check_criteria(mesh, other, 0);
  EXPECT_EQ(unskewed.failing, 1);
  EXPECT_TRUE(unskewed.worst.empty());
}

TEST(Criteria, WarpAloneIsCountedApart) {
  ShellMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.3}, {0, 1, 0}};
  mesh.quads = {{0, 1, 2, 3}};
  const CriteriaSummary summary = check_criteria(mesh);
  EXPECT_EQ(summary.failing, 1);
  EXPECT_EQ(summary.outside, 0);
}

}  // namespace
}  // namespace quadrille
