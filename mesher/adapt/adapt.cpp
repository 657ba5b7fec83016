/// Searches for sizes that spread the error evenly, judging each draft by the sizing field made from it.

#include "mesher/adapt/adapt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "geometry/sizing/size_cascade.hpp"
#include "geometry/sizing/size_file.hpp"
#include "mesher/adapt/error_estimate.hpp"
#include "mesher/adapt/shell_stress.hpp"
#include "mesher/io/result_reader.hpp"

namespace quadrille {

namespace {

void check(const ShellMesh& mesh, const AdaptOptions& options) {
  if (!mesh.triangles.empty() || mesh.quads.empty())
    throw failure("", "the mesh has to consist of quads to be adapted");
  const auto hold = [](const char* name, const NumberRule& rule, double value) {
    if (!rule.allows(value))
      throw usage_error(name, fmt::format("{} must be {}, not {:g}", name, rule.sentence(), value));
  };
  if (options.count == 0) hold("error", AdaptOptions::error_rule, options.error);
  hold("count", {}, options.count);
  hold("poisson", AdaptOptions::poisson_rule, options.poisson);
  hold("growth", positive, options.growth);
  hold("size_min", {}, options.size_min);
  hold("size_max", {}, options.size_max);
  if (options.size_max > 0 && options.size_min > options.size_max)
    throw usage_error("size_min", "the least size must be at most the largest");
}

/// Whether the displacements differ from point to point.
bool deforms(const SolverResult& result) {
  constexpr double rounding = 1e-9;
  const Vector3& first = result.displacements.front();
  return std::ranges::any_of(result.displacements, [&](const Vector3& moved) {
    return (moved - first).norm() > rounding * (moved.norm() + first.norm());
  });
}

/// Sizes that distribute an error evenly, as represented by the field that is written. The error of stresses
/// is proportional to the size of elements to the power of their order.
class SizePlan {
 public:
  SizePlan(const ShellMesh& mesh, const ErrorEstimate& estimate, const AdaptOptions& options,
           ExecutionContext& context)
      : mesh_(mesh),
        estimate_(estimate),
        options_(options),
        context_(context),
        now_(sizes_of(mesh)),
        even_(even_sizes(mesh, estimate)),
        singular_(singular_corners(mesh, estimate)),
        at_points_(means_at_nodes(corners_by_node(mesh.points.size(), mesh.quads),
                                  [&](Side corner) { return now_[element_of(corner)]; })) {
    double sum = 0, corners = 0;
    for (std::size_t node = 0; node < at_points_.size(); ++node) {
      if (at_points_[node] == 0) continue;
      sum += std::log(at_points_[node] / even_[node]);
      ++corners;
    }
    // The search starts with sizes that have the same geometric mean as the present ones.
    for (double& size : even_) size *= std::exp(sum / corners);
  }

  struct Draft {
    SizeCascade field;
    double count = 0, error = 0;  ///< expected number of elements and error of the next mesh
    double least = std::numeric_limits<double>::infinity(), largest = 0;  ///< smallest and largest size
  };

  /// The present sizes.
  Draft present() const {
    std::vector<SizePoint> points;
    for (std::size_t node = 0; node < at_points_.size(); ++node)
      if (at_points_[node] > 0) points.push_back({mesh_.points[node], at_points_[node]});
    Draft draft{mean_sizes(points, options_.growth, context_)};
    SizeCascade::Lookup size_at(draft.field);
    for (const SizePoint& at : points) {
      const double size = size_at(at.point);
      draft.least = std::min(draft.least, size);
      draft.largest = std::max(draft.largest, size);
    }
    draft.count = static_cast<double>(now_.size());
    draft.error = estimate_.relative();
    return draft;
  }

  /// Finds the sizes that reach the wanted count or error. Growth and the limit on changes alter the sizes,
  /// so each draft is judged by the sizes in its field.
  Draft find() const {
    constexpr int most_drafts = 12;
    constexpr double count_tolerance = 0.005;
    // The expected error is off by about a tenth, and an error just above the wanted one costs another round.
    constexpr double margin = 0.9;
    double factor = 1;
    for (int k = 1;; ++k) {
      Draft draft = of_factor(factor);
      const double step = options_.count > 0
                              ? std::sqrt(draft.count / options_.count)
                              : std::pow(margin * options_.error / draft.error, 1.0 / mesh_.order);
      if (k == most_drafts || std::abs(step - 1) < count_tolerance || !std::isfinite(step)) return draft;
      factor *= step;
    }
  }

 private:
  Draft of_factor(double factor) const {
    context_.check();
    std::vector<SizePoint> points;
    for_places(factor, [&](std::size_t, const Vector3& point, double size, double) {
      points.push_back({point, size});
    });
    Draft draft{mean_sizes(points, options_.growth, context_)};
    SizeCascade::Lookup size_at(draft.field);
    double square = 0;
    for_places(factor, [&](std::size_t quad, const Vector3& point, double, double share) {
      const double size = size_at(point), ratio = size / now_[quad];
      draft.count += share / (ratio * ratio);
      square += share * estimate_.squares[quad] * std::pow(ratio, 2 * mesh_.order);
      draft.least = std::min(draft.least, size);
      draft.largest = std::max(draft.largest, size);
    });
    // Only half of the gain from distributing the error is relied on (in the logarithm). Some of its
    // unevenness is noise, and near singular stresses smaller elements gain less than their order predicts.
    const double uniform =
        estimate_.relative() * std::pow(static_cast<double>(now_.size()) / draft.count, 0.5 * mesh_.order);
    draft.error = std::sqrt(std::sqrt(square / (estimate_.all + estimate_.sum())) * uniform);
    return draft;
  }

  /// Visits n x n points on each quad, spaced no wider than the sizes there, with n from 2 to 32:
  /// visit(quad, point, size, share of the quad's area).
  template <class Visit>
  void for_places(double factor, Visit&& visit) const {
    for (std::size_t quad = 0; quad < mesh_.quads.size(); ++quad) {
      std::array<Vector3, 4> corners;
      std::array<double, 4> sizes{};
      for (int k = 0; k < 4; ++k) {
        const int node = mesh_.quads[quad][k];
        corners[k] = mesh_.points[node];
        sizes[k] = size_at_corner(node, factor);
      }
      double longest = 0;
      for (int k = 0; k < 4; ++k) longest = std::max(longest, (corners[(k + 1) % 4] - corners[k]).norm());
      const double least = *std::ranges::min_element(sizes);
      const int n = to_int(std::clamp(std::ceil(longest / least), 2.0, 32.0));
      for (int k = 0; k < n * n; ++k) {
        const int column = k % n, row = k / n;
        const double x = (column + 0.5) / n, y = (row + 0.5) / n;
        const std::array<double, 4> weights{(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
        Vector3 point{0, 0, 0};
        double logarithm = 0;
        for (int i = 0; i < 4; ++i) {
          point += weights[i] * corners[i];
          logarithm += weights[i] * std::log(sizes[i]);
        }
        visit(quad, point, std::exp(logarithm), 1.0 / (n * n));
      }
    }
  }

  double size_at_corner(int node, double factor) const {
    constexpr double max_change = 4;  // largest factor by which a size changes in one round
    double ratio = factor * even_[node] / at_points_[node];
    // At singular stresses the square of a quad's error is at best proportional to the second power of its
    // size. That power is assumed.
    if (singular_[node] && ratio < 1) ratio = std::pow(ratio, mesh_.order + 1);
    const double size = at_points_[node] * std::clamp(ratio, 1 / max_change, max_change);
    const double largest =
        options_.size_max > 0 ? options_.size_max : std::numeric_limits<double>::infinity();
    return std::clamp(size, options_.size_min, largest);
  }

  const ShellMesh& mesh_;
  const ErrorEstimate& estimate_;
  const AdaptOptions& options_;
  ExecutionContext& context_;
  std::vector<double> now_;        // (quads) present sizes
  std::vector<double> even_;       // (points) wanted sizes, up to a common factor
  std::vector<char> singular_;     // (points) see singular_corners()
  std::vector<double> at_points_;  // (points) present sizes
};

}  // namespace

AdaptResult adapt(const ShellMesh& mesh, const std::filesystem::path& solution,
                  const std::filesystem::path& sizes, const AdaptOptions& options,
                  ExecutionContext& context) {
  check(mesh, options);
  const std::string name = solution.string();
  const SolverResult result = read_result(solution);
  if (!deforms(result))
    throw failure(name, fmt::format("{} has no stresses: all displacements are zero", name));
  const auto stresses = shell_stresses(mesh, result, options.poisson, name);
  const ErrorEstimate estimate = estimate_error(mesh, stresses, options.poisson);
  const bool is_met = options.count == 0 && estimate.relative() <= options.error;
  const SizePlan plan(mesh, estimate, options, context);
  const SizePlan::Draft draft = is_met ? plan.present() : plan.find();
  write_cascade(draft.field, sizes);
  const std::vector<StressPeak> peaks = stress_peaks(mesh, stresses);
  return {estimate.relative(), is_met,      static_cast<int>(mesh.quads.size()),
          draft.count,         draft.error, draft.least,
          draft.largest,       peaks,       changes_of_peaks(options.before, peaks)};
}

}  // namespace quadrille
