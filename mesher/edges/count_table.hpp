#pragma once
/// The wanted number of segments of an edge, and the places of its nodes. Internal.

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"

namespace quadrille {

/// Where a value lies in an ascending table.
struct TablePlace {
  std::size_t interval;  ///< index of the entry before it
  double share;          ///< of the way to the next entry
};

inline TablePlace place_in(const std::vector<double>& table, double value) {
  const auto it = std::ranges::lower_bound(table, value);
  const std::size_t i = std::clamp<std::size_t>(it - table.begin(), 1, table.size() - 1) - 1;
  const double span = table[i + 1] - table[i];
  return {i, span > 0 ? std::clamp((value - table[i]) / span, 0.0, 1.0) : 0.5};
}

/// The way along a line to each of its points, as a share of its length.
inline std::vector<double> shares_along(const std::vector<Vector3>& line) {
  std::vector<double> shares{0};
  for (std::size_t i = 1; i < line.size(); ++i)
    shares.push_back(shares.back() + (line[i] - line[i - 1]).norm());
  for (double& share : shares) share /= std::max(shares.back(), std::numeric_limits<double>::min());
  return shares;
}

/// The wanted number of segments from the edge's start, as a function of the parameter.
struct CountTable {
  std::vector<double> parameters;
  std::vector<double> counts;   // integral of ds / size from the start
  std::vector<double> lengths;  // arc length from the start
  double turning = 0;           // total change of direction, radians
  double total() const { return counts.empty() ? 0 : counts.back(); }

  double length() const { return lengths.empty() ? 0 : lengths.back(); }

  double parameter_at(double count) const { return interpolate(counts, count, parameters); }
  double parameter_at_length(double length) const { return interpolate(lengths, length, parameters); }
  double length_at(double count) const { return interpolate(counts, count, lengths); }
  double count_at_length(double length) const { return interpolate(lengths, length, counts); }

  /// Scales the count between two parameters up to `least`; the rest of the edge keeps its count.
  void make_finer(double from, double to, double least);

  /// Raises the number of segments per unit of length to at least `density` everywhere.
  void raise_to(double density);

 private:
  static double interpolate(const std::vector<double>& from, double at, const std::vector<double>& to) {
    const auto [i, share] = place_in(from, at);
    return to[i] + share * (to[i + 1] - to[i]);
  }
};

/// Throws Error (usage) if the number of segments exceeds the budget.
/// \param edge the last edge counted, which the message names.
void hold_segments(double segments, const Budget& budget, const CadEdge& edge);

/// Tabulates an edge by its arc length and the sizing field. The samples are at most half the local size
/// apart. Throws Error (usage) if the edge takes more segments than the field's budget allows.
/// \param by_shape whether its curvature requests sizes along it
CountTable tabulate(const CadEdge& edge, bool by_shape, SizingField::Sampler& size_at);

}  // namespace quadrille
