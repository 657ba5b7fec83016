#pragma once
/// Conversion of computed numbers to integers. Internal.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

/// The value without its fraction, as static_cast does it, but with every value defined. Throws Error
/// (failure) if it does not fit an int: a count that large comes from damaged geometry, and a loop over it
/// would not end.
inline int to_int(double value) {
  constexpr double largest_int = std::numeric_limits<int>::max();
  if (!(std::abs(value) < largest_int))
    throw failure("", fmt::format("a count of {:g} was computed: the geometry there may be damaged", value));
  return static_cast<int>(value);
}

/// The nearest integer, halves away from zero. Throws as to_int() does.
inline int round_to_int(double value) {
  return to_int(std::round(value));
}

/// The cell, of `count` from 0, that a place counted in cells falls into; the first or the last one for
/// places beyond, and the first for what is no number.
inline int cell_at(double place, int count) {
  return place > 0 ? static_cast<int>(std::min(place, count - 1.0)) : 0;
}

}  // namespace quadrille
