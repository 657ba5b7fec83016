#include "geometry/sizing/element_count.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/free_memory.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// About how many elements faces can take at most: of each those of two squares over its box's diagonal (a
/// sphere takes a little more than one).
double most_elements(const CadShape& shape, const std::vector<char>& used, double size, double limit,
                     const ExecutionContext& context) {
  const double all = std::pow(shape.diagonal() / size, 2) * static_cast<double>(shape.faces.size());
  if (all < limit) return all;
  double count = 0;
  for (std::size_t i = 0; i < shape.faces.size() && count <= limit; ++i) {
    context.check();
    if (!used[i]) continue;
    Bnd_Box box;
    BRepBndLib::Add(shape.faces[i].face, box, Standard_False);
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
    const Vector2 uv = low + Vector2((i % steps + 0.5) * cell.x(), (i / steps + 0.5) * cell.y());
    if (!domain.inside(uv)) continue;
    const SurfacePoint at = surface.evaluate(uv);
    const double area = at.du.cross(at.dv).norm() * cell.x() * cell.y();
    samples.push_back({at.point, area, surface.planar() ? 0 : surface.max_curvature(uv)});
  }
  return samples;
}

/// Blocks of the sizing field that a square of one voxel of a surface takes: the field about it is some six
/// voxels thick, lies at all angles to the blocks, and is taken over by the coarser levels, each a quarter.
constexpr double blocks_a_square = 3.3 / 64;

/// The size asked for by itself on a face, where that is less than everywhere.
double size_on(const SizingOptions& options, const SizeLimits& limits, int face) {
  const auto own = options.face_sizes.find(face + 1);
  return own == options.face_sizes.end() ? limits.largest : std::min(limits.largest, own->second);
}

/// Whether blocks about the faces that have sizes of their own could be more than the budget has, by the
/// faces' boxes.
bool may_pass_blocks(const CadShape& shape, const SizingOptions& options) {
  double squares = 0;
  for (const auto& [face, size] : options.face_sizes) {
    Bnd_Box box;
    BRepBndLib::Add(shape.faces[face - 1].face, box, Standard_False);
    if (!box.IsVoid()) squares += 2 * box.SquareExtent() / (size * size);
  }
  return squares * blocks_a_square > options.budget.blocks;
}

}  // namespace

TrimmedDomain coarse_domain(const CadShape& shape, const CadFace& face) {
  constexpr int intervals = 16;
  std::vector<TrimmedDomain::Segment> segments;
  for (const CadWire& wire : face.wires) {
    for (const Coedge& coedge : wire.coedges) {
      if (coedge.internal) continue;
      const CadEdge& edge = shape.edges[coedge.edge - 1];
      Vector2 from = parametric_point(coedge, edge.first);
      for (int i = 1; i <= intervals; ++i) {
        const Vector2 to = parametric_point(coedge, edge.first + (edge.last - edge.first) * i / intervals);
        segments.push_back({from, to});
        from = to;
      }
    }
  }
  return TrimmedDomain(std::move(segments));
}

std::vector<std::vector<FaceSample>> sample_faces(const CadShape& shape, const std::vector<char>& used,
                                                  ExecutionContext& context) {
  std::vector<std::vector<FaceSample>> samples(shape.faces.size());
  oneapi::tbb::parallel_for(0, static_cast<int>(samples.size()), [&](int face) {
    context.check();
    if (used[face]) samples[face] = sample_face(shape, shape.faces[face]);
  });
  return samples;
}

double count_elements(const std::vector<std::vector<FaceSample>>& samples,
                      const std::function<double(int face, const FaceSample&)>& size_at) {
  double count = 0;
  for (std::size_t face = 0; face < samples.size(); ++face) {
    for (const FaceSample& sample : samples[face])
      count += sample.area / std::pow(size_at(static_cast<int>(face), sample), 2);
  }
  return count;
}

void hold_elements(double count, const Budget& budget, double free) {
  const double bytes = count * budget.bytes_an_element;
  if (count > budget.elements)
    throw usage_error("size",
                      fmt::format("the sizes asked for give about {:.3g} million elements, more than {:g} "
                                  "million: `force` meshes all the same",
                                  count / 1e6, budget.elements / 1e6));
  if (budget.bytes_an_element > 0 && bytes > free)
    throw usage_error(
        "size", fmt::format("the sizes asked for give about {:.3g} million elements, which take {:.2g} GB "
                            "of memory, and {:.2g} GB are free: `force` meshes all the same",
                            count / 1e6, bytes / 1e9, free / 1e9));
}

ElementBudget::ElementBudget(const CadModel& model, const SizingOptions& options,
                             const std::vector<char>& used, ExecutionContext& context)
    : budget_(options.budget), free_(budget_.bytes_an_element > 0 ? free_memory() : 0) {
  const SizeLimits limits = size_limits(model, options);
  const double limit = budget_.bytes_an_element > 0
                           ? std::min(budget_.elements, free_ / budget_.bytes_an_element)
                           : budget_.elements;
  if (!(most_elements(model.shape(), used, limits.least, limit, context) > limit) &&
      !may_pass_blocks(model.shape(), options))
    return;
  samples_ = sample_faces(model.shape(), used, context);
  hold_elements(count_elements(samples_,
                               [&](int face, const FaceSample& sample) {
                                 return std::min(size_on(options, limits, face),
                                                 size_of_curvature(options, limits, sample.curvature));
                               }),
                budget_, free_);
  hold_blocks(options, limits);
}

void ElementBudget::check(const SizingField& field) const {
  std::optional<SizingField::Sampler> size_at;
  int last = -1;
  hold_elements(count_elements(samples_,
                               [&](int face, const FaceSample& sample) {
                                 if (face != last) size_at.emplace(field, face);
                                 last = face;
                                 return (*size_at)(sample.point);
                               }),
                budget_, free_);
}

void ElementBudget::hold_blocks(const SizingOptions& options, const SizeLimits& limits) const {
  double blocks = 0;
  for (std::size_t face = 0; face < samples_.size(); ++face) {
    for (const FaceSample& sample : samples_[face]) {
      const double size = std::min(size_on(options, limits, static_cast<int>(face)),
                                   size_of_curvature(options, limits, sample.curvature));
      if (!(size < limits.largest)) continue;
      blocks +=
          blocks_a_square * sample.area / std::pow(field_voxel(limits.largest, size, options.growth), 2);
    }
  }
  if (blocks > budget_.blocks) throw too_many_blocks(blocks);
}

}  // namespace quadrille
