/// Computed numbers that become integers.

#include "geometry/base/whole_number.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadrille {
namespace {

TEST(WholeNumber, IsTheNumberWithoutItsFraction) {
  EXPECT_EQ(to_int(2.9), 2);
  EXPECT_EQ(to_int(-2.9), -2);
  EXPECT_EQ(round_to_int(2.5), 3);
  EXPECT_EQ(round_to_int(-2.5), -3);
}

TEST(WholeNumber, RefusesWhatDoesNotFit) {
  for (const double value : {1e15, -1e15, 3e9, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(to_int(value), Error) << value;
    EXPECT_THROW(round_to_int(value), Error) << value;
  }
}

}  // namespace
}  // namespace quadrille
