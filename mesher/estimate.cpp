/// Counts grids by their rows, and other faces by the integral of 1 / size^2 with a rim of smaller quads.

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
#include "mesher/boundary.hpp"
#include "mesher/edges/hole_filling.hpp"
#include "mesher/settings.hpp"

namespace quadrille {

namespace {

/// The number of quads of a four-sided face whose opposite sides have as many segments; 0 for other faces.
double grid_quads(const CadFace& face, const FaceSides& sides, const BoundaryNodes& nodes) {
  if (sides.outline != FaceSides::Outline::four || sides.starts.size() != 4 || face.wires.size() != 1)
    return 0;
  const auto& coedges = face.wires.front().coedges;
  std::array<int, 4> counts{};
  for (std::size_t side = 0; side < counts.size(); ++side) {
    std::size_t i = sides.starts[side];
    do {
      counts[side] += std::max(0, nodes.edges[coedges[i].edge].segments());
      i = (i + 1) % coedges.size();
    } while (static_cast<int>(i) != sides.starts[(side + 1) % counts.size()]);
  }
  const bool is_grid = counts[0] == counts[2] && counts[1] == counts[3];
  return is_grid ? static_cast<double>(counts[0]) * counts[1] : 0;
}

/// The number of quads of a face that is not a grid. \param inside integral of 1 / size^2 over the face.
double free_quads(const CadFace& face, double area, double inside, double growth,
                  const BoundaryNodes& nodes) {
  int border = 0;
  double length = 0;
  const auto for_each_segment = [&](const auto& act) {
    for (const CadWire& wire : face.wires) {
      for (const Coedge& coedge : wire.coedges) {
        const auto& at = nodes.edges[coedge.edge].nodes;
        for (std::size_t i = 1; i < at.size(); ++i)
          act((nodes.points[at[i]] - nodes.points[at[i - 1]]).norm());
      }
    }
  };
  for_each_segment([&](double side) {
    ++border;
    length += side;
  });
  // Quads grow inward from short sides at the border up to the wanted size. Within that depth, at most the
  // depth of the face, integrate side / (side + growth x)^2 in place of side / size^2.
  const double depth = length > 0 ? area / length : 0, size = std::sqrt(area / inside);
  double shorter = 0;
  for_each_segment([&](double side) {
    if (!(side < size)) return;
    const double reach = std::min(depth, (size - side) / growth);
    shorter += reach / (side + growth * reach) - reach * side / (size * size);
  });
  // The narrowest strip has two rows of quads, with ends of two sides each.
  return std::max({4.0, border - 4.0, inside + shorter});
}

}  // namespace

QuadEstimate::QuadEstimate(const CadModel& model, ExecutionContext& context)
    : model_(model), context_(context) {
  const FaceFlags all(model.face_count(), 1);
  on_threads(context.threads(), [&] { samples_ = sample_faces(model.shape(), all, context); });
}

double QuadEstimate::quads(const MeshOptions& options) {
  check({options, {}}, model_);
  const FilledModel filled =
      fill_holes(model_, faces_used(model_, options), options.sizing, options.fill_holes);
  const CadShape& shape = filled.model.shape();
  const FaceFlags used = filled.left(faces_used(model_, options));
  try {
    return on_threads(context_.threads(), [&] {
      const SettledBoundary boundary = settle_boundary(model_, options, context_);
      double count = 0;
      for (const FaceId face : shape.faces.ids()) {
        if (!used[face]) continue;
        SizingField::Sampler size_at(boundary.field, face);
        const double in_grid = grid_quads(shape.faces[face], boundary.nodes.sides[face], boundary.nodes);
        double area = 0, inside = 0;
        for (const FaceSample& sample : samples_[face]) {
          area += sample.area;
          inside += sample.area / std::pow(size_at(sample.point), 2);
        }
        count += in_grid > 0
                     ? in_grid
                     : free_quads(shape.faces[face], area, inside, options.sizing.growth, boundary.nodes);
      }
      return count;
    });
  } catch (const Error& error) {
    if (error.kind() != Error::Kind::usage) throw;
    return std::numeric_limits<double>::infinity();
  }
}

QuadEstimate::Suggestion QuadEstimate::size_for(double quads) {
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
    MeshOptions options;
    options.sizing.size = rounded(size);
    if (tried_.contains(options.sizing.size)) return best;
    tried_[options.sizing.size] = this->quads(options);
  }
}

}  // namespace quadrille
