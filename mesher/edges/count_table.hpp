#pragma once
/// The wanted number of segments of an edge, and the places of its nodes. Internal.

#include <algorithm>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"

namespace quadrille {

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
    const auto it = std::lower_bound(from.begin(), from.end(), at);
    const std::size_t i = std::clamp<std::size_t>(it - from.begin(), 1, from.size() - 1);
    const double span = from[i] - from[i - 1];
    const double t = span > 0 ? std::clamp((at - from[i - 1]) / span, 0.0, 1.0) : 0.5;
    return to[i - 1] + t * (to[i] - to[i - 1]);
  }
};

/// Throws Error (usage) if the number of segments exceeds the budget.
/// \param edge the last edge counted, which the message names.
void hold_segments(double segments, const Budget& budget, const CadEdge& edge);

/// Tabulates an edge by its arc length and the sizing field. The samples are at most half the local size
/// apart. Throws Error (usage) if the edge takes more segments than the field's budget allows.
CountTable tabulate(const CadEdge& edge, SizingField::Sampler& size_at);

}  // namespace quadrille
