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

TEST(WholeNumber, CellsAreWithinTheirRange) {
  EXPECT_EQ(cell_at(0.5, 4), 0);
  EXPECT_EQ(cell_at(3.9, 4), 3);
  for (const double value : {4.0, 5.7e9, HUGE_VAL}) EXPECT_EQ(cell_at(value, 4), 3) << value;
  for (const double value : {-0.1, -5.7e9, -HUGE_VAL, std::nan("")}) EXPECT_EQ(cell_at(value, 4), 0) << value;
}

}  // namespace
}  // namespace quadrille
