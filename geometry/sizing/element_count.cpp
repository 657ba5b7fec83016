/// Sums area over squared size at samples of the faces; cells at borders of regions are halved.

#include "geometry/sizing/element_count.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/process_usage.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/coarse_domain.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// About the largest possible number of elements on a face: two squares over the diagonal of its bounding
/// box (a sphere needs a little more than one).
double most_on(const CadFace& face, double size) {
  const Bnd_Box box = box_of(face.face);
  return box.IsVoid() ? 0 : 2 * box.SquareExtent() / (size * size);
}

/// About the largest possible number of elements.
double most_elements(const CadShape& shape, const FaceFlags& used, double size, double limit,
                     const ExecutionContext& context) {
  const double all = std::pow(shape.diagonal() / size, 2) * static_cast<double>(shape.faces.size());
  if (all < limit) return all;
  double count = 0;
  for (const FaceId face : shape.faces.ids()) {
    if (count > limit) break;
    context.check();
    if (used[face]) count += most_on(shape.faces[face], size);
  }
  return count;
}

std::vector<FaceSample> sample_face(const CadShape& shape, const CadFace& face) {
  constexpr int steps = 24;
  const FaceSurface surface(face);
  const TrimmedDomain domain = coarse_domain(shape, face);
  const Vector2 low(face.u_min, face.v_min);
  const Vector2 cell((face.u_max - face.u_min) / steps, (face.v_max - face.v_min) / steps);
  std::vector<FaceSample> samples;
  for (int i = 0; i < steps * steps; ++i) {
    const int column = i % steps, row = i / steps;
    const Vector2 uv = low + Vector2((column + 0.5) * cell.x(), (row + 0.5) * cell.y());
    if (!domain.inside(uv)) continue;
    const SurfacePoint at = surface.evaluate(uv);
    const double area = at.du.cross(at.dv).norm() * cell.x() * cell.y();
    samples.push_back({at.point, area, surface.planar() ? 0 : surface.max_curvature(uv)});
  }
  return samples;
}

/// What regions request on a face, by cells of its parameter plane. Cells at borders of regions are halved.
class RegionSum {
 public:
  RegionSum(const CadShape& shape, const CadFace& face, const std::vector<SizeRegion>& regions, double least)
      : surface_(face), domain_(coarse_domain(shape, face)), regions_(regions), least_(least) {
    const Vector2 low(face.u_min, face.v_min);
    add(low, Vector2(face.u_max, face.v_max) - low, 0);
  }

  /// Area and size of pieces.
  const std::vector<std::pair<double, double>>& pieces() const { return pieces_; }

 private:
  /// The least size of the regions within `distance` of a point; infinite where there is none.
  double size_near(const Vector3& p, double distance) const {
    double size = std::numeric_limits<double>::infinity();
    for (const SizeRegion& region : regions_) {
      if (region.distance(p) <= distance) size = std::min(size, std::max(region.size, least_));
    }
    return size;
  }

  void add(const Vector2& low, const Vector2& extent, int depth) {
    constexpr int first = 4, last = 8;  // halvings: least (for the face's border), most (for regions')
    constexpr double bulge = 1.3;       // allowance for curved cells
    const SurfacePoint at = surface_.evaluate(low + 0.5 * extent);
    const double reach = 0.5 * bulge * (at.du.norm() * extent.x() + at.dv.norm() * extent.y());
    if (depth > 2 && !std::isfinite(size_near(at.point, reach))) return;
    const double size = size_near(at.point, 0);
    if (depth == last || (depth >= first && is_alike(low, extent, size))) {
      const double area = at.du.cross(at.dv).norm() * extent.x() * extent.y();
      if (std::isfinite(size) && domain_.inside(low + 0.5 * extent)) pieces_.emplace_back(area, size);
      return;
    }
    for (int k = 0; k < 4; ++k)
      add(low + 0.5 * extent.cwiseProduct(Vector2(k & 1, k >> 1)), 0.5 * extent, depth + 1);
  }

  /// Whether all corners of a cell have the size of its middle. Regions are convex.
  bool is_alike(const Vector2& low, const Vector2& extent, double size) const {
    for (int k = 0; k < 4; ++k) {
      if (size_near(surface_.point(low + extent.cwiseProduct(Vector2(k & 1, k >> 1))), 0) != size)
        return false;
    }
    return true;
  }

  FaceSurface surface_;
  TrimmedDomain domain_;
  const std::vector<SizeRegion>& regions_;
  double least_;
  std::vector<std::pair<double, double>> pieces_;
};

/// Blocks of the sizing field per voxel-sized square of a surface. The field around a surface is some six
/// voxels thick and at any angle to the blocks; each coarser level repeats it with a quarter of the blocks.
constexpr double blocks_a_square = 3.3 / 64;

double blocks_on(double area, double size, const SizingOptions& options, const SizeLimits& limits) {
  return blocks_a_square * area / std::pow(field_voxel(limits.largest, size, options.growth), 2);
}

/// Whether, by the faces' bounding boxes, the blocks around faces with their own sizes may exceed the budget.
bool may_pass_blocks(const CadShape& shape, const SizingOptions& options) {
  double squares = 0;
  for (const auto& [face, size] : options.face_sizes)
    squares += most_on(shape.faces[FaceId::from_number(face)], size);
  return squares * blocks_a_square > options.budget.blocks;
}

/// Throws Error (usage) if regions request more elements or blocks on the used faces than allowed.
void hold_regions(const CadShape& shape, const SizingOptions& options, const SizeLimits& limits,
                  const FaceFlags& used, double free, const ExecutionContext& context) {
  const double most = std::min(options.budget.elements, options.budget.blocks / blocks_a_square);
  std::vector<SizeRegion> regions;
  for (const SizeRegion& region : options.regions) {
    const double squares = 2 * std::pow(shape.diagonal() / std::max(region.size, limits.least), 2) *
                           static_cast<double>(shape.faces.size());
    if (region.size < limits.largest && squares > most) regions.push_back(region);
  }
  if (regions.empty()) return;
  double elements = 0, blocks = 0;
  for (const FaceId face : shape.faces.ids()) {
    context.check();
    if (!used[face]) continue;
    const RegionSum sum(shape, shape.faces[face], regions, limits.least);
    for (const auto& [area, size] : sum.pieces()) {
      elements += area / (size * size);
      blocks += blocks_on(area, size, options, limits);
    }
  }
  hold_elements(elements, options.budget, free);
  if (blocks > options.budget.blocks) throw too_many_blocks(blocks);
}

}  // namespace

FaceSamples sample_faces(const CadShape& shape, const FaceFlags& used, ExecutionContext& context) {
  FaceSamples samples(shape.faces.size());
  for_each_id(samples, [&](FaceId face) {
    context.check();
    if (used[face]) samples[face] = sample_face(shape, shape.faces[face]);
  });
  return samples;
}

double count_elements(const FaceSamples& samples,
                      const std::function<double(FaceId face, const FaceSample&)>& size_at) {
  double count = 0;
  for (const FaceId face : samples.ids()) {
    for (const FaceSample& sample : samples[face]) count += sample.area / std::pow(size_at(face, sample), 2);
  }
  return count;
}

void hold_elements(double count, const Budget& budget, double free) {
  const double bytes = count * budget.bytes_an_element;
  if (count > budget.elements)
    throw usage_error("size",
                      fmt::format("the requested sizes give about {:.3g} million elements, more than {:g} "
                                  "million: `force` meshes anyway",
                                  count / 1e6, budget.elements / 1e6));
  if (budget.bytes_an_element > 0 && bytes > free)
    throw usage_error(
        "size", fmt::format("the requested sizes give about {:.3g} million elements, which take {:.2g} GB "
                            "of memory, and {:.2g} GB are free: `force` meshes anyway",
                            count / 1e6, bytes / 1e9, free / 1e9));
}

ElementBudget::ElementBudget(const CadModel& model, const SizingOptions& options, const FaceFlags& used,
                             ExecutionContext& context)
    : budget_(options.budget), free_(budget_.bytes_an_element > 0 ? free_memory() : 0) {
  const SizeLimits limits = size_limits(model, options);
  hold_regions(model.shape(), options, limits, used, free_, context);
  const double limit = budget_.bytes_an_element > 0
                           ? std::min(budget_.elements, free_ / budget_.bytes_an_element)
                           : budget_.elements;
  if (!(most_elements(model.shape(), used, limits.least, limit, context) > limit) &&
      !may_pass_blocks(model.shape(), options))
    return;
  samples_ = sample_faces(model.shape(), used, context);
  double blocks = 0;
  const double count = count_elements(samples_, [&](FaceId face, const FaceSample& sample) {
    const double size = std::min({limits.largest, value_or(options.face_sizes, face.number(), limits.largest),
                                  size_of_curvature(options, limits, sample.curvature)});
    if (size < limits.largest) blocks += blocks_on(sample.area, size, options, limits);
    return size;
  });
  hold_elements(count, budget_, free_);
  if (blocks > budget_.blocks) throw too_many_blocks(blocks);
}

void ElementBudget::check(const SizingField& field) const {
  std::optional<SizingField::Sampler> size_at;
  FaceId last;
  hold_elements(count_elements(samples_,
                               [&](FaceId face, const FaceSample& sample) {
                                 if (face != last) size_at.emplace(field, face);
                                 last = face;
                                 return (*size_at)(sample.point);
                               }),
                budget_, free_);
}

}  // namespace quadrille
