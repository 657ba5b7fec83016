#pragma once
/// Sizes that hang on the place in space alone: regions, points, external grids. Internal.

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

/// Reads lines x,y,z,size, with or without a line of names first. Throws Error (failure) for anything else.
std::vector<SizePoint> read_size_points(const std::filesystem::path& path);

/// The least of all that is asked for by place. Thread-safe.
class SpatialSizes {
 public:
  /// Throws Error: failure for files that cannot be read, usage for sources that do not reach the model.
  SpatialSizes(const CadModel& model, const SizingOptions& options, const SizeLimits& limits,
               BlockCount& blocks, ExecutionContext& context);

  bool empty() const { return regions_.empty() && !external_ && points_.empty(); }
  /// Within the limits.
  double at(const Vector3& point) const;
  /// What a corner of the voxel is given where a point asks for a size: what our own files hold at the
  /// corner, if that is what asks at the point, so that sizes come out of the field as they are in the file;
  /// else the point's.
  double at_corner(const SizePoint& point, const Vector3& corner) const;
  /// Whether at_corner() may be another size than the point's.
  bool has_corners() const { return between_voxels_; }
  /// What sizes there may be near a point, so that whoever halves his steps until they are about as long
  /// passes over nothing.
  double hint(const Vector3& point) const;
  /// No wider than this should the first steps be.
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
  bool between_voxels_ = false;  // of external_: it changes as slowly as sizes may
  std::vector<SizePoint> points_;
  SizeCascade cascade_;  // of the points
};

}  // namespace quadrille
