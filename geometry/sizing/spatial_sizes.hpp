#pragma once
/// Sizes that depend on the position in space alone: regions, points, external grids. Internal.

#include <functional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/size_cascade.hpp"
#include "geometry/sizing/size_file.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// Reads lines x,y,z,size, with or without a header line. Throws Error (failure) for anything else.
std::vector<SizePoint> read_size_points(const std::filesystem::path& path);

/// The smallest size requested by position. Thread-safe.
class SpatialSizes {
 public:
  /// Throws Error: failure for files that cannot be read, usage for sources that do not reach the model.
  SpatialSizes(const CadModel& model, const SizingOptions& options, const SizeLimits& limits,
               BlockCount& blocks, ExecutionContext& context);

  bool empty() const { return regions_.empty() && !external_ && points_.empty(); }
  /// The size at a point, within the limits.
  double at(const Vector3& point) const;
  /// The size for a corner of the voxel around a point that requests a size. If the size comes from one of
  /// our own files, it is the file's size at the corner, so that sizes come out of the field as they are in
  /// the file. Otherwise it is the size at the point.
  double at_corner(const SizePoint& point, const Vector3& corner) const;
  /// A lower estimate of the sizes near a point: sampling whose steps are halved down to it misses nothing.
  double hint(const Vector3& point) const;
  /// The largest initial step of a sampling.
  double spacing() const { return spacing_; }
  const std::vector<SizePoint>& points() const { return points_; }

 private:
  void open_external(const CadModel& model, const SizingOptions& options, ExecutionContext& context);
  void read_points(const CadModel& model, const SizingOptions& options, BlockCount& blocks,
                   ExecutionContext& context);
  double of_regions(const Vector3& point, double steepest) const;

  SizeLimits limits_;
  double growth_;
  double spacing_;
  std::vector<SizeRegion> regions_;
  std::function<double(const Vector3&)> external_;
  bool between_voxels_ = false;  // external_ is one of our own files: it interpolates between voxels
  std::vector<SizePoint> points_;
  SizeCascade cascade_;  // sizes from the points
};

}  // namespace quadrille
