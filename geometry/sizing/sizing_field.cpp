/// Gathers the sizes of all sources in OpenVDB grids of several levels, which then grow from the smallest.

#include "geometry/sizing/sizing_field.hpp"

#include <Precision.hxx>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "geometry/cad/bounding_box.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/sizing/edge_spacing.hpp"
#include "geometry/sizing/size_cascade.hpp"
#include "geometry/sizing/size_file.hpp"
#include "geometry/sizing/size_sources.hpp"
#include "geometry/sizing/spatial_sizes.hpp"
#include "geometry/sizing/surface_gradation.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

/// Slower growth is raised to this, since single precision cannot resolve it.
constexpr double least_growth = 1e-9;

}  // namespace

class SizingField::Impl {
 public:
  CascadeFrame frame;
  SizingOptions options;
  SizeLimits limits;
  FaceFlags gridded;      // see UnsizedFeatures
  FaceCascades cascades;  // one per face, or one for all
  bool on_surface;

  int cascade_of(FaceId face) const { return on_surface ? face.index() : 0; }
  /// The cascades of these faces, each once.
  std::set<int> cascades_of(const std::vector<FaceId>& faces) const {
    std::set<int> result;
    for (const FaceId face : faces) result.insert(cascade_of(face));
    return result;
  }
};

namespace {

/// Collects the sources of a model into the grids of a field, and lets them grow.
class Builder {
 public:
  Builder(const CadModel& model, const SizingOptions& options, const SizeLimits& limits,
          const UnsizedFeatures& unsized, SizingField::Impl& field, ExecutionContext& context)
      : shape_(model.shape()),
        options_(options),
        limits_(limits),
        unsized_(unsized),
        field_(field),
        context_(context),
        blocks_(options.budget.blocks),
        spatial_(model, options, limits_, blocks_, context),
        sources_(shape_, options_, limits_, unsized, spatial_, context) {
    const std::size_t n = field_.on_surface ? shape_.faces.size() : 1;
    for (std::size_t i = 0; i < n; ++i) {
      field_.cascades.push_back(std::make_unique<SizeCascade>(field_.frame));
      mutexes_.emplace_back();
    }
  }

  void run() {
    sources_.hold_segments();
    for_each_id(shape_.edges, [&](EdgeId edge) { add_edge(edge); });
    std::atomic<int> done{0};
    const auto faces = static_cast<double>(shape_.faces.size());
    for_each_id(shape_.faces, [&](FaceId face) {
      Batch batch(*this, {field_.cascade_of(face)});
      sources_.face(face, [&](const Vector3& p, double size) { batch.add(p, size); });
      batch.pass_on();
      context_.report(Stage::size, (done.fetch_add(1, std::memory_order_relaxed) + 1) / faces);
    });
    for (const auto& [vertex, size] : options_.vertex_sizes) {
      if (!(size < limits_.largest)) continue;
      const VertexId id = VertexId::from_number(vertex);
      for (const int i : field_.cascades_of(faces_of_vertex(id)))
        field_.cascades[i]->add(shape_.vertices[id], size, blocks_);
    }
    if (field_.on_surface)
      return grade_on_surface(shape_, field_.cascades, options_.growth, blocks_, context_);
    // Points may lie anywhere in space. What they request on faces was sampled on the faces.
    SizeCascade& all = *field_.cascades.front();
    for (const auto& [p, size] : spatial_.points())
      if (size < limits_.largest) all.add(p, size, blocks_);
    all.grade(options_.growth, {}, blocks_, context_);
  }

 private:
  /// Sizes found by one thread. Each voxel keeps the least one, so the order of threads does not matter.
  class Batch {
   public:
    Batch(Builder& builder, std::set<int> cascades) : builder_(builder), cascades_(std::move(cascades)) {}

    void add(const Vector3& p, double size) {
      points_.push_back({p, size});
      constexpr std::size_t most = 4096;
      if (points_.size() >= most) pass_on();
    }

    void pass_on() {
      for (const int cascade : cascades_) {
        const std::lock_guard lock(builder_.mutexes_[cascade]);
        for (const SizePoint& at : points_) builder_.add(*builder_.field_.cascades[cascade], at);
      }
      points_.clear();
    }

   private:
    Builder& builder_;
    std::set<int> cascades_;
    std::vector<SizePoint> points_;
  };

  void add(SizeCascade& cascade, const SizePoint& at) {
    cascade.add_by_corner(at.point, at.size, blocks_,
                          [&](const Vector3& corner) { return spatial_.at_corner(at, corner); });
  }

  void add_edge(EdgeId edge) {
    for (const bool by_shape : {true, false}) {  // not by its shape on faces with rows from side to side
      std::vector<FaceId> faces = shape_.edges[edge].faces;
      std::erase_if(faces, [&](FaceId face) { return is_set(unsized_.gridded, face) == by_shape; });
      if (faces.empty()) continue;
      Batch batch(*this, field_.cascades_of(faces));
      sources_.edge(edge, by_shape, [&](const Vector3& p, double size) { batch.add(p, size); });
      batch.pass_on();
    }
  }

  std::vector<FaceId> faces_of_vertex(VertexId vertex) const {
    std::vector<FaceId> faces;
    for (const CadEdge& edge : shape_.edges) {
      if (edge.first_vertex == vertex || edge.last_vertex == vertex)
        faces.insert(faces.end(), edge.faces.begin(), edge.faces.end());
    }
    for (const FaceId face : shape_.faces.ids()) {
      for (const InnerVertex& inner : shape_.faces[face].inner_vertices) {
        if (inner.vertex == vertex) faces.push_back(face);
      }
    }
    return faces;
  }

  const CadShape& shape_;
  const SizingOptions& options_;
  SizeLimits limits_;
  const UnsizedFeatures& unsized_;
  SizingField::Impl& field_;
  ExecutionContext& context_;
  BlockCount blocks_;
  SpatialSizes spatial_;
  SizeSources sources_;
  std::deque<std::mutex> mutexes_;  // one per cascade
};

/// What a size is given to. A piece is an entry of CadShape::edges, others are numbered as by users.
enum class Named { face, edge, vertex, piece };

/// Calls visit(what, number from 1, size) for each size that users give to faces, edges and vertices.
template <class Visit>
void visit_named_sizes(const CadModel& model, const SizingOptions& options, double size, Visit&& visit) {
  for (const auto& [what, sizes] :
       {std::pair{Named::face, &options.face_sizes}, std::pair{Named::edge, &options.edge_sizes},
        std::pair{Named::vertex, &options.vertex_sizes}}) {
    for (const auto& [number, own] : *sizes) visit(what, number, own);
  }
  if (options.spacings.empty()) return;
  const auto prescribed = prescribed_edges(model.shape(), options, size);
  for (const EdgeId piece : prescribed.ids()) {
    if (prescribed[piece])
      visit(Named::piece, piece.number(), prescribed[piece]->shortest(model.shape().edges[piece].length));
  }
}

/// The smallest size that the user requests anywhere.
double smallest(const CadModel& model, const SizingOptions& options, double size) {
  double result = std::numeric_limits<double>::infinity();
  visit_named_sizes(model, options, size, [&](Named, int, double own) { result = std::min(result, own); });
  for (const SizeRegion& region : options.regions) result = std::min(result, region.size);
  return result;
}

}  // namespace

CascadeFrame frame_of(const CadModel& model, const SizingOptions& options, const SizeLimits& limits) {
  CascadeFrame frame{limits.largest, std::max(options.growth, least_growth), 0};
  // The trees use 32-bit voxel indices.
  const double reach = std::max(model.box_min().cwiseAbs().maxCoeff(), model.box_max().cwiseAbs().maxCoeff());
  const int bits = 30 - std::ilogb(reach / frame.voxel(0) + 1);
  if (bits < 0) {
    throw usage_error("size", fmt::format("the size {:.3g} is below the numerical resolution at {} mm from "
                                          "the origin: move the model to the origin, or use a larger size",
                                          limits.largest, number_text(reach)));
  }
  frame.finest = std::min(bits, max_size_levels - 1);
  return frame;
}

SizingField SizingField::build(const CadModel& model, const SizingOptions& options, ExecutionContext& context,
                               const UnsizedFeatures& unsized) {
  const SizeLimits limits = size_limits(model, options);
  const auto impl = std::make_shared<Impl>(Impl{frame_of(model, options, limits),
                                                options,
                                                limits,
                                                unsized.gridded,
                                                {},
                                                options.gradation == Gradation::surface});
  SizingOptions steady = options;
  steady.growth = impl->frame.growth;
  Builder(model, steady, limits, unsized, *impl, context).run();
  return SizingField(impl);
}

double field_voxel(double size_max, double size, double growth) {
  return std::ldexp(size_max, -level_for(size_max, size)) * widening(std::max(growth, least_growth));
}

Error too_many_blocks(double blocks) {
  return usage_error("size", fmt::format("the requested sizes need a sizing field of {:.3g} million voxels "
                                         "or more: use larger sizes, or `force`",
                                         blocks * SizeLeaf::NUM_VALUES / 1e6));
}

SizeLimits size_limits(const CadModel& model, const SizingOptions& options) {
  const double size = options.size > 0 ? options.size : model.diagonal() / options.elements_per_diagonal;
  const double least = options.size_min > 0 ? std::min(options.size_min, size) : size / 8;
  // A number of elements across gaps is requested by name; the default lower limit must not undercut it.
  const double at_gaps = options.proximity > 0 && options.size_min <= 0 ? size / 32 : least;
  // Points closer than this are one point to OpenCASCADE.
  const double resolution = Precision::Confusion();
  const double requested = std::min(size, smallest(model, options, size));
  if (requested < resolution)
    throw usage_error("size", fmt::format("a size of {:.3g} mm is requested, below the {:g} mm within which "
                                          "points of a CAD model coincide: use a larger size",
                                          requested, resolution));
  const double lower_limit = std::max(least, resolution);
  return {size, std::min({lower_limit, at_gaps, requested}), lower_limit, at_gaps};
}

EdgeFlags edges_below_size_min(const CadModel& model, const SizingOptions& options,
                               const SizeLimits& limits) {
  const CadShape& shape = model.shape();
  EdgeFlags result(shape.edges.size());
  if (!(limits.least < limits.size_min)) return result;
  std::vector<std::pair<Bnd_Box, double>> named;  // boxes around what has a size, and the size
  const auto add = [&](const TopoDS_Shape& part, double size) {
    const Bnd_Box box = box_of(part);
    if (!box.IsVoid()) named.emplace_back(box, size);
  };
  visit_named_sizes(model, options, limits.largest, [&](Named what, int number, double size) {
    if (!(size < limits.size_min)) return;
    if (what == Named::face) add(shape.faces[FaceId::from_number(number)].face, size);
    if (what == Named::piece) add(shape.edges[EdgeId::from_number(number)].edge, size);
    if (what == Named::vertex) {
      const Vector3& p = shape.vertices[VertexId::from_number(number)];
      named.emplace_back().second = size;
      named.back().first.Add(gp_Pnt(p.x(), p.y(), p.z()));
    }
    for (const CadEdge& edge : shape.edges) {
      if (what == Named::edge && edge.number == number) add(edge.edge, size);
    }
  });
  for (const EdgeId id : shape.edges.ids()) {
    const Bnd_Box box = box_of(shape.edges[id].edge);
    if (box.IsVoid()) continue;
    const auto reaches = [&](double size, double distance) {
      return size + options.growth * distance < limits.size_min;
    };
    const Vector3 low = to_vector(box.CornerMin()), high = to_vector(box.CornerMax());
    const double radius = 0.5 * (high - low).norm();
    result[id] = std::any_of(named.begin(), named.end(),
                             [&](const auto& at) { return reaches(at.second, at.first.Distance(box)); }) ||
                 std::any_of(options.regions.begin(), options.regions.end(), [&](const SizeRegion& region) {
                   return reaches(region.size, std::max(0.0, region.distance(0.5 * (low + high)) - radius));
                 });
  }
  return result;
}

bool has_curvature_sizes(const SizingOptions& options) {
  return options.elements_per_circle > 0 || options.chord_error.length > 0 || options.chord_error.share > 0;
}

double size_of_curvature(const SizingOptions& options, const SizeLimits& limits, double curvature) {
  if (!(curvature > 0)) return limits.largest;
  double size = limits.largest;
  if (options.elements_per_circle > 0)
    size = std::min(size, 2 * M_PI / (curvature * options.elements_per_circle));
  const auto hold = [&](double error) {  // `error`: height of the arc over its chord
    const double radius = 1 / curvature;
    if (error > 0 && error < radius) size = std::min(size, 2 * std::sqrt(error * (2 * radius - error)));
  };
  hold(options.chord_error.length);
  hold(options.chord_error.share * limits.largest);
  return std::max(limits.size_min, size);
}

const Budget& SizingField::Sampler::budget() const {
  return impl_.options.budget;
}

const SizingOptions& SizingField::options() const {
  return impl_->options;
}
const SizeLimits& SizingField::limits() const {
  return impl_->limits;
}

std::vector<SizingField::Level> SizingField::levels() const {
  std::vector<Level> levels;
  for (const auto& cascade : impl_->cascades) {
    for (int i = 0; i < cascade->levels(); ++i) {
      if (static_cast<int>(levels.size()) <= i) levels.push_back({impl_->frame.voxel(i)});
      if (cascade->tree(i) == nullptr) continue;
      levels[i].blocks += static_cast<std::int64_t>(cascade->tree(i)->leafCount());
      levels[i].bytes += static_cast<std::int64_t>(cascade->tree(i)->memUsage());
    }
  }
  return levels;
}

void SizingField::write(const std::filesystem::path& path) const {
  SizeCascade all(impl_->frame);
  BlockCount any(std::numeric_limits<double>::infinity());
  for (const auto& cascade : impl_->cascades)
    cascade->for_each([&](int level, const Coord& c, float value) { all.lower(level, c, value, any); });
  write_cascade(all, path);
}

struct SizingField::Sampler::Lookups {
  std::vector<SizeCascade::Lookup> all;
};

SizingField::Sampler::Sampler(const SizingField& field)
    : lookups_(std::make_unique<Lookups>()), impl_(*field.impl_) {
  for (const auto& cascade : impl_.cascades) lookups_->all.emplace_back(*cascade);
}

SizingField::Sampler::Sampler(const SizingField& field, FaceId face)
    : lookups_(std::make_unique<Lookups>()), impl_(*field.impl_) {
  lookups_->all.emplace_back(*impl_.cascades[impl_.cascade_of(face)]);
  directed_ = is_set(impl_.gridded, face);
}

SizingField::Sampler::Sampler(const SizingField& field, const CadEdge& edge)
    : lookups_(std::make_unique<Lookups>()), impl_(*field.impl_) {
  for (const int cascade : impl_.cascades_of(edge.faces))
    lookups_->all.emplace_back(*impl_.cascades[cascade]);
}

SizingField::Sampler::~Sampler() = default;

double SizingField::Sampler::operator()(const Vector3& point) {
  double size = impl_.limits.largest;
  for (SizeCascade::Lookup& lookup : lookups_->all) size = std::min(size, lookup(point));
  return std::clamp(size, impl_.limits.least, impl_.limits.largest);
}

double SizingField::Sampler::bent(double size, double curvature) const {
  return std::min(size, size_of_curvature(impl_.options, impl_.limits, curvature));
}

double SizingField::Sampler::across(double size, double curvature) const {
  return directed_ ? bent(size, curvature) : size;
}

double SizingField::Sampler::across(double size, const FaceSurface& surface, const Vector2& uv) const {
  return directed_ && !surface.planar() ? bent(size, surface.max_curvature(uv)) : size;
}

}  // namespace quadrille
