/// Peaks of stress, and how they change from mesh to mesh.

#include "mesher/adapt/peak_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/solved_plates.hpp"

namespace quadrille {
namespace {

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

}  // namespace
}  // namespace quadrille
