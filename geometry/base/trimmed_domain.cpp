/// Even-odd rule by ray crossing (Shimrat 1962), with the segments sorted into horizontal slabs.

#include "geometry/base/trimmed_domain.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/base/whole_number.hpp"

namespace quadrille {

TrimmedDomain::TrimmedDomain(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  box_.setEmpty();
  for (const Segment& s : segments_) box_.extend(s.a).extend(s.b);
  slab_count_ = static_cast<int>(std::clamp<std::size_t>(segments_.size(), 1, 1 << 20));
  const double height = box_.sizes().y();
  slab_scale_ = height > 0 ? slab_count_ / height : 0;
  members_ = Rows<>(slab_count_, [&](auto&& add) {
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      const auto [low, high] = std::minmax(segments_[k].a.y(), segments_[k].b.y());
      for (int i = slab(low); i <= slab(high); ++i) add(i, static_cast<int>(k));
    }
  });
}

int TrimmedDomain::slab(double y) const {
  return cell_at((y - low().y()) * slab_scale_, slab_count_);
}

bool TrimmedDomain::inside(const Vector2& p) const {
  if (segments_.empty() || !box_.contains(p)) return false;
  bool odd = false;
  for (const int member : members_[slab(p.y())]) {
    const Segment& s = segments_[member];
    if ((s.a.y() > p.y()) == (s.b.y() > p.y())) continue;
    const double x = s.a.x() + (p.y() - s.a.y()) / (s.b.y() - s.a.y()) * (s.b.x() - s.a.x());
    if (p.x() < x) odd = !odd;
  }
  return odd;
}

}  // namespace quadrille
