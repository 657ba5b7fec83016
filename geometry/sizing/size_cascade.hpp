#pragma once
/// Sizes stored in voxels of several widths. Internal.

// Only the tree, without delayed loading of leaves from files: that needs OpenVDB's library, which takes
// longer to load than meshing a small part. Files go through the module of vdb_module.hpp, as plain values.
#include <openvdb/version.h>
#undef OPENVDB_USE_DELAYED_LOADING
#include <openvdb/tree/InternalNode.h>
#include <openvdb/tree/LeafNode.h>
#include <openvdb/tree/RootNode.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/sizing/size_file.hpp"

namespace quadrille {

using openvdb::Coord;
using SizeLeaf = openvdb::tree::LeafNode<float, 3>;
/// A tree with nodes small enough for each face to have its own.
using SizeTree = openvdb::tree::RootNode<openvdb::tree::InternalNode<SizeLeaf, 2>>;

/// The voxel that contains a point. \param index the point in voxel widths.
inline Coord voxel_at(const Vector3& index) {
  return Coord::floor(openvdb::Vec3d(index.x(), index.y(), index.z()));
}

/// The k-th corner of a voxel, see corner_weight().
inline Coord corner_of(const Coord& base, int k) {
  return base.offsetBy(k & 1, k >> 1 & 1, k >> 2);
}

constexpr int max_size_levels = 32;

/// The ratio of the voxel width to the size of the level.
double widening(double growth);

/// The level, counted from the coarsest, whose size is at least `size` and less than twice it.
int level_for(double size_max, double size);

/// Counts the leaves of a field; throws Error (usage) beyond the budget. Thread-safe.
class BlockCount {
 public:
  explicit BlockCount(double most) : most_(most) {}
  void add();

 private:
  double most_;
  std::atomic<std::int64_t> count_{0};
};

/// Reads and writes voxels, caching the last leaf.
class VoxelAccessor {
 public:
  /// \param made counts new leaves; may be null for reading. \param stamp is put on leaves that are written.
  explicit VoxelAccessor(SizeTree& root, BlockCount* made = nullptr, std::uint32_t stamp = 0)
      : root_(&root), made_(made), stamp_(stamp) {}

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
    leaf_->setTransientData(stamp_);
  }
  /// The stamp of the leaf that contains a voxel; 0 where there is none.
  std::uint32_t stamp(const Coord& c) {
    enter(c);
    return leaf_ ? leaf_->transientData() : 0;
  }

 private:
  void enter(const Coord& c) {
    const Coord origin = c & ~(SizeLeaf::DIM - 1);
    if (known_ && origin == origin_) return;
    known_ = true;
    origin_ = origin;
    leaf_ = root_->probeLeaf(c);
  }

  SizeTree* root_;
  BlockCount* made_;
  std::uint32_t stamp_;
  SizeLeaf* leaf_ = nullptr;
  Coord origin_;
  bool known_ = false;
};

/// The parameters that all cascades of a field share.
struct CascadeFrame {
  double size_max = 0;
  double growth = 0;  ///< gradation that the voxel width is chosen for
  int finest = 0;     ///< finest level whose voxel indices fit the whole model

  double size(int level) const { return std::ldexp(size_max, -level); }
  double voxel(int level) const { return size(level) * widening(growth); }
  int level_of(double size) const { return std::clamp(level_for(size_max, size), 0, finest); }
};

/// A cascade of trees for sizes of size_max / 2^k. Each tree's voxels are active only where the size is about
/// that of its level, so small features cost no more than they need. One thread at a time, but for Lookup.
class SizeCascade {
 public:
  explicit SizeCascade(const CascadeFrame& frame) : frame_(frame) {}

  const CascadeFrame& frame() const { return frame_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  /// Null if the level has no sizes.
  SizeTree* tree(int level) const { return levels_[level].tree.get(); }

  /// Limits the size at a point. All corners of the voxel around it are limited, so that a look-up at the
  /// point returns the size unchanged.
  void add(const Vector3& point, double size, BlockCount& blocks);

  /// The same, with a separate size for each corner, size_at(corner).
  template <class SizeAt>
  void add_by_corner(const Vector3& point, double size, BlockCount& blocks, const SizeAt& size_at) {
    const int level = frame_.level_of(size);
    const double voxel = frame_.voxel(level);
    const Coord base = voxel_at(point / voxel);
    for (int k = 0; k < 8; ++k) {
      const Coord c = corner_of(base, k);
      lower(level, c, static_cast<float>(size_at(voxel * Vector3(c.x(), c.y(), c.z()))), blocks);
    }
  }

  /// Sets each voxel corner to the weighted geometric mean of the points around it, on all levels that
  /// look-ups near the points may read.
  void add_means(const std::vector<SizePoint>& points, BlockCount& blocks);

  /// Whether sizes were added since the last grading.
  bool is_fresh() const;
  /// The stamp of leaves that the last grading, or additions before it, have changed.
  std::uint32_t stamp() const { return stamp_; }

  /// Which voxels are needed: true at all corners of voxels where sizes will be looked up. Empty = all.
  using Near = std::function<bool(const Vector3& point, double voxel)>;

  /// Lets sizes grow outward from what was added since the last grading, by at most `slope` per unit of
  /// length. Coarser levels take over the values of finer ones.
  void grade(double slope, const Near& near, BlockCount& blocks, const ExecutionContext& context);

  /// Visits all active voxels: visit(level, coordinates, value).
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::vector<SizeLeaf*> leaves;
    for (int level = 0; level < levels(); ++level) {
      if (tree(level) == nullptr) continue;
      leaves.clear();
      tree(level)->getNodes(leaves);
      for (const SizeLeaf* leaf : leaves) {
        for (auto it = leaf->cbeginValueOn(); it; ++it) visit(level, it.getCoord(), *it);
      }
    }
  }

  /// Lowers a voxel's value to `value` if it is larger.
  void lower(int level, const Coord& c, float value, BlockCount& blocks);

  /// Looks up sizes by interpolation. Use one object per thread. The cascade must not change meanwhile.
  class Lookup {
   public:
    explicit Lookup(const SizeCascade& cascade);
    /// The size at a point, at most size_max.
    double operator()(const Vector3& point);

   private:
    struct Level {
      double scale, limit;
      bool coarsest;
      VoxelAccessor accessor;
    };
    std::vector<Level> levels_;  // finest first
    double size_max_;
  };

 private:
  struct Level {
    std::unique_ptr<SizeTree> tree;
    std::vector<Coord> fresh;    // voxels lowered since the last grading
    std::vector<Coord> changed;  // voxels lowered before or by the current grading
  };

  SizeTree& make_tree(int level);
  void grade_level(int level, double slope, const Near& near, BlockCount& blocks,
                   const ExecutionContext& context);
  /// Copies smaller values from the next finer level.
  void take_over(int level, BlockCount& blocks);

  CascadeFrame frame_;
  std::vector<Level> levels_;
  std::unique_ptr<VoxelAccessor> accessor_;  // for the level lowered last
  int last_level_ = -1;
  std::uint32_t stamp_ = 0;  // number of gradings
};

}  // namespace quadrille
