#pragma once
/// Point-in-domain test in the parameter plane of a face.

#include <vector>

#include "geometry/base/rows.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

/// A planar domain bounded by segments in any order, with the even-odd rule. It is divided into horizontal
/// slabs, as many as segments (at most 2^20). A query costs the segments that cross one slab: usually a few.
class TrimmedDomain {
 public:
  /// A side of the outline.
  struct Segment {
    Vector2 a /**< where it begins */, b; /**< where it ends */
  };

  TrimmedDomain() = default;
  explicit TrimmedDomain(std::vector<Segment> segments);  ///< segments: the sides of the outline

  bool inside(const Vector2& p) const;                ///< whether the point lies in the domain
  bool empty() const { return segments_.empty(); }    ///< whether it has no outline
  const Vector2& low() const { return box_.min(); }   ///< lowest corner of the bounding box
  const Vector2& high() const { return box_.max(); }  ///< highest corner of the bounding box

 private:
  int slab(double y) const;

  std::vector<Segment> segments_;
  Rows<> members_;  // the segments of each slab
  Eigen::AlignedBox2d box_{Vector2(0, 0)};
  double slab_scale_ = 0;
  int slab_count_ = 0;
};

}  // namespace quadrille
