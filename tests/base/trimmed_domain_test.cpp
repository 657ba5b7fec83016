/// Points inside and outside planar domains.

#include "geometry/base/trimmed_domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace quadrille {
namespace {

TEST(TrimmedDomain, TellsInsideFromOutsideAndFromHoles) {
  std::vector<TrimmedDomain::Segment> segments;
  const auto add_circle = [&](double radius, int n) {
    for (int i = 0; i < n; ++i) {
      const double a = 2 * M_PI * i / n, b = 2 * M_PI * (i + 1) / n;
      segments.push_back(
          {radius * Vector2(std::cos(a), std::sin(a)), radius * Vector2(std::cos(b), std::sin(b))});
    }
  };
  add_circle(3, 97);
  add_circle(1, 41);
  const TrimmedDomain domain(segments);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-4, 4);
  for (int i = 0; i < 20000; ++i) {
    const Vector2 p(coordinate(random), coordinate(random));
    const double r = p.norm();
    if (std::abs(r - 3) < 0.01 || std::abs(r - 1) < 0.01) continue;
    EXPECT_EQ(domain.inside(p), r > 1 && r < 3) << p.transpose();
  }
  EXPECT_FALSE(TrimmedDomain().inside({0, 0}));
}

}  // namespace
}  // namespace quadrille
