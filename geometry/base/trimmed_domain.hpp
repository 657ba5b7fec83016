#pragma once
/// Point-in-domain test in the parameter plane of a face.

#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// A planar domain bounded by segments in any order, inside by the even-odd rule. Queries cost the number of
/// segments that cross one of as many horizontal slabs as there are segments: a few.
class TrimmedDomain {
 public:
  /// A side of the outline.
  struct Segment {
    Vector2 a /**< where it begins */, b; /**< where it ends */
  };

  TrimmedDomain() = default;
  explicit TrimmedDomain(std::vector<Segment> segments);  ///< of the sides of its outline

  bool inside(const Vector2& p) const;              ///< whether the point lies in it
  bool empty() const { return segments_.empty(); }  ///< whether it has no outline
  const Vector2& low() const { return low_; }       ///< corner of the box round it
  const Vector2& high() const { return high_; }     ///< corner of the box round it

 private:
  int slab(double y) const;

  std::vector<Segment> segments_;
  std::vector<int> offsets_, members_;  // segments of slab i: members_[offsets_[i] .. offsets_[i + 1])
  Vector2 low_{0, 0}, high_{0, 0};
  double slab_scale_ = 0;
  int slab_count_ = 0;
};

}  // namespace quadrille
