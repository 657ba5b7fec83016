/// Size from curvature: 2 pi R / (elements per circle), as in Gmsh's and Netgen's manuals.

#include "geometry/sizing/size_sources.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/base/trimmed_domain.hpp"
#include "geometry/base/whole_number.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/face_gaps.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Blocks of the sizing field per voxel width of an edge's length. The field around an edge is some five
/// voxels wide; each coarser level repeats it with half of the blocks.
constexpr double blocks_a_voxel = 0.85;
/// Limit on halving an edge or a cell of a face; the budget ends the halving before.
constexpr int max_depth = 40;
/// Limits on the number of cells of a face along each parameter before any is halved.
constexpr int fewest_cells = 4, most_cells = 400;

}  // namespace

SizeSources::SizeSources(const CadShape& shape, const SizingOptions& options, const SizeLimits& limits,
                         const UnsizedFeatures& unsized, const SpatialSizes& spatial,
                         const ExecutionContext& context)
    : shape_(shape),
      options_(options),
      limits_(limits),
      unsized_(unsized),
      spatial_(spatial),
      context_(context),
      prescribed_(prescribed_edges(shape, options, limits.largest)) {}

/// The size requested on an edge itself and by its length.
double SizeSources::cap_of(const CadEdge& edge, bool by_shape) const {
  const double cap = value_or(options_.edge_sizes, edge.number, limits_.largest);
  if (!options_.short_edges || !by_shape) return cap;
  // A short edge is one element, and the mesh around it is refined towards it.
  return std::min(cap, std::max(edge.length, limits_.size_min));
}

SizeSources::SizeHere SizeSources::with_spatial(double size, const Vector3& point) const {
  if (spatial_.empty()) return {size, size};
  return {std::min(size, spatial_.at(point)), std::min(size, spatial_.hint(point))};
}

void SizeSources::hold_segments() const {
  double sum = 0, most = 0, blocks = 0;
  const CadEdge* longest = nullptr;
  for (const EdgeId id : shape_.edges.ids()) {
    const CadEdge& edge = shape_.edges[id];
    if (edge.degenerate || edge.faces.empty() || !(edge.length > 0)) continue;
    const double cap = cap_of(edge, true);
    const double segments = prescribed_[id] ? prescribed_[id]->segments : edge.length / cap;
    sum += segments;
    if (cap < limits_.largest)
      blocks += blocks_a_voxel * edge.length / field_voxel(limits_.largest, cap, options_.growth);
    if (segments <= most) continue;
    most = segments;
    longest = &edge;
  }
  if (longest != nullptr && sum > options_.budget.segments) throw too_many_segments(*longest, most);
  if (blocks > options_.budget.blocks) throw too_many_blocks(blocks);
}

Error SizeSources::too_many_segments(const CadEdge& edge, double segments) const {
  return usage_error(
      "size",
      fmt::format("Edge{} of {} mm would take about {:.3g} million segments at the requested sizes, and all "
                  "edges more than {:g} million: `force` meshes anyway",
                  edge.number, number_text(edge.length), segments / 1e6, options_.budget.segments / 1e6));
}

void SizeSources::edge(EdgeId id, bool by_shape, const Sink& sink) const {
  context_.check();
  const CadEdge& edge = shape_.edges[id];
  if (edge.degenerate || edge.faces.empty() || edge.length <= 0) return;
  if (prescribed_[id] && !is_set(unsized_.divided, id)) prescribed_edge(edge, *prescribed_[id], sink);
  if (is_set(unsized_.edges, id) && !options_.edge_sizes.contains(edge.number)) return;
  const EdgeCurve curve(edge);
  double cap = cap_of(edge, by_shape);
  if (curve.straight() || !by_shape) {
    if (cap < limits_.largest || !spatial_.empty()) sample_edge(curve, edge, cap, false, sink);
    return;
  }
  if (curve.circular()) cap = std::min(cap, size_of(curve.curvature(edge.first)));
  sample_edge(curve, edge, cap, !curve.circular(), sink);
}

/// Requests the segment lengths along a prescribed edge, so that the faces beside it are as fine as the edge.
void SizeSources::prescribed_edge(const CadEdge& edge, const PrescribedEdge& prescribed,
                                  const Sink& sink) const {
  const EdgeCurve curve(edge);
  const int n = prescribed.segments;
  for (int k = 0; k <= 2 * n; ++k) {
    const double share = prescribed.shares.empty() ? 0.5 * k / n
                         : k % 2 == 0              ? prescribed.shares[k / 2]
                                      : 0.5 * (prescribed.shares[k / 2] + prescribed.shares[k / 2 + 1]);
    const double size = prescribed.size_at(share, edge.length);
    if (size < limits_.largest)
      sink(curve.point(edge.first + share * (edge.last - edge.first)), std::max(size, limits_.least));
  }
}

void SizeSources::sample_edge(const EdgeCurve& curve, const CadEdge& edge, double cap, bool with_curvature,
                              const Sink& sink) const {
  const int intervals = std::max(
      {4, with_curvature ? 3 * curve.spans() : 1, to_int(std::ceil(edge.length / spatial_.spacing()))});
  const auto sample = [&](double t) {
    const Vector3 point = curve.point(t);
    double size = cap;
    if (with_curvature) size = std::min(size, size_of(curve.curvature(t)));
    return EdgeSample{t, point, with_spatial(size, point)};
  };
  const auto add = [&](const EdgeSample& made) {
    if (made.at.size < limits_.largest) sink(made.point, made.at.size);
  };
  EdgeSample first = sample(edge.first);
  add(first);
  SparseCheck check(context_, 256);
  for (int i = 1; i <= intervals; ++i) {
    check();
    const EdgeSample last = sample(edge.first + (edge.last - edge.first) * i / intervals);
    const double segments = (last.point - first.point).norm() / std::min(first.at.size, last.at.size);
    if (segments > options_.budget.segments) throw too_many_segments(edge, segments);
    split_interval(sample, first, last, 0, add, check);
    add(last);
    first = last;
  }
}

/// Adds samples between two others by halving, until they are no farther apart than the size there.
template <class SampleAt, class Add>
void SizeSources::split_interval(const SampleAt& sample, const EdgeSample& first, const EdgeSample& last,
                                 int depth, const Add& add, SparseCheck& check) const {
  check();
  const double hint = std::min(first.at.hint, last.at.hint);
  if ((last.point - first.point).norm() <= hint || depth > max_depth) return;
  const EdgeSample middle = sample(0.5 * (first.t + last.t));
  if (std::min(hint, middle.at.hint) >= limits_.largest) return;
  add(middle);
  split_interval(sample, first, middle, depth + 1, add, check);
  split_interval(sample, middle, last, depth + 1, add, check);
}

/// Samples the face in cells of its parameter plane, at first about as long as the spacing of spatial sizes.
void SizeSources::face(FaceId id, const Sink& sink) const {
  if (is_set(unsized_.faces, id) && !options_.face_sizes.contains(id.number())) return;
  const bool gridded = is_set(unsized_.gridded, id);
  if (options_.proximity > 0 || (options_.short_edges && !gridded)) gaps(id, sink);
  const CadFace& face = shape_.faces[id];
  const FaceSurface surface(face);
  const double cap = value_or(options_.face_sizes, id.number(), limits_.largest);
  const bool curved = !surface.planar() && has_curvature_sizes(options_);
  if (!curved && cap >= limits_.largest && spatial_.empty()) return;
  const TrimmedDomain domain = coarse_domain(shape_, face);
  SparseCheck check(context_, 64);
  const auto sample = [&](const Vector2& middle, const Vector2& cell) {
    check();
    const SurfacePoint at = surface.evaluate(middle);
    double own = cap;
    if (curved) own = std::min(own, (gridded ? options_.aspect : 1) * size_of(surface.max_curvature(middle)));
    const auto [size, hint] = with_spatial(own, at.point);
    if (size < limits_.largest && domain.inside(middle)) sink(at.point, size);
    return std::tuple(hint, cell.x() * at.du.norm(), cell.y() * at.dv.norm());
  };
  const Vector2 low(face.u_min, face.v_min), extent(face.u_max - face.u_min, face.v_max - face.v_min);
  const Vector2 lengths = extent.cwiseProduct(surface.mean_scale()) / spatial_.spacing();
  const auto cells = [](double count) {
    return to_int(std::clamp<double>(std::ceil(count), fewest_cells, most_cells));
  };
  const int nu = cells(lengths.x()), nv = cells(lengths.y());
  const Vector2 cell(extent.x() / nu, extent.y() / nv);
  for (int k = 0; k < nu * nv; ++k) {
    const int column = k % nu, row = k / nu;
    const Vector2 middle((column + 0.5) * cell.x(), (row + 0.5) * cell.y());
    split_cell(sample, low + middle, cell, 0);
  }
}

/// Requests options.proximity elements across each gap and, with options.short_edges, elements along it that
/// are at most four times as long as its two rows are wide. Not where these are below half the least size
/// together, or in wedges, where rows end.
void SizeSources::gaps(FaceId id, const Sink& sink) const {
  constexpr double rows = 2, longest = 4, least_width = 0.5, parallel = 0.2;
  // Rows come in pairs where quads are cut in four, so the number of elements is a minimum.
  const double asked =
      options_.proximity > rows ? rows * std::ceil(options_.proximity / rows) : options_.proximity;
  const double n = std::max(asked, rows / longest);
  for (const FaceGap& gap : face_gaps(shape_, id, n * limits_.largest, n * limits_.size_min, context_)) {
    double size = limits_.largest;
    if (asked > 0) size = std::max(gap.width() / asked, limits_.at_gaps);
    if (options_.short_edges && gap.angle < parallel && gap.width() >= least_width * limits_.size_min)
      size = std::min(size, std::max(longest / rows * gap.width(), limits_.size_min));
    if (!(size < limits_.largest)) continue;
    const int steps = to_int(std::ceil(gap.width() / size));
    for (int k = 0; k <= steps; ++k) sink(gap.from + k * (gap.to - gap.from) / steps, size);
  }
}

/// Samples the middle of a cell of the parameter plane, and of its parts if the cell is larger than the size.
/// \param sample gives the size in the middle of a cell, and the cell's length and width in space
template <class SampleAt>
void SizeSources::split_cell(const SampleAt& sample, const Vector2& middle, const Vector2& cell,
                             int depth) const {
  const auto [size, length, width] = sample(middle, cell);
  const bool split_u = length > 1.5 * size, split_v = width > 1.5 * size;
  if ((!split_u && !split_v) || depth > max_depth || size >= limits_.largest) return;
  const int nu = split_u ? 2 : 1, nv = split_v ? 2 : 1;
  const Vector2 part(cell.x() / nu, cell.y() / nv);
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const Vector2 offset((i + 0.5) * part.x() - 0.5 * cell.x(), (j + 0.5) * part.y() - 0.5 * cell.y());
      split_cell(sample, middle + offset, part, depth + 1);
    }
  }
}

}  // namespace quadrille
