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
  std::vector<double> counts;  // integral of ds / size from the start
  double turning = 0;          // total change of direction, radians
  double total() const { return counts.empty() ? 0 : counts.back(); }

  double parameter_at(double count) const {
    const auto it = std::lower_bound(counts.begin(), counts.end(), count);
    const std::size_t i = std::clamp<std::size_t>(it - counts.begin(), 1, counts.size() - 1);
    const double span = counts[i] - counts[i - 1];
    const double t = span > 0 ? std::clamp((count - counts[i - 1]) / span, 0.0, 1.0) : 0.5;
    return parameters[i - 1] + t * (parameters[i] - parameters[i - 1]);
  }
};

/// Throws Error (usage) if so many segments are more than the budget has.
/// \param edge the last one counted.
void hold_segments(double segments, const Budget& budget, const CadEdge& edge);

/// Tabulates an edge by its arc length and the sizing field, as finely as the size asks for. Throws Error
/// (usage) if it takes more segments than the field's budget has.
CountTable tabulate(const CadEdge& edge, SizingField::Sampler& size_at);

}  // namespace quadrille
