#include "mesher/adapt/adapt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/sizing/size_file.hpp"
#include "mesher/adapt/error_estimate.hpp"
#include "mesher/adapt/shell_stress.hpp"
#include "mesher/io/result_reader.hpp"

namespace quadrille {

namespace {

void check(const ShellMesh& mesh, const AdaptOptions& options) {
  if (!mesh.triangles.empty() || mesh.quads.empty())
    throw failure("", "the mesh has to consist of quads to be adapted");
  if (options.count == 0 && !(options.error > 0 && options.error < 1))
    throw usage_error("error",
                      fmt::format("the error wanted must be between 0 and 1, not {:g}", options.error));
  if (options.count < 0 || !std::isfinite(options.count))
    throw usage_error("count",
                      fmt::format("the number of elements must be positive, not {:g}", options.count));
  if (!(options.poisson >= 0 && options.poisson < 0.5))
    throw usage_error("poisson", fmt::format("Poisson's ratio must be at least 0 and below 0.5, not {:g}",
                                             options.poisson));
  if (!(options.growth > 0)) throw usage_error("growth", "the growth must be a positive number");
  if (options.size_max > 0 && options.size_min > options.size_max)
    throw usage_error("size_min", "the least size must be at most the largest");
}

/// Whether points move by different ways.
bool deforms(const SolverResult& result) {
  constexpr double rounding = 1e-9;
  const Vector3& first = result.displacements.front();
  return std::any_of(result.displacements.begin(), result.displacements.end(), [&](const Vector3& moved) {
    return (moved - first).norm() > rounding * (moved.norm() + first.norm());
  });
}

/// Points on a quad, no farther apart than its size.
void cover(const ShellMesh& mesh, int quad, double size, std::vector<SizePoint>& points) {
  const auto corner = [&](int k) { return mesh.points[mesh.quads[quad][k]]; };
  const double longest = std::max({(corner(1) - corner(0)).norm(), (corner(2) - corner(1)).norm(),
                                   (corner(3) - corner(2)).norm(), (corner(0) - corner(3)).norm()});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / size)), 1, 32);
  for (int k = 0; k < n * n; ++k) {
    const double x = (k % n + 0.5) / n, y = (k / n + 0.5) / n;
    points.push_back(
        {(1 - y) * ((1 - x) * corner(0) + x * corner(1)) + y * ((1 - x) * corner(3) + x * corner(2)), size});
  }
}

}  // namespace

AdaptResult adapt(const ShellMesh& mesh, const std::filesystem::path& solution,
                  const std::filesystem::path& sizes, const AdaptOptions& options,
                  ExecutionContext& context) {
  check(mesh, options);
  const std::string name = solution.string();
  const SolverResult result = read_result(solution);
  if (!deforms(result)) throw failure(name, fmt::format("{} holds no stresses: nothing is deformed", name));
  const auto stresses = shell_stresses(mesh, result, options.poisson, name);
  const ErrorEstimate estimate = estimate_error(mesh, stresses, options.poisson);
  context.check();
  std::vector<double> wanted =
      sizes_for(mesh, estimate, {options.count > 0 ? 0 : options.error, options.count});
  const double most = options.size_max > 0 ? options.size_max : std::numeric_limits<double>::infinity();
  for (double& size : wanted) size = std::clamp(size, options.size_min, most);
  std::vector<SizePoint> points;
  for (std::size_t quad = 0; quad < wanted.size(); ++quad)
    cover(mesh, static_cast<int>(quad), wanted[quad], points);
  write_sizes(points, options.growth, sizes, context);
  const auto [least, largest] = std::minmax_element(wanted.begin(), wanted.end());
  return {estimate.relative(), static_cast<int>(mesh.quads.size()), count_for(mesh, wanted), *least,
          *largest};
}

}  // namespace quadrille
