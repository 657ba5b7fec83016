#pragma once
/// How many segments an edge wants, and where its nodes go. Internal.

#include <algorithm>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"

namespace quadrille {

/// The wanted number of segments as a function of the parameter.
struct CountTable {
  std::vector<double> parameters;
  std::vector<double> counts;   // integral of ds / size from the start
  std::vector<double> lengths;  // of the arc from the start
  double turning = 0;           // total change of direction, radians
  double total() const { return counts.empty() ? 0 : counts.back(); }

  double length() const { return lengths.empty() ? 0 : lengths.back(); }

  double parameter_at(double count) const { return interpolate(counts, count, parameters); }
  double parameter_at_length(double length) const { return interpolate(lengths, length, parameters); }
  double count_at_length(double length) const { return interpolate(lengths, length, counts); }

  /// Raises the count between two parameters to `least`, evenly; the rest of the edge keeps its own.
  void make_finer(double from, double to, double least);

  /// Makes it at least so many segments to a length everywhere.
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

/// Throws Error (usage) if so many segments are more than the budget has.
/// \param edge the last one counted.
void hold_segments(double segments, const Budget& budget, const CadEdge& edge);

/// Tabulates an edge by its arc length and the sizing field, as finely as the size asks for. Throws Error
/// (usage) if it takes more segments than the field's budget has.
CountTable tabulate(const CadEdge& edge, SizingField::Sampler& size_at);

}  // namespace quadrille
