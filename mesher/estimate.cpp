#include "mesher/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/settings.hpp"

namespace quadrille {

namespace {

/// The rows of quads of a face with four sides, the fewer of both ways; 0 for other faces.
int fewest_rows(const CadFace& face, const FaceSides& sides, const BoundaryNodes& nodes) {
  if (sides.outline != FaceSides::Outline::four || sides.starts.size() != 4 || face.wires.size() != 1)
    return 0;
  const auto& coedges = face.wires.front().coedges;
  std::array<int, 4> counts{};
  for (std::size_t side = 0; side < counts.size(); ++side) {
    std::size_t i = sides.starts[side];
    do {
      counts[side] += std::max(0, nodes.edges[coedges[i].edge - 1].segments());
      i = (i + 1) % coedges.size();
    } while (static_cast<int>(i) != sides.starts[(side + 1) % counts.size()]);
  }
  const bool is_grid = counts[0] == counts[2] && counts[1] == counts[3];
  return is_grid ? std::min(counts[0], counts[1]) : 0;
}

}  // namespace

QuadEstimate::QuadEstimate(const CadModel& model, ExecutionContext& context)
    : model_(model), context_(context) {
  const std::vector<char> all(model.face_count(), 1);
  on_threads(context.threads(), [&] { samples_ = sample_faces(model.shape(), all, context); });
}

double QuadEstimate::quads(const MeshOptions& options) {
  check({options, {}}, model_);
  const CadShape& shape = model_.shape();
  try {
    return on_threads(context_.threads(), [&] {
      const SizingField field = SizingField::build(model_, options.sizing, context_);
      SamplingPlan plan(shape);
      plan.prescribed = prescribed_edges(shape, options.sizing, field.size_max());
      const BoundaryNodes nodes = sample_edges(shape, field, stride(options.strategy),
                                               std::vector<char>(shape.faces.size(), 1), plan, context_);
      double count = 0;
      for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        SizingField::Sampler size_at(field, static_cast<int>(face));
        double inside = 0, border = 0;
        for (const FaceSample& sample : samples_[face])
          inside += sample.area / std::pow(size_at(sample.point), 2);
        for (const CadWire& wire : shape.faces[face].wires) {
          for (const Coedge& coedge : wire.coedges)
            border += std::max(0, nodes.edges[coedge.edge - 1].segments());
        }
        // The narrowest strip has two rows of quads, with ends of two sides each; but a grid may have one.
        const int rows = fewest_rows(shape.faces[face], nodes.sides[face], nodes);
        count += rows == 1 ? std::max(1.0, 0.5 * border - 1) : std::max({4.0, border - 4, inside});
      }
      return count;
    });
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::usage) throw;
    return std::numeric_limits<double>::infinity();
  }
}

QuadEstimate::Suggestion QuadEstimate::size_for(double quads) {
  constexpr int most_steps = 24;
  constexpr double close = 1.02;
  const auto rounded = [](double size) { return std::stod(fmt::format("{:.3g}", size)); };
  double low = 0, high = 0.1 * model_.diagonal(), area = 0;  // sizes that give too many quads, and too few
  for (const auto& face : samples_) {
    for (const FaceSample& sample : face) area += sample.area;
  }
  Suggestion best;
  double size = std::min(high, std::sqrt(area / quads));
  for (int step = 0; step < most_steps; ++step) {
    size = rounded(size);
    MeshOptions options;
    options.sizing.size = size;
    const double count = this->quads(options);
    const bool better =
        best.size == 0 || std::abs(std::log(count / quads)) < std::abs(std::log(best.quads / quads));
    if (better) best = {size, count};
    if (std::max(count / quads, quads / count) < close || size == low || size == high) break;
    (count > quads ? low : high) = size;
    // Counts fall with the square of the size at most.
    const double guess = std::isfinite(count) ? size * std::sqrt(count / quads) : 2 * size;
    size = low > 0 ? std::clamp(guess, low + 0.1 * (high - low), high - 0.1 * (high - low))
                   : std::min(guess, high);
  }
  return best;
}

}  // namespace quadrille
