// Every way to fill a small polygon with quads, by recursion on its first side: the quad there has its two
// other corners on the polygon or inside, and parts what is left into up to three smaller polygons.

#include "mesher/quads/patch_templates.hpp"

#include <cstddef>

namespace quadrille {
namespace {

using Ring = std::vector<int>;

/// A part still to be filled, and the number of nodes to put into it.
struct Region {
  Ring ring;
  int inside;
};

class Enumeration {
 public:
  explicit Enumeration(int sides) : sides_(sides) {
    Ring ring;
    for (int i = 0; i < sides; ++i) ring.push_back(i);
    for (int inside = 0; inside <= PatchTemplate::max_interior; ++inside) {
      next_node_ = sides;
      fill({{ring, inside}});
    }
  }
  std::vector<PatchTemplate> take() { return std::move(found_); }

 private:
  void fill(std::vector<Region> regions) {
    if (regions.empty()) return record();
    const Region region = regions.back();
    regions.pop_back();
    const Ring& ring = region.ring;
    const int n = static_cast<int>(ring.size());
    if (n == 2) {  // two nodes with one side between them: nothing left to fill
      if (region.inside == 0) fill(std::move(regions));
      return;
    }
    // The quad on the side ring[0], ring[1]: third corner at place i of the ring or new (-1), fourth at j or
    // new.
    for (int i = -1; i < n; ++i) {
      if (i == 0 || i == 1) continue;
      for (int j = -1; j < n; ++j) {
        if (j == 0 || j == 1 || (i >= 0 && j >= 0 && j <= i)) continue;
        const int fresh = (i < 0) + (j < 0);
        if (fresh <= region.inside) place(regions, region, i, j, region.inside - fresh);
      }
    }
  }

  void place(const std::vector<Region>& regions, const Region& region, int i, int j, int inside) {
    const Ring& ring = region.ring;
    const int n = static_cast<int>(ring.size());
    const int mark = next_node_;
    const int c = i < 0 ? next_node_++ : ring[i];
    const int d = j < 0 ? next_node_++ : ring[j];
    std::vector<Ring> parts;
    const auto arc = [&](int from, int to) {
      Ring part;
      for (int k = from; k <= to; ++k) part.push_back(ring[k % n]);
      return part;
    };
    if (i >= 0 && j >= 0) {
      parts = {arc(1, i), arc(i, j), arc(j, n)};
    } else if (i >= 0) {
      parts = {arc(1, i), arc(i, n)};
      parts.back().push_back(d);
    } else if (j >= 0) {
      parts = {arc(1, j), arc(j, n)};
      parts.front().push_back(c);
    } else {
      parts = {arc(1, n)};
      parts.back().push_back(d);
      parts.back().push_back(c);
    }
    bool even = true;
    for (const Ring& part : parts) even = even && part.size() % 2 == 0;
    if (even) {
      quads_.push_back({ring[0], ring[1], c, d});
      share(regions, parts, 0, inside);
      quads_.pop_back();
    }
    next_node_ = mark;
  }

  /// Hands the nodes to place out to the parts, in every way.
  void share(std::vector<Region> regions, const std::vector<Ring>& parts, std::size_t part, int inside) {
    // Between two nodes there is only their side.
    const int most = parts[part].size() == 2 ? 0 : inside;
    if (part + 1 == parts.size()) {
      if (inside > most) return;
      regions.push_back({parts[part], inside});
      return fill(std::move(regions));
    }
    for (int here = 0; here <= most; ++here) {
      std::vector<Region> more = regions;
      more.push_back({parts[part], here});
      share(std::move(more), parts, part + 1, inside - here);
    }
  }

  void record() {
    PatchTemplate result;
    result.interior = next_node_ - sides_;
    std::array<int, PatchTemplate::max_sides + PatchTemplate::max_interior> uses{};
    for (const auto& quad : quads_) {
      for (int k = 0; k < 4; ++k) {
        result.corners[result.quads][k] = static_cast<std::int8_t>(quad[k]);
        ++uses[quad[k]];
      }
      ++result.quads;
    }
    for (int i = 0; i < sides_; ++i) result.uses[i] = static_cast<std::int8_t>(uses[i]);
    for (int i = sides_; i < next_node_; ++i) {
      if (uses[i] < 3 || uses[i] > 5) return;
      result.interior_cost += (uses[i] - 4) * (uses[i] - 4);
    }
    found_.push_back(result);
  }

  int sides_;
  int next_node_ = 0;
  std::vector<std::array<int, 4>> quads_;
  std::vector<PatchTemplate> found_;
};

}  // namespace

const std::vector<PatchTemplate>& patch_templates(int sides) {
  static const std::array<std::vector<PatchTemplate>, 4> tables = {
      Enumeration(4).take(), Enumeration(6).take(), Enumeration(8).take(), Enumeration(10).take()};
  static const std::vector<PatchTemplate> none;
  if (sides < 4 || sides > PatchTemplate::max_sides || sides % 2 != 0) return none;
  return tables[(sides - 4) / 2];
}

}  // namespace quadrille
