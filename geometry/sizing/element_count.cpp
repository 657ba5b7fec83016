/// Sums area over squared size at samples of the faces. What lies between them is counted in the field.

#include "geometry/sizing/element_count.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/process_usage.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// About the largest possible number of elements: on each face two squares over the diagonal of its bounding
/// box (a sphere needs a little more than one).
double most_elements(const CadShape& shape, const FaceFlags& used, double size, double limit,
                     const ExecutionContext& context) {
  const double all = std::pow(shape.diagonal() / size, 2) * static_cast<double>(shape.faces.size());
  if (all < limit) return all;
  double count = 0;
  for (const FaceId face : shape.faces.ids()) {
    if (count > limit) break;
    context.check();
    if (!used[face]) continue;
    const Bnd_Box box = box_of(shape.faces[face].face);
    if (!box.IsVoid()) count += 2 * box.SquareExtent() / (size * size);
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

/// Blocks of the sizing field per voxel-sized square of a surface. The field around a surface is some six
/// voxels thick and at any angle to the blocks; each coarser level repeats it with a quarter of the blocks.
constexpr double blocks_a_square = 3.3 / 64;

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
  double limit = std::min(budget_.elements, budget_.blocks / blocks_a_square);
  if (budget_.bytes_an_element > 0) limit = std::min(limit, free_ / budget_.bytes_an_element);
  if (!(most_elements(model.shape(), used, limits.least, limit, context) > limit)) return;
  samples_ = sample_faces(model.shape(), used, context);
  double blocks = 0;
  // The size that is requested by name, by region and by curvature.
  const double count = count_elements(samples_, [&](FaceId face, const FaceSample& sample) {
    double size = std::min({limits.largest, value_or(options.face_sizes, face.number(), limits.largest),
                            size_of_curvature(options, limits, sample.curvature)});
    for (const SizeRegion& region : options.regions)
      if (region.distance(sample.point) <= 0) size = std::min(size, std::max(region.size, limits.least));
    if (size < limits.largest)
      blocks +=
          blocks_a_square * sample.area / std::pow(field_voxel(limits.largest, size, options.growth), 2);
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
