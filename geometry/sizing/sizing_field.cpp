/// Gradation by Dijkstra's algorithm over the voxels (chamfer distances over 26 neighbors, Borgefors 1986):
/// a monotone min-update, so that the result is the largest field under the sources with the slope asked for.
/// Size from curvature: 2 pi R / (elements a circle), as in Gmsh's and Netgen's manuals.

#include "geometry/sizing/sizing_field.hpp"

// The tree alone, without what would load leaves from files later: that needs OpenVDB's library, whose
// loading takes longer than meshing a small part. Files go through the module of vdb_module.hpp, as plain
// values.
#include <openvdb/version.h>
#undef OPENVDB_USE_DELAYED_LOADING
#include <openvdb/tree/InternalNode.h>
#include <openvdb/tree/LeafNode.h>
#include <openvdb/tree/RootNode.h>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>

#include <fmt/format.h>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/trimmed_domain.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/isolated_reading.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/vdb_module.hpp"
#include "geometry/surfaces/edge_curve.hpp"
#include "geometry/surfaces/face_surface.hpp"

namespace quadrille {

namespace {

using openvdb::Coord;
using Leaf = openvdb::tree::LeafNode<float, 3>;
/// The nodes of OpenVDB's FloatTree.
using Root = openvdb::tree::RootNode<openvdb::tree::InternalNode<openvdb::tree::InternalNode<Leaf, 4>, 5>>;

/// A level's grid covers sizes up to this many of its voxels.
constexpr double coverage = 1.3;
constexpr int max_levels = 32;
/// Up to this growth a voxel is as wide as it is with it: then sizes change by as much over one whatever the
/// growth, and its values reach as few voxels far.
constexpr double usual_growth = 0.3;
/// Slower growth is none: single precision does not tell.
constexpr double least_growth = 1e-9;
/// Blocks that a voxel's length of an edge takes: the field about it is some five voxels wide, and the
/// coarser levels take it over, each a half.
constexpr double blocks_a_voxel = 0.85;
/// Of halving an edge or a face's parameters; the budget ends it before.
constexpr int max_depth = 40;

/// By how much voxels are wider than the sizes of their level.
double widening(double growth) {
  return std::max(1.0, usual_growth / std::max(growth, least_growth));
}

/// The level whose sizes lie between this one and twice it, counted from the coarsest.
int level_for(double size_max, double size) {
  return static_cast<int>(std::floor(std::min(std::log2(size_max / size), 1.0 * max_levels)));
}

/// Counts the leaves of a field against its budget.
class BlockCount {
 public:
  explicit BlockCount(double most) : most_(most) {}
  void add() {
    if (++count_ <= most_) return;
    throw too_many_blocks(count_);
  }

 private:
  double most_, count_ = 0;
};

/// Reads and writes voxels, remembering the leaf it was in.
class Accessor {
 public:
  /// \param made counts the leaves made; may be null where none is.
  explicit Accessor(Root& root, BlockCount* made = nullptr) : root_(&root), made_(made) {}

  float value(const Coord& c) {
    enter(c);
    return leaf_ ? leaf_->getValue(c) : root_->background();
  }
  /// \return whether the voxel is active.
  bool probe(const Coord& c, float& value) {
    enter(c);
    if (leaf_) return leaf_->probeValue(c, value);
    value = root_->background();
    return false;
  }
  void set(const Coord& c, float value) {
    enter(c);
    if (!leaf_) {
      made_->add();
      leaf_ = root_->touchLeaf(c);
    }
    leaf_->setValueOn(c, value);
  }

 private:
  void enter(const Coord& c) {
    const Coord origin = c & ~(Leaf::DIM - 1);
    if (known_ && origin == origin_) return;
    known_ = true;
    origin_ = origin;
    leaf_ = root_->probeLeaf(c);
  }

  Root* root_;
  BlockCount* made_;
  Leaf* leaf_ = nullptr;
  Coord origin_;
  bool known_ = false;
};

template <class Visit>
void for_each_voxel(Root& root, Visit&& visit) {
  std::vector<Leaf*> leaves;
  root.getNodes(leaves);
  for (Leaf* leaf : leaves) {
    for (auto it = leaf->cbeginValueOn(); it; ++it) visit(it.getCoord(), *it);
  }
}

const Module& vdb_module() {
  static const Module module("quadrille_vdb");
  return module;
}

}  // namespace

class SizingField::Impl {
 public:
  double size_max = 0, size_min = 0, growth = 0;
  Budget budget;
  int finest = 0;  // level whose voxels can be numbered all over the model
  std::vector<std::unique_ptr<Root>>
      levels;  // for sizes about size_max / 2^k; null where no size is as small

  double size(int level) const { return std::ldexp(size_max, -level); }
  double voxel(int level) const { return size(level) * widening(growth); }
  int level_of(double size) const { return std::clamp(level_for(size_max, size), 0, finest); }
  Root& grid(int level) {
    if (static_cast<int>(levels.size()) <= level) levels.resize(level + 1);
    if (!levels[level]) levels[level] = std::make_unique<Root>(static_cast<float>(size_max));
    return *levels[level];
  }
};

namespace {

/// Collects the sources of a model into the grids of a field.
class Builder {
 public:
  Builder(const CadModel& model, const SizingOptions& options, const UnsizedFeatures& unsized,
          SizingField::Impl& field, ExecutionContext& context)
      : shape_(model.shape()),
        unsized_(unsized),
        options_(options),
        limits_{field.size_max, field.size_min},
        field_(field),
        context_(context),
        blocks_(options.budget.blocks) {
    if (options.size_field.empty()) return;
    const std::string path = options.size_field.string();
    const auto open = [&] {
      const std::string problem = vdb_module().function<VdbOpenFunction>("_open")(path, external_);
      if (!problem.empty()) throw failure(path, problem);
      return TopoDS_Shape();
    };
    // OpenVDB believes whatever lengths a damaged file gives: tried apart, where it may crash or want no end
    // of memory.
    constexpr std::size_t room = std::size_t{1} << 30, room_each_byte = 20;
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(options.size_field, unknown);
    read_isolated(path, open, &context, 0, room + (unknown ? 0 : room_each_byte * bytes));
    open();
  }

  void run() {
    hold_segments();
    Sources sources(*this);
    for (std::size_t i = 0; i < shape_.edges.size(); ++i) add_edge(static_cast<int>(i), sources);
    std::atomic<int> done{0};
    const int faces = static_cast<int>(shape_.faces.size());
    oneapi::tbb::parallel_for(0, faces, [&](int face) {
      Sources sources_here(*this);
      add_face(face, sources_here);
      sources_here.pass_on();
      context_.report(Stage::size,
                      static_cast<double>(done.fetch_add(1, std::memory_order_relaxed) + 1) / faces);
    });
    for (const auto& [vertex, size] : options_.vertex_sizes) sources.add(shape_.vertices[vertex - 1], size);
    sources.pass_on();
    for (int level = static_cast<int>(field_.levels.size()) - 1; level >= 0; --level) grade(level);
  }

 private:
  /// Sizes that one thread has found. What is passed on is the least at each voxel, whoever comes first.
  class Sources {
   public:
    explicit Sources(Builder& builder) : builder_(builder), check_(builder.context_, 256) {}

    /// To be called at each step of a search.
    void check() { check_(); }

    void add(const Vector3& p, double size) {
      if (!(size < builder_.field_.size_max)) return;
      sources_.emplace_back(p, size);
      constexpr std::size_t most = 4096;
      if (sources_.size() >= most) pass_on();
    }

    void pass_on() {
      const std::lock_guard lock(builder_.mutex_);
      for (const auto& [p, size] : sources_) builder_.add_source(p, size);
      sources_.clear();
    }

   private:
    Builder& builder_;
    SparseCheck check_;
    std::vector<std::pair<Vector3, double>> sources_;
  };

  double size_of(double curvature) const { return size_of_curvature(options_, limits_, curvature); }

  double external_size(const Vector3& p) const {
    return external_ ? std::max(external_(p), field_.size_min) : field_.size_max;
  }

  void add_source(const Vector3& p, double size) {
    const int level = field_.level_of(size);
    if (level != last_level_) {
      accessor_.emplace(field_.grid(level), &blocks_);
      last_level_ = level;
    }
    const double scale = 1 / field_.voxel(level);
    const Coord base = Coord::floor(openvdb::Vec3d(p.x() * scale, p.y() * scale, p.z() * scale));
    const auto value = static_cast<float>(size);
    for (int k = 0; k < 8; ++k) {
      const Coord c = base.offsetBy(k & 1, k >> 1 & 1, k >> 2);
      if (value < accessor_->value(c)) accessor_->set(c, value);
    }
  }

  /// The size asked for on an edge by itself and by its length.
  double cap_of(const CadEdge& edge) const {
    double cap = field_.size_max;
    if (const auto it = options_.edge_sizes.find(edge.number); it != options_.edge_sizes.end())
      cap = it->second;
    // A short edge is one element: its surroundings are refined towards it.
    return std::min(cap, std::max(edge.length, field_.size_min));
  }

  /// Throws Error (usage) if the edges' lengths alone pass the budget of segments, or that of blocks.
  void hold_segments() const {
    double sum = 0, most = 0, blocks = 0;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < shape_.edges.size(); ++i) {
      const CadEdge& edge = shape_.edges[i];
      if (edge.degenerate || edge.faces.empty() || !(edge.length > 0)) continue;
      const double segments = edge.length / cap_of(edge);
      sum += segments;
      if (cap_of(edge) < field_.size_max)
        blocks += blocks_a_voxel * edge.length / field_voxel(field_.size_max, cap_of(edge), field_.growth);
      if (segments <= most) continue;
      most = segments;
      longest = i;
    }
    if (sum > options_.budget.segments) throw too_many_segments(longest, most);
    if (blocks > options_.budget.blocks) throw too_many_blocks(blocks);
  }

  Error too_many_segments(std::size_t edge, double segments) const {
    return usage_error(
        "size",
        fmt::format(
            "Edge{} of {:.3g} mm would take about {:.3g} million segments at the sizes asked for, and "
            "all edges more than {:g} million: `force` meshes all the same",
            edge + 1, shape_.edges[edge].length, segments / 1e6, options_.budget.segments / 1e6));
  }

  void add_edge(int index, Sources& sources) const {
    sources.check();
    const CadEdge& edge = shape_.edges[index];
    if (edge.degenerate || edge.faces.empty() || edge.length <= 0) return;
    if (unsized_.edge(index) && !options_.edge_sizes.contains(edge.number)) return;
    const EdgeCurve curve(edge);
    double cap = cap_of(edge);
    if (curve.straight()) {
      if (cap < field_.size_max || external_) sample_edge(curve, edge, cap, false, sources);
      return;
    }
    if (curve.circular()) cap = std::min(cap, size_of(curve.curvature(edge.first)));
    sample_edge(curve, edge, cap, !curve.circular(), sources);
  }

  struct EdgeSample {
    double t;
    Vector3 point;
    double size;
  };

  void sample_edge(const EdgeCurve& curve, const CadEdge& edge, double cap, bool with_curvature,
                   Sources& sources) const {
    const int intervals = std::max({4, with_curvature ? 3 * curve.spans() : 1,
                                    static_cast<int>(std::ceil(edge.length / field_.size_max))});
    const auto size_at = [&](double t, const Vector3& p) {
      const double size = std::min(cap, external_size(p));
      return with_curvature ? std::min(size, size_of(curve.curvature(t))) : size;
    };
    const auto sample = [&](double t) {
      const Vector3 point = curve.point(t);
      return EdgeSample{t, point, size_at(t, point)};
    };
    EdgeSample first = sample(edge.first);
    sources.add(first.point, first.size);
    for (int i = 1; i <= intervals; ++i) {
      const EdgeSample last = sample(edge.first + (edge.last - edge.first) * i / intervals);
      const double segments = (last.point - first.point).norm() / std::min(first.size, last.size);
      if (segments > options_.budget.segments) throw too_many_segments(&edge - shape_.edges.data(), segments);
      split_interval(sample, first, last, 0, sources);
      sources.add(last.point, last.size);
      first = last;
    }
  }

  /// Adds the sample half way between two, and those half way to it, until they are as near as the size
  /// there.
  template <class SampleAt>
  void split_interval(const SampleAt& sample, const EdgeSample& first, const EdgeSample& last, int depth,
                      Sources& sources) const {
    sources.check();
    if ((last.point - first.point).norm() <= std::min(first.size, last.size) || depth > max_depth) return;
    const EdgeSample middle = sample(0.5 * (first.t + last.t));
    if (std::min({first.size, middle.size, last.size}) >= field_.size_max) return;
    sources.add(middle.point, middle.size);
    split_interval(sample, first, middle, depth + 1, sources);
    split_interval(sample, middle, last, depth + 1, sources);
  }

  void add_face(int index, Sources& sources) const {
    const CadFace& face = shape_.faces[index];
    if (unsized_.face(index) && !options_.face_sizes.contains(index + 1)) return;
    const FaceSurface surface(face);
    double cap = field_.size_max;
    if (const auto it = options_.face_sizes.find(index + 1); it != options_.face_sizes.end())
      cap = it->second;
    const bool curved = !surface.planar() && options_.elements_per_circle > 0;
    if (!curved && cap >= field_.size_max && !external_) return;
    const TrimmedDomain domain = coarse_domain(shape_, face);
    const auto size_at = [&](const Vector2& uv, const Vector3& p) {
      const double size = std::min(cap, external_size(p));
      return curved ? std::min(size, size_of(surface.max_curvature(uv))) : size;
    };
    const Vector2 low(face.u_min, face.v_min), extent(face.u_max - face.u_min, face.v_max - face.v_min);
    const Vector2 lengths = extent.cwiseProduct(surface.mean_scale());
    const int nu = std::clamp(static_cast<int>(std::ceil(lengths.x() / field_.size_max)), 4, 400);
    const int nv = std::clamp(static_cast<int>(std::ceil(lengths.y() / field_.size_max)), 4, 400);
    const Vector2 cell(extent.x() / nu, extent.y() / nv);
    const auto sample = [&](const Vector2& middle, const Vector2& part) {
      const SurfacePoint at = surface.evaluate(middle);
      const double size = size_at(middle, at.point);
      if (size < field_.size_max && domain.inside(middle)) sources.add(at.point, size);
      return CellSample{size, part.x() * at.du.norm(), part.y() * at.dv.norm()};
    };
    for (int j = 0; j < nv; ++j) {
      for (int i = 0; i < nu; ++i) {
        const Vector2 middle = low + Vector2((i + 0.5) * cell.x(), (j + 0.5) * cell.y());
        split_cell(sample, middle, cell, 0, sources);
      }
    }
  }

  /// The size in the middle of a cell of the parameter plane, and how long and wide the cell is in space.
  struct CellSample {
    double size, length, width;
  };

  /// Samples the middle of a cell of the parameter plane, and its parts where the size is below the cell's.
  template <class SampleAt>
  void split_cell(const SampleAt& sample, const Vector2& middle, const Vector2& cell, int depth,
                  Sources& sources) const {
    sources.check();
    const auto [size, length, width] = sample(middle, cell);
    const bool split_u = length > 1.5 * size, split_v = width > 1.5 * size;
    if ((!split_u && !split_v) || depth > max_depth || size >= field_.size_max) return;
    const int nu = split_u ? 2 : 1, nv = split_v ? 2 : 1;
    const Vector2 part(cell.x() / nu, cell.y() / nv);
    for (int j = 0; j < nv; ++j) {
      for (int i = 0; i < nu; ++i) {
        const Vector2 offset((i + 0.5) * part.x() - 0.5 * cell.x(), (j + 0.5) * part.y() - 0.5 * cell.y());
        split_cell(sample, middle + offset, part, depth + 1, sources);
      }
    }
  }

  /// Lets a level's values grow outward up to its coverage, after taking over those of the finer level.
  void grade(int level) {
    SparseCheck check(context_);
    const int finest = static_cast<int>(field_.levels.size()) - 1;
    const bool finer = level < finest && field_.levels[level + 1];
    if (!field_.levels[level] && !finer) return;
    Root& grid = field_.grid(level);
    Accessor accessor(grid, &blocks_);
    if (finer) {
      for_each_voxel(*field_.levels[level + 1], [&](const Coord& c, float value) {
        check();
        if ((c.x() | c.y() | c.z()) & 1) return;
        const Coord half(c.x() >> 1, c.y() >> 1, c.z() >> 1);
        if (value < accessor.value(half)) accessor.set(half, value);
      });
    }
    struct Item {
      float value;
      Coord coord;
      bool operator<(const Item& other) const {
        return value != other.value ? value > other.value : other.coord < coord;
      }
    };
    std::vector<Item> items;
    for_each_voxel(grid, [&](const Coord& c, float value) {
      check();
      items.push_back({value, c});
    });
    std::priority_queue<Item> queue(std::less<Item>(), std::move(items));
    const double voxel = field_.voxel(level);
    const auto limit = static_cast<float>(std::min(field_.size_max, coverage * field_.size(level)));
    std::array<float, 4> step{};
    for (int k = 1; k < 4; ++k) step[k] = static_cast<float>(field_.growth * voxel * std::sqrt(k));
    while (!queue.empty()) {
      const Item item = queue.top();
      queue.pop();
      check();
      if (item.value + step[1] >= limit) break;
      if (item.value > accessor.value(item.coord)) continue;
      for (int k = 0; k < 27; ++k) {
        const int dx = k % 3 - 1, dy = k / 3 % 3 - 1, dz = k / 9 - 1;
        const int steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
        if (steps == 0) continue;
        const float value = item.value + step[steps];
        const Coord c = item.coord.offsetBy(dx, dy, dz);
        if (value < limit && value < accessor.value(c)) {
          accessor.set(c, value);
          queue.push({value, c});
        }
      }
    }
  }

  const CadShape& shape_;
  const UnsizedFeatures& unsized_;
  const SizingOptions& options_;
  SizeLimits limits_;
  SizingField::Impl& field_;
  ExecutionContext& context_;
  BlockCount blocks_;
  std::mutex mutex_;  // of what follows but external_, and of the grids
  std::function<double(const Vector3&)> external_;
  std::optional<Accessor> accessor_;
  int last_level_ = -1;
};

double smallest(const SizingOptions& options) {
  double result = std::numeric_limits<double>::infinity();
  for (const auto* sizes : {&options.face_sizes, &options.edge_sizes, &options.vertex_sizes}) {
    for (const auto& [number, size] : *sizes) result = std::min(result, size);
  }
  return result;
}

}  // namespace

SizingField SizingField::build(const CadModel& model, const SizingOptions& options, ExecutionContext& context,
                               const UnsizedFeatures& unsized) {
  auto impl = std::make_shared<Impl>();
  const SizeLimits limits = size_limits(model, options);
  impl->growth = std::max(options.growth, least_growth);
  impl->size_max = limits.largest;
  impl->size_min = limits.least;
  impl->budget = options.budget;
  // The trees number voxels by 32 bits.
  const double reach = std::max(model.box_min().cwiseAbs().maxCoeff(), model.box_max().cwiseAbs().maxCoeff());
  const int bits = 30 - std::ilogb(reach / impl->voxel(0) + 1);
  if (bits < 0) {
    throw usage_error("size",
                      fmt::format("the size {:.3g} cannot be told apart at {:.3g} mm from the origin: "
                                  "move the model there, or ask for a larger size",
                                  limits.largest, reach));
  }
  impl->finest = std::min(bits, max_levels - 1);
  Builder(model, options, unsized, *impl, context).run();
  return SizingField(std::move(impl));
}

double field_voxel(double size_max, double size, double growth) {
  return std::ldexp(size_max, -level_for(size_max, size)) * widening(growth);
}

Error too_many_blocks(double blocks) {
  return usage_error(
      "size", fmt::format("the sizes asked for need a sizing field of {:.3g} million voxels or more: ask "
                          "for larger ones, or `force` it",
                          blocks * Leaf::NUM_VALUES / 1e6));
}

SizeLimits size_limits(const CadModel& model, const SizingOptions& options) {
  const double size = options.size > 0 ? options.size : model.diagonal() / options.elements_per_diagonal;
  const double least = options.size_min > 0 ? std::min(options.size_min, size) : size / 8;
  return {size, std::min(least, smallest(options))};
}

double size_of_curvature(const SizingOptions& options, const SizeLimits& limits, double curvature) {
  if (options.elements_per_circle <= 0 || curvature <= 0) return limits.largest;
  return std::max(limits.least, 2 * M_PI / (curvature * options.elements_per_circle));
}

const Budget& SizingField::Sampler::budget() const {
  return impl_.budget;
}
double SizingField::size_max() const {
  return impl_->size_max;
}
double SizingField::size_min() const {
  return impl_->size_min;
}

void SizingField::write(const std::filesystem::path& path) const {
  VdbField field{{}, impl_->size_max, impl_->growth};
  for (std::size_t k = 0; k < std::max<std::size_t>(impl_->levels.size(), 1); ++k) {
    Root* root = k < impl_->levels.size() ? impl_->levels[k].get() : nullptr;
    if (!root && k > 0) continue;
    VdbLevel& level = field.levels.emplace_back();
    level.name = k == 0 ? "size" : fmt::format("size_{}", k);
    level.voxel = impl_->voxel(static_cast<int>(k));
    if (!root) continue;
    for_each_voxel(*root, [&](const Coord& c, float value) {
      level.coordinates.push_back({c.x(), c.y(), c.z()});
      level.values.push_back(value);
    });
  }
  std::string bytes;
  const std::string problem = vdb_module().function<VdbFileFunction>("_file")(field, bytes);
  if (!problem.empty()) throw failure(path.string(), fmt::format("{}: {}", path.string(), problem));
  write_file(path, bytes);
}

struct SizingField::Sampler::Accessors {
  struct Level {
    double scale, limit;
    bool coarsest;
    Accessor accessor;
  };
  std::vector<Level> levels;  // finest first
};

SizingField::Sampler::Sampler(const SizingField& field)
    : accessors_(std::make_unique<Accessors>()), impl_(*field.impl_) {
  for (int level = static_cast<int>(impl_.levels.size()) - 1; level >= 0; --level) {
    if (!impl_.levels[level]) continue;
    accessors_->levels.push_back(
        {1 / impl_.voxel(level), impl_.size(level), level == 0, Accessor(*impl_.levels[level])});
  }
}

SizingField::Sampler::~Sampler() = default;

double SizingField::Sampler::operator()(const Vector3& point) {
  for (auto& [scale, limit, coarsest, accessor] : accessors_->levels) {
    const Vector3 index = point * scale;
    const Coord base = Coord::floor(openvdb::Vec3d(index.x(), index.y(), index.z()));
    const Vector3 t(index.x() - base.x(), index.y() - base.y(), index.z() - base.z());
    double value = 0;
    int active = 0;
    for (int k = 0; k < 8; ++k) {
      const double weight =
          ((k & 1) ? t.x() : 1 - t.x()) * ((k >> 1 & 1) ? t.y() : 1 - t.y()) * ((k >> 2) ? t.z() : 1 - t.z());
      float corner = 0;
      active += accessor.probe(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), corner);
      value += weight * corner;
    }
    if (coarsest || (active == 8 && value <= limit)) return std::clamp(value, impl_.size_min, impl_.size_max);
  }
  return impl_.size_max;
}

}  // namespace quadrille
