/// Gradation by Dijkstra's algorithm over the voxels (chamfer distances over 26 neighbors, Borgefors 1986).
/// Values only decrease, and the result is the largest field below the sources that has the requested slope.

#include "geometry/sizing/size_cascade.hpp"

#include <array>
#include <queue>
#include <utility>

#include "geometry/base/whole_number.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/sizing/vdb_module.hpp"

namespace quadrille {

namespace {

/// A level's tree holds sizes up to this multiple of the level's size.
constexpr double coverage = 1.3;
/// Voxels are as wide as the level's size at this growth or more, and wider in proportion below it. So sizes
/// change by the same amount per voxel however slow the growth, and reach only a few voxels far.
constexpr double usual_growth = 0.3;

struct Item {
  float value;
  Coord coord;
  bool operator<(const Item& other) const {
    return value != other.value ? value > other.value : other.coord < coord;
  }
};

/// The position within its voxel, coordinates 0 to 1.
Vector3 place_in(const Vector3& index, const Coord& base) {
  return index - Vector3(base.x(), base.y(), base.z());
}

}  // namespace

double widening(double growth) {
  return std::max(1.0, usual_growth / growth);
}

int level_for(double size_max, double size) {
  return to_int(std::floor(std::min(std::log2(size_max / size), 1.0 * max_size_levels)));
}

void BlockCount::add() {
  const auto count = static_cast<double>(count_.fetch_add(1, std::memory_order_relaxed) + 1);
  if (count > most_) throw too_many_blocks(count);
}

SizeTree& SizeCascade::make_tree(int level) {
  if (levels() <= level) levels_.resize(level + 1);
  std::unique_ptr<SizeTree>& tree = levels_[level].tree;
  if (!tree) tree = std::make_unique<SizeTree>(static_cast<float>(frame_.size_max));
  return *tree;
}

void SizeCascade::lower(int level, const Coord& c, float value, BlockCount& blocks) {
  if (level != last_level_) {
    accessor_ = std::make_unique<VoxelAccessor>(make_tree(level), &blocks, stamp_ + 1);
    last_level_ = level;
  }
  if (!(value < accessor_->value(c))) return;
  accessor_->set(c, value);
  levels_[level].fresh.push_back(c);
}

void SizeCascade::add(const Vector3& point, double size, BlockCount& blocks) {
  add_by_corner(point, size, blocks, [size](const Vector3&) { return size; });
}

void SizeCascade::add_means(const std::vector<SizePoint>& points, BlockCount& blocks) {
  struct Share {
    int level;
    Coord corner;
    double weight, logarithm;
  };
  std::vector<Share> shares;
  for (const SizePoint& at : points) {
    // Look-ups nearby may need all corners of voxels of the neighboring levels too.
    const int own = frame_.level_of(at.size);
    for (int level = std::max(own - 1, 0); level <= std::min(own + 1, frame_.finest); ++level) {
      if (at.size > coverage * frame_.size(level)) continue;
      const Vector3 index = at.point / frame_.voxel(level);
      const Coord base = voxel_at(index);
      const Vector3 within = place_in(index, base);
      for (int k = 0; k < 8; ++k) {
        const double weight = corner_weight(within, k);
        if (weight > 0) shares.push_back({level, corner_of(base, k), weight, std::log(at.size)});
      }
    }
  }
  std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
    return a.level != b.level ? a.level < b.level : a.corner < b.corner;
  });
  for (auto first = shares.begin(); first != shares.end();) {
    double weight = 0, sum = 0;
    auto last = first;
    for (; last != shares.end() && last->level == first->level && last->corner == first->corner; ++last) {
      weight += last->weight;
      sum += last->weight * last->logarithm;
    }
    lower(first->level, first->corner, static_cast<float>(std::exp(sum / weight)), blocks);
    first = last;
  }
}

bool SizeCascade::is_fresh() const {
  return std::any_of(levels_.begin(), levels_.end(), [](const Level& level) { return !level.fresh.empty(); });
}

void SizeCascade::grade(double slope, const Near& near, BlockCount& blocks, const ExecutionContext& context) {
  ++stamp_;
  for (int level = levels() - 1; level >= 0; --level) {
    if (level + 1 < levels()) take_over(level, blocks);
    grade_level(level, slope, near, blocks, context);
  }
  last_level_ = -1;
  accessor_.reset();
  for (Level& level : levels_) level.changed = {};
}

void SizeCascade::take_over(int level, BlockCount& blocks) {
  const Level& next = levels_[level + 1];
  if (next.changed.empty()) return;
  VoxelAccessor finer(*next.tree), here(make_tree(level), &blocks, stamp_);
  for (const Coord& c : next.changed) {
    if ((c.x() | c.y() | c.z()) & 1) continue;
    const Coord half(c.x() >> 1, c.y() >> 1, c.z() >> 1);
    const float value = finer.value(c);
    if (!(value < here.value(half))) continue;
    here.set(half, value);
    levels_[level].fresh.push_back(half);
  }
}

void SizeCascade::grade_level(int level, double slope, const Near& near, BlockCount& blocks,
                              const ExecutionContext& context) {
  std::vector<Coord>& changed = levels_[level].changed;
  changed = std::exchange(levels_[level].fresh, {});
  if (changed.empty()) return;
  SparseCheck check(context);
  VoxelAccessor accessor(*levels_[level].tree, &blocks, stamp_);
  std::vector<Item> items;
  items.reserve(changed.size());
  for (const Coord& c : changed) items.push_back({accessor.value(c), c});
  std::priority_queue<Item> queue(std::less<Item>(), std::move(items));
  const double voxel = frame_.voxel(level);
  const auto limit = static_cast<float>(std::min(frame_.size_max, coverage * frame_.size(level)));
  std::array<float, 4> step{};
  for (int k = 1; k < 4; ++k) step[k] = static_cast<float>(slope * voxel * std::sqrt(k));
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
      if (!(value < limit) || !(value < accessor.value(c))) continue;
      if (near && !near(voxel * Vector3(c.x(), c.y(), c.z()), voxel)) continue;
      accessor.set(c, value);
      changed.push_back(c);
      queue.push({value, c});
    }
  }
}

SizeCascade::Lookup::Lookup(const SizeCascade& cascade) : size_max_(cascade.frame().size_max) {
  for (int level = cascade.levels() - 1; level >= 0; --level) {
    SizeTree* tree = cascade.tree(level);
    if (tree == nullptr) continue;
    const CascadeFrame& frame = cascade.frame();
    levels_.push_back({1 / frame.voxel(level), frame.size(level), level == 0, VoxelAccessor(*tree)});
  }
}

double SizeCascade::Lookup::operator()(const Vector3& point) {
  for (auto& [scale, limit, coarsest, accessor] : levels_) {
    const Vector3 index = point * scale;
    const Coord base = voxel_at(index);
    const Vector3 within = place_in(index, base);
    double value = 0;
    int active = 0;
    for (int k = 0; k < 8; ++k) {
      float corner = 0;
      active += accessor.probe(corner_of(base, k), corner);
      value += corner_weight(within, k) * corner;
    }
    if (coarsest || (active == 8 && value <= limit)) return std::min(value, size_max_);
  }
  return size_max_;
}

}  // namespace quadrille
