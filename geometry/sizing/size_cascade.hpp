#pragma once
/// Sizes in voxels of several widths. Internal.

// The tree alone, without what would load leaves from files later: that needs OpenVDB's library, whose
// loading takes longer than meshing a small part. Files go through the module of vdb_module.hpp, as plain
// values.
#include <openvdb/version.h>
#undef OPENVDB_USE_DELAYED_LOADING
#include <openvdb/tree/InternalNode.h>
#include <openvdb/tree/LeafNode.h>
#include <openvdb/tree/RootNode.h>

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"
#include "geometry/sizing/size_file.hpp"

namespace quadrille {

using openvdb::Coord;
using SizeLeaf = openvdb::tree::LeafNode<float, 3>;
/// A tree with nodes so small that each face may have some.
using SizeTree = openvdb::tree::RootNode<openvdb::tree::InternalNode<SizeLeaf, 2>>;

constexpr int max_size_levels = 32;

/// By how much voxels are wider than the sizes of their level.
double widening(double growth);

/// The level whose sizes lie between this one and twice it, counted from the coarsest.
int level_for(double size_max, double size);

/// Counts the leaves of a field against its budget. Thread-safe.
class BlockCount {
 public:
  explicit BlockCount(double most) : most_(most) {}
  void add();

 private:
  double most_;
  std::atomic<std::int64_t> count_{0};
};

/// Reads and writes voxels, remembering the leaf it was in.
class VoxelAccessor {
 public:
  /// \param made counts the leaves made; may be null where none is. \param stamp is left on leaves that are
  /// written to.
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
  /// Of the leaf that a voxel is in; 0 where there is none.
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

/// What all cascades of a field have in common.
struct CascadeFrame {
  double size_max = 0;
  double growth = 0;  ///< that voxels are made for
  int finest = 0;     ///< level whose voxels can be numbered all over the model

  double size(int level) const;
  double voxel(int level) const;
  int level_of(double size) const;
};

/// A cascade of trees with voxels of size_max / 2^k, each active only where the size is about its voxel, so
/// that small features cost what they need and no more. One thread at a time, except for Lookup.
class SizeCascade {
 public:
  explicit SizeCascade(const CascadeFrame& frame) : frame_(frame) {}

  const CascadeFrame& frame() const { return frame_; }
  int levels() const { return static_cast<int>(trees_.size()); }
  /// Null where no size is of that level.
  SizeTree* tree(int level) const { return trees_[level].get(); }

  /// The size at a point and, so that it comes out of the voxels as it went in, at all corners of its voxel,
  /// is at most this.
  void add(const Vector3& point, double size, BlockCount& blocks);

  /// The same with a size of each corner's own.
  void add_by_corner(const Vector3& point, double size, BlockCount& blocks,
                     const std::function<double(const Vector3& corner)>& size_at);

  /// Puts the mean of the points about it into each voxel's corner, on all levels that look-ups near them may
  /// come to.
  void add_means(const std::vector<SizePoint>& points, BlockCount& blocks);

  /// Whether something was added since it was graded.
  bool is_fresh() const;
  /// What leaves are stamped with that the last grading, or what was added before it, has changed.
  std::uint32_t stamp() const { return stamp_; }

  /// What voxels are worth having: true at all corners of voxels where sizes will be looked up. Empty = all.
  using Near = std::function<bool(const Vector3& point, double voxel)>;

  /// Lets sizes grow outward from what was added since the last time, by at most `slope` per length, up to
  /// `most`. Coarser levels take over the values of finer ones.
  void grade(double slope, double most, const Near& near, BlockCount& blocks,
             const ExecutionContext& context);

  /// Seconds that the gradings of a level have taken.
  double seconds(int level) const { return seconds_[level]; }

  /// Visits all active voxels: visit(level, coordinates, value).
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::vector<SizeLeaf*> leaves;
    for (int level = 0; level < levels(); ++level) {
      if (!trees_[level]) continue;
      leaves.clear();
      trees_[level]->getNodes(leaves);
      for (const SizeLeaf* leaf : leaves) {
        for (auto it = leaf->cbeginValueOn(); it; ++it) visit(level, it.getCoord(), *it);
      }
    }
  }

  /// Makes a voxel's value at most this.
  void lower(int level, const Coord& c, float value, BlockCount& blocks);

  /// Looks sizes up by interpolation; one a thread. The cascade must not change meanwhile.
  class Lookup {
   public:
    explicit Lookup(const SizeCascade& cascade);
    /// At most size_max.
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
  SizeTree& make_tree(int level);
  void grade_level(int level, double slope, double most, const Near& near, BlockCount& blocks,
                   const ExecutionContext& context);
  /// What a level takes over from the next finer one.
  void take_over(int level, BlockCount& blocks);

  CascadeFrame frame_;
  std::vector<std::unique_ptr<SizeTree>> trees_;
  std::vector<std::vector<Coord>> fresh_;    // (levels) lowered since the last grading
  std::vector<std::vector<Coord>> changed_;  // (levels) lowered by it
  std::array<double, max_size_levels> seconds_{};
  std::unique_ptr<VoxelAccessor> accessor_;  // of the level that was added to last
  int last_level_ = -1;
  std::uint32_t stamp_ = 0;  // number of gradings
};

}  // namespace quadrille
