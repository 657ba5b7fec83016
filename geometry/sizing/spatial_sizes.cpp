/// Distances to regions, the text of point files, and what points request at a place.

#include "geometry/sizing/spatial_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "geometry/base/file_access.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/place_text.hpp"
#include "geometry/base/text_parts.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/vdb_module.hpp"

namespace quadrille {

namespace {

/// A slope slow enough that halving steps cannot miss a size.
constexpr double slope_of_hints = 0.3;

double distance_to_box(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (low - p).cwiseMax(p - high).cwiseMax(0).norm();
}

double distance_to_cylinder(const Vector3& p, const Vector3& start, const Vector3& end, double radius) {
  const Vector3 axis = (end - start).normalized();
  const double along = (p - start).dot(axis), length = (end - start).norm();
  const double beside = ((p - start) - along * axis).norm();
  return std::hypot(std::max({0.0, -along, along - length}), std::max(0.0, beside - radius));
}

bool reaches(const SizeRegion& region, const CadModel& model) {
  // Compares bounding boxes, so a region whose box alone reaches the model counts as reaching it.
  const Vector3 &low = model.box_min(), &high = model.box_max();
  const Vector3 radii = Vector3::Constant(region.radius);
  switch (region.shape) {
    case SizeRegion::Shape::box:
      return (region.a.array() <= high.array()).all() && (region.b.array() >= low.array()).all();
    case SizeRegion::Shape::sphere:
      return distance_to_box(region.a, low, high) <= region.radius;
    case SizeRegion::Shape::cylinder: {
      const Vector3 bottom = region.a.cwiseMin(region.b) - radii, top = region.a.cwiseMax(region.b) + radii;
      return (bottom.array() <= high.array()).all() && (top.array() >= low.array()).all();
    }
    case SizeRegion::Shape::half_space: {
      const Vector3 deepest = (region.b.array() > 0).select(high, low);
      return (deepest - region.a).dot(region.b) >= 0;
    }
  }
  return true;
}

/// The comma-separated numbers of a line; none if a field is not a number.
std::vector<double> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (const std::string_view field : split(line)) {
    const std::optional<double> value = exactly<double>(trimmed(field));
    if (!value) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace

double SizeRegion::distance(const Vector3& point) const {
  switch (shape) {
    case Shape::box:
      return distance_to_box(point, a, b);
    case Shape::sphere:
      return std::max(0.0, (point - a).norm() - radius);
    case Shape::cylinder:
      return distance_to_cylinder(point, a, b, radius);
    case Shape::half_space:
      return std::max(0.0, -(point - a).dot(b) / b.norm());
  }
  return 0;
}

std::vector<SizePoint> read_size_points(const std::filesystem::path& path) {
  require_readable(path);
  std::ifstream file(path);
  const auto refused = [&](std::size_t line, const std::string& what) {
    return failure(path.string(), fmt::format("{}: line {} {}", path.string(), line, what));
  };
  std::vector<SizePoint> points;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const bool is_header =
        number == 1 && numbers_of(std::string_view(line).substr(0, line.find(','))).empty();
    if (is_header) continue;
    const std::vector<double> values = numbers_of(line);
    if (values.size() != 4) throw refused(number, "is not x,y,z,size");
    if (!std::all_of(values.begin(), values.end() - 1, [](double value) { return std::isfinite(value); }))
      throw refused(number, "has a coordinate that is not a finite number");
    if (!std::isfinite(values[3]) || !(values[3] > 0))
      throw refused(number, fmt::format("has the size {:g}: sizes are positive numbers", values[3]));
    points.push_back({{values[0], values[1], values[2]}, values[3]});
  }
  if (points.empty()) throw failure(path.string(), fmt::format("{} holds no points", path.string()));
  return points;
}

SpatialSizes::SpatialSizes(const CadModel& model, const SizingOptions& options, const SizeLimits& limits,
                           BlockCount& blocks, ExecutionContext& context)
    : limits_(limits),
      growth_(options.growth),
      spacing_(limits.largest),
      regions_(options.regions),
      cascade_(frame_of(model, options, limits)) {
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    if (!reaches(regions_[i], model))
      throw usage_error("size_in", fmt::format("region {} of `size_in` does not reach the model", i + 1));
  }
  if (!options.size_field.empty()) open_external(model, options, context);
  if (!options.size_points.empty()) read_points(model, options, blocks, context);
}

void SpatialSizes::open_external(const CadModel& model, const SizingOptions& options,
                                 ExecutionContext& context) {
  const std::string path = options.size_field.string();
  // OpenVDB trusts the lengths in a damaged file. So try to open it in a child process first, which may crash
  // or request too much memory.
  constexpr std::size_t room = std::size_t{1} << 30, room_each_byte = 20;
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(options.size_field, unknown);
  IsolatedWork trial;
  trial.subject = path;
  trial.crashed = trial.too_long = fmt::format(
      "{}: reading this file crashed: it may be damaged, or there is too little memory here", path);
  trial.time_limit = longest_with_vdb;
  trial.memory = room + (unknown ? 0 : room_each_byte * bytes);
  trial.context = &context;
  run_isolated(trial, [&](std::ostream&) { opened_size_field(path); });
  ExternalSizes sizes = opened_size_field(path);
  const double unit = options.size_field_unit, scale = unit * options.size_field_scale;
  const Vector3 low = unit * sizes.low, high = unit * sizes.high;
  if ((low.array() > model.box_max().array()).any() || (high.array() < model.box_min().array()).any())
    throw usage_error(
        "size_field",
        fmt::format(
            "{} does not overlap the model: its sizes reach from {} to {} mm; check `size_field_unit`", path,
            place_text(low), place_text(high)));
  external_ = [at = std::move(sizes.at), unit, scale](const Vector3& p) { return scale * at(p / unit); };
  between_voxels_ = sizes.between_voxels;
  spacing_ = std::min(spacing_, std::max(unit * sizes.voxel, limits_.size_min));
}

void SpatialSizes::read_points(const CadModel& model, const SizingOptions& options, BlockCount& blocks,
                               ExecutionContext& context) {
  points_ = read_size_points(options.size_points);
  bool any = false;
  for (SizePoint& at : points_) {
    at.size = std::clamp(at.size, limits_.size_min, limits_.largest);
    const double reach = (limits_.largest - at.size) / growth_;
    if (distance_to_box(at.point, model.box_min(), model.box_max()) > reach) continue;
    any = true;
    if (at.size < limits_.largest) cascade_.add(at.point, at.size, blocks);
  }
  if (!any)
    throw usage_error("size_points",
                      fmt::format("no point of {} is near the model: check that they are in mm",
                                  options.size_points.string()));
  cascade_.grade(std::min(growth_, slope_of_hints), {}, blocks, context);
}

double SpatialSizes::of_regions(const Vector3& point, double steepest) const {
  double size = limits_.largest;
  for (const SizeRegion& region : regions_) {
    const double inside = std::max(region.size, limits_.least);
    if (inside >= limits_.largest) continue;
    double slope = growth_;
    if (region.transition > 0) slope = std::min(slope, (limits_.largest - inside) / region.transition);
    size = std::min(size, inside + std::min(slope, steepest) * region.distance(point));
  }
  return size;
}

double SpatialSizes::at(const Vector3& point) const {
  double size = limits_.largest;
  if (external_) size = std::clamp(external_(point), limits_.size_min, size);
  if (!points_.empty()) size = std::min(size, SizeCascade::Lookup(cascade_)(point));
  return std::min(size, of_regions(point, growth_));
}

double SpatialSizes::at_corner(const SizePoint& point, const Vector3& corner) const {
  if (!between_voxels_) return point.size;
  constexpr double rounding = 1e-9;
  const double here = std::max(external_(point.point), limits_.size_min);
  if (point.size < (1 - rounding) * here) return point.size;
  return std::clamp(external_(corner), limits_.size_min, limits_.largest);
}

double SpatialSizes::hint(const Vector3& point) const {
  return std::min(of_regions(point, slope_of_hints), at(point));
}

}  // namespace quadrille
