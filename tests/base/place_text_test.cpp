/// Numbers and places in messages: few digits, and no traces of rounding.

#include "geometry/base/place_text.hpp"

#include <gtest/gtest.h>

namespace quadrille {
namespace {

TEST(NumberText, HasFourDigits) {
  EXPECT_EQ(number_text(12.34567), "12.35");
  EXPECT_EQ(number_text(-0.000123456), "-0.0001235");
  EXPECT_EQ(number_text(2), "2");
}

TEST(NumberText, RoundingErrorsAreZero) {
  EXPECT_EQ(number_text(7.95592e-20), "0");
  EXPECT_EQ(number_text(-7.95592e-20), "0");
  EXPECT_EQ(number_text(3e-8, 100), "0");
  EXPECT_EQ(number_text(3e-8, 1), "3e-08");
  EXPECT_EQ(number_text(3e-8, -100), "0");
}

TEST(PlaceText, RoundingErrorsBesideOtherCoordinatesAreZero) {
  EXPECT_EQ(place_text({7.95592e-20, 1.5, -1e-12}), "(0, 1.5, 0)");
  EXPECT_EQ(place_text({0, 0, 0}), "(0, 0, 0)");
}

}  // namespace
}  // namespace quadrille
