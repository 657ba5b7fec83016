#pragma once
/// Which numbers an option or a setting takes: one check for all of them.

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace quadrille {

/// A range of numbers. Infinity and "not a number" lie in no range.
struct NumberRule {
  double low = 0;                                         ///< least value
  double high = std::numeric_limits<double>::infinity();  ///< largest value
  bool above_low = false;                                 ///< the value `low` itself is not allowed
  bool whole = false;                                     ///< only whole numbers
  bool below_high = false;                                ///< the value `high` itself is not allowed

  /// Whether the value lies in the range.
  bool allows(double value) const {
    return std::isfinite(value) && (above_low ? value > low : value >= low) &&
           (below_high ? value < high : value <= high) && (!whole || value == std::floor(value));
  }

  /// "a positive number", "a whole number of at least 0 and at most 4096".
  std::string sentence() const {
    const char* what = whole ? "a whole number" : "a number";
    if (low == 0 && above_low && std::isinf(high)) return "a positive number";
    const std::string from = fmt::format("{} {} {:g}", what, above_low ? "above" : "of at least", low);
    if (above_low && below_high) return fmt::format("{} between {:g} and {:g}", what, low, high);
    return std::isinf(high) ? from
                            : fmt::format("{} and {} {:g}", from, below_high ? "below" : "at most", high);
  }
};

/// Numbers above zero.
constexpr NumberRule positive{.above_low = true};

}  // namespace quadrille
