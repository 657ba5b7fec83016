/// Counts grids by their rows, and other faces by the integral of 1 / size^2 with a rim of smaller quads.

#include "mesher/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/faces/face_grid.hpp"
#include "mesher/settings.hpp"
#include "mesher/stages/stages.hpp"

namespace quadrille {

namespace {

/// The quads that the sizes and the edge segments imply for a face.
struct FaceDemand {
  double wanted = 0;  ///< integral of 1 / size^2
  double quads = 0;   ///< the same with quads that grow from the segments
  int border = 0;     ///< segments
};

/// Further quads for each length of a border where quads grow inward from `side` to `size` in place of having
/// that size everywhere: the integral of 1 / (side + growth x)^2 - 1 / size^2. \param depth of the face
double in_margin(double side, double size, double growth, double depth) {
  if (!(side < size)) return 0;
  constexpr double fastest = 0.2;  // measured: quads grow no faster from a fine border, even if allowed
  growth = std::min(growth, fastest);
  const double reach = std::min(depth, (size - side) / growth);
  return reach / (side * (side + growth * reach)) - reach / (size * size);
}

FaceDemand demand_of(FaceId id, const CadFace& face, const std::vector<FaceSample>& samples,
                     SizingField::Sampler& size_at, double growth, const BoundaryNodes& nodes) {
  FaceDemand result;
  double area = 0, length = 0, coarse = 0;
  for (const FaceSample& sample : samples) {
    const double size = size_at(sample.point);
    area += sample.area;
    result.wanted += sample.area / (size * size_at.across(size, sample.curvature));
    coarse = std::max(coarse, size);
  }
  const auto for_each_segment = [&](const auto& act) {
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) {
        const auto& at = nodes.edges[coedge.edge].nodes;
        for (std::size_t i = 1; i < at.size() && !nodes.left_out.contains({id, coedge.edge}); ++i)
          act(nodes.points[at[i - 1]], nodes.points[at[i]]);
      }
    }
  };
  for_each_segment([&](const Vector3& a, const Vector3& b) {
    ++result.border;
    length += (b - a).norm();
  });
  // Two lower bounds. The samples miss margins narrower than their spacing; the other bound covers only
  // margins. The first already includes the sizes at the border.
  const double depth = length > 0 ? area / length : 0;
  double sampled = result.wanted, with_margins = coarse > 0 ? area / (coarse * coarse) : 0;
  for_each_segment([&](const Vector3& a, const Vector3& b) {
    const double side = (b - a).norm(), size = size_at(0.5 * (a + b));
    sampled += side * in_margin(side, size, growth, depth);
    with_margins += side * in_margin(std::min(side, size), coarse, growth, depth);
  });
  result.quads = std::max(sampled, with_margins);
  return result;
}

double expected_quads(const FaceDemand& demand, double in_grid, bool keeps_grid) {
  // The narrowest strip has two rows of quads, with ends of two sides each.
  const double others = std::max({4.0, demand.border - 4.0, demand.quads});
  if (!(in_grid > 0)) return others;
  return keeps_grid ? in_grid : expected_with_grid(in_grid, others, demand.wanted, demand.border);
}

}  // namespace

QuadEstimate::QuadEstimate(const CadModel& model, ExecutionContext& context)
    : model_(model), context_(context) {
  const FaceFlags all(model.face_count(), 1);
  on_threads(context.threads(), [&] { samples_ = sample_faces(model.shape(), all, context); });
}

double QuadEstimate::quads(const MeshOptions& options) {
  check({options, {}}, model_);
  try {
    const std::vector<double> counts = quads_by_face(options);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::usage) throw;
    return std::numeric_limits<double>::infinity();
  }
}

std::vector<double> QuadEstimate::quads_by_face(const MeshOptions& options) {
  return on_threads(context_.threads(), [&] {
    const SettledBoundary boundary = settle_boundary(model_, options, context_);
    FaceSamples samples = samples_;
    for (const FaceId id : samples.ids()) {
      const FaceId whole = boundary.simple.taken_by[id];
      if (whole.exists())
        samples[whole].insert(samples[whole].end(), samples_[id].begin(), samples_[id].end());
    }
    std::vector<double> counts(samples.size(), 0);
    for (const FaceId id : samples.ids()) {
      if (!boundary.meshed[id]) continue;
      const CadFace& face = boundary.model.shape().faces[id];
      const BoundaryNodes& nodes = boundary.nodes;
      SizingField::Sampler size_at(boundary.field, id);
      const FacePlan& plan = nodes.plans[id];
      counts[id.index()] =
          expected_quads(demand_of(id, face, samples[id], size_at, options.sizing.growth, nodes),
                         plan.grid_quads, plan.has_kept_edge || plan.has_divided_edge);
    }
    return counts;
  });
}

QuadEstimate::Suggestion QuadEstimate::size_for(double quads, MeshOptions options) {
  constexpr int most_steps = 12;
  constexpr double close = 1.05;   // well within the error of the estimate
  constexpr double narrow = 1.02;  // ratio of sizes between which the count jumps
  const auto rounded = [](double size) { return std::stod(fmt::format("{:.3g}", size)); };
  const auto error = [&](const Suggestion& one) { return std::abs(std::log(one.quads / quads)); };
  const double largest = rounded(0.1 * model_.diagonal());
  double area = 0;
  for (const auto& face : samples_) {
    for (const FaceSample& sample : face) area += sample.area;
  }
  for (int step = 0;; ++step) {
    Suggestion best, fine, coarse;  // the sizes on either side of the wanted one
    for (const auto& [size, count] : tried_) {
      const Suggestion one{size, count};
      if (best.size == 0 || error(one) < error(best)) best = one;
      if (count > quads) fine = one;
      if (count <= quads && coarse.size == 0) coarse = one;
    }
    if (step == most_steps || fine.size >= largest) return best;
    if (best.size > 0 && error(best) < std::log(close)) return best;
    double size = std::min(largest, std::sqrt(area / quads));
    if (fine.size > 0 && coarse.size > 0) {
      if (coarse.size < narrow * fine.size) return best;
      const double share = std::isfinite(fine.quads)
                               ? std::log(fine.quads / quads) / std::log(fine.quads / coarse.quads)
                               : 0.5;
      size = fine.size * std::pow(coarse.size / fine.size, std::clamp(share, 0.1, 0.9));
    } else if (fine.size > 0) {
      // Counts fall at most with the square of the size, so this step is too long rather than too short.
      size = std::min(largest, fine.size * (std::isfinite(fine.quads) ? fine.quads / quads : 2));
    } else if (coarse.size > 0) {
      size = std::min(size, coarse.size * coarse.quads / quads);
    }
    options.sizing.size = rounded(size);
    if (tried_.contains(options.sizing.size)) return best;
    tried_[options.sizing.size] = this->quads(options);
  }
}

}  // namespace quadrille
