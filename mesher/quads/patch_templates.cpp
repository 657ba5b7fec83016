/// Finds every way to fill a small polygon with quads, by recursion on its first side. The quad there has its
/// two other corners on the polygon or inside, and splits the rest into up to three smaller polygons.

#include "mesher/quads/patch_templates.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace quadrille {
namespace {

/// No part has more nodes than the polygon and those inside.
using Ring =
    boost::container::static_vector<std::int8_t, PatchTemplate::max_sides + PatchTemplate::max_interior>;

/// A part still to be filled, and the number of nodes to put into it.
struct Region {
  Ring ring;
  int inside;
};
/// Each quad leaves up to three parts in place of one.
using Regions = boost::container::static_vector<Region, 2 * PatchTemplate::max_quads + 1>;
using Parts = boost::container::static_vector<Ring, 3>;

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
  void fill(Regions regions) {
    if (regions.empty()) return record();
    const Region region = regions.back();
    regions.pop_back();
    const Ring& ring = region.ring;
    const int n = static_cast<int>(ring.size());
    if (n == 2) {  // two nodes with one side between them: nothing left to fill
      if (region.inside == 0) fill(std::move(regions));
      return;
    }
    // The quad on the side ring[0], ring[1]: its third corner is ring[i], its fourth ring[j]; -1 = new.
    for (int i = -1; i < n; ++i) {
      if (i == 0 || i == 1) continue;
      for (int j = -1; j < n; ++j) {
        if (j == 0 || j == 1 || (i >= 0 && j >= 0 && j <= i)) continue;
        const int fresh = (i < 0) + (j < 0);
        if (fresh <= region.inside) place(regions, region, i, j, region.inside - fresh);
      }
    }
  }

  void place(const Regions& regions, const Region& region, int i, int j, int inside) {
    const Ring& ring = region.ring;
    const int n = static_cast<int>(ring.size());
    const int mark = next_node_;
    const int c = i < 0 ? next_node_++ : ring[i];
    const int d = j < 0 ? next_node_++ : ring[j];
    // Each part runs along the ring to the next corner that lies on it, and back over the new ones between.
    Parts parts;
    Ring fresh;
    int from = 1;
    for (const auto& [to, corner] : {std::pair(i, c), std::pair(j, d), std::pair(n, 0)}) {
      if (to < 0) {
        fresh.push_back(static_cast<std::int8_t>(corner));
        continue;
      }
      Ring& part = parts.emplace_back();
      for (int k = from; k <= to; ++k) part.push_back(ring[k % n]);
      part.insert(part.end(), fresh.rbegin(), fresh.rend());
      fresh.clear();
      from = to;
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

  /// Distributes the nodes that are still to be placed among the parts, in every way.
  void share(Regions regions, const Parts& parts, std::size_t part, int inside) {
    // Between two nodes there is only their side.
    const int most = parts[part].size() == 2 ? 0 : inside;
    // The capacity is named for GCC 14, which unrolls this and warns about a part beyond it.
    if (part + 1 == parts.size() || part + 1 == Parts::static_capacity) {
      if (inside > most) return;
      regions.push_back({parts[part], inside});
      return fill(std::move(regions));
    }
    for (int here = 0; here <= most; ++here) {
      Regions more = regions;
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

/// The fillings of one polygon as trees: one for each pair of the number of nodes inside and their cost.
class FillingTrees {
 public:
  explicit FillingTrees(int sides) : sides_(sides), fillings_(Enumeration(sides).take()) {
    order_.resize(fillings_.size());
    std::iota(order_.begin(), order_.end(), 0);
    const auto key = [this](int k) {
      const PatchTemplate& filling = fillings_[k];
      return std::tie(filling.interior, filling.interior_cost, filling.uses);
    };
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return key(a) < key(b); });
    const int count = static_cast<int>(order_.size());
    for (int first = 0, last = 0; first < count; first = last) {
      const auto alike = [&](int k) {
        return fillings_[order_[k]].interior == fillings_[order_[first]].interior &&
               fillings_[order_[k]].interior_cost == fillings_[order_[first]].interior_cost;
      };
      while (last < count && alike(last)) ++last;
      const int begin = static_cast<int>(branches_.size());
      grow(0, first, last);
      trees_.push_back({order_[first], begin, static_cast<int>(branches_.size())});
    }
  }

  const std::vector<PatchTemplate>& fillings() const { return fillings_; }
  CheapestFillings cheapest(const FillingCosts& costs) const;

 private:
  /// The fillings with the same uses at all nodes up to `node`. Its branches for the next node follow it.
  struct Branch {
    int node;
    int uses;         ///< at that node
    int first, last;  ///< the range of these fillings in order_
    int past;         ///< the first branch that does not follow from this one
  };
  struct Tree {
    int any;         ///< one of its fillings
    int begin, end;  ///< range of its branches
  };
  void grow(int node, int first, int last) {
    if (node == sides_) return;
    while (first < last) {
      const std::int8_t uses = fillings_[order_[first]].uses[node];
      int next = first;
      while (next < last && fillings_[order_[next]].uses[node] == uses) ++next;
      const std::size_t branch = branches_.size();
      branches_.push_back({node, uses, first, next, 0});
      grow(node + 1, first, next);
      branches_[branch].past = static_cast<int>(branches_.size());
      first = next;
    }
  }

  int sides_;
  std::vector<PatchTemplate> fillings_;
  std::vector<int> order_;  ///< fillings by their tree, then by their uses
  std::vector<Branch> branches_;
  std::vector<Tree> trees_;
};

CheapestFillings FillingTrees::cheapest(const FillingCosts& costs) const {
  // The least that a node and those after it can cost.
  std::array<double, PatchTemplate::max_sides + 1> rest;
  rest[sides_] = 0;
  for (int i = sides_ - 1; i >= 0; --i)
    rest[i] = rest[i + 1] + *std::min_element(costs.uses[i].begin() + 1, costs.uses[i].end());
  constexpr double rounding = 1e-9;
  constexpr std::size_t max_count = CheapestFillings::static_capacity;
  boost::container::static_vector<std::pair<double, int>, max_count + 1> best;  // by cost, then by number
  std::array<double, PatchTemplate::max_sides + 1> sums;
  for (const Tree& tree : trees_) {
    const PatchTemplate& any = fillings_[tree.any];
    sums[0] = any.interior_cost + costs.resize[any.interior] + costs.drift[any.interior];
    for (int k = tree.begin; k < tree.end;) {
      const Branch& branch = branches_[k];
      const int after = branch.node + 1;
      const double sum = sums[after] = sums[branch.node] + costs.uses[branch.node][branch.uses];
      const double most = best.size() == max_count ? best.back().first : costs.limit;
      if (sum + rest[after] > most + rounding) {
        k = branch.past;
        continue;
      }
      ++k;
      if (after < sides_ || sum > costs.limit) continue;
      for (int i = branch.first; i < branch.last; ++i) {
        const std::pair found(sum, order_[i]);
        best.insert(std::upper_bound(best.begin(), best.end(), found), found);
        if (best.size() > max_count) best.pop_back();
      }
    }
  }
  CheapestFillings result;
  for (const auto& [cost, filling] : best) result.push_back(&fillings_[filling]);
  return result;
}

/// Null if polygons with this number of sides are not filled.
const FillingTrees* filling_trees(int sides) {
  static const std::array<FillingTrees, 4> trees = {FillingTrees(4), FillingTrees(6), FillingTrees(8),
                                                    FillingTrees(10)};
  if (sides < 4 || sides > PatchTemplate::max_sides || sides % 2 != 0) return nullptr;
  return &trees[(sides - 4) / 2];
}

}  // namespace

const std::vector<PatchTemplate>& patch_templates(int sides) {
  static const std::vector<PatchTemplate> none;
  const FillingTrees* trees = filling_trees(sides);
  return trees ? trees->fillings() : none;
}

CheapestFillings cheapest_fillings(int sides, const FillingCosts& costs) {
  const FillingTrees* trees = filling_trees(sides);
  return trees ? trees->cheapest(costs) : CheapestFillings{};
}

}  // namespace quadrille
