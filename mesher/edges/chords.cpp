/// Unites edges that face each other (union-find with direction), spaced by the densest member.

#include "mesher/edges/chords.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace quadrille {

Chords::Chords(const IdVector<EdgeId, double>& wanted)
    : parent_(wanted.size()), against_(wanted.size()), low_(wanted), high_(wanted) {
  for (const EdgeId edge : parent_.ids()) parent_[edge] = edge;
}

EdgeId Chords::of(EdgeId edge) const {
  while (parent_[edge] != edge) edge = parent_[edge];
  return edge;
}

bool Chords::against(EdgeId edge) const {
  bool result = false;
  for (; parent_[edge] != edge; edge = parent_[edge]) result ^= against_[edge] != 0;
  return result;
}

bool Chords::tie(const SideEdge& a, const SideEdge& b, double largest_ratio) {
  EdgeId root = of(a.edge), other = of(b.edge);
  if (root == other) return true;
  const bool opposed = (against(a.edge) != against(b.edge)) != (a.forward != b.forward);
  const double low = std::min(low_[root], low_[other]), high = std::max(high_[root], high_[other]);
  if (high > largest_ratio * low) return false;
  if (other < root) std::swap(root, other);
  parent_[other] = root;
  against_[other] = opposed;
  low_[root] = low;
  high_[root] = high;
  return true;
}

namespace {

class ChordSpacing {
 public:
  ChordSpacing(const CadShape& shape, const Chords& chords, const IdVector<EdgeId, CountTable>& tables,
               const IdVector<EdgeId, int>& counts, const EdgeShares& prescribed)
      : shape_(shape), chords_(chords), tables_(tables), counts_(counts), prescribed_(prescribed) {
    for (const EdgeId edge : counts.ids()) {
      if (counts[edge] > 0) members_[chords.of(edge)].push_back(edge);
    }
  }

  EdgeShares run(const FaceOutlines& sides) {
    // A chord takes over the shares of its first member with prescribed ones.
    for (const auto& [chord, members] : members_) {
      const auto edge = std::ranges::find_if(members, [&](EdgeId id) { return holds(id); });
      if (edge == members.end()) continue;
      shares_[chord] = prescribed_[*edge];
      if (chords_.against(*edge)) turn_round(shares_[chord]);
      followed_.insert(chord);
      is_prescribed_.insert(chord);
    }
    for (const FaceSides& face : sides) {
      for (const FacingPair& pair : face.facing) {
        follow(pair.first, pair.second);
        follow(pair.second, pair.first);
      }
    }
    EdgeShares result(counts_.size());
    for (const auto& [chord, members] : members_) {
      if (members.size() == 1 && !followed_.contains(chord)) continue;
      for (const EdgeId edge : members) {
        if (holds(edge))
          result[edge] = prescribed_[edge];
        else if (is_prescribed_.contains(chord) || suits(edge))
          result[edge] = shares_of(edge);
      }
    }
    return result;
  }

 private:
  bool holds(EdgeId edge) const {
    return !prescribed_[edge].empty() && static_cast<int>(prescribed_[edge].size()) == counts_[edge] + 1;
  }

  static void turn_round(std::vector<double>& shares) {
    std::ranges::reverse(shares);
    for (double& share : shares) share = 1 - share;
  }

  /// Shares that equidistribute the count over a chord, by the densest member at each place.
  std::vector<double> equidistribute(const std::vector<EdgeId>& members) const {
    const int n = counts_[members.front()];
    const int cells = std::clamp(8 * n, 64, 4096);
    std::vector<double> density(cells, 0);
    for (const EdgeId edge : members) {
      const CountTable& table = tables_[edge];
      double before = 0;
      for (int i = 0; i < cells; ++i) {
        const double here = table.count_at_length(table.length() * (i + 1) / cells);
        double& at = density[chords_.against(edge) ? cells - 1 - i : i];
        at = std::max(at, here - before);
        before = here;
      }
    }
    const double total = std::accumulate(density.begin(), density.end(), 0.0);
    std::vector<double> shares{0};
    double sum = 0;
    int cell = 0;
    for (int k = 1; k < n; ++k) {
      const double target = total * k / n;
      while (cell + 1 < cells && sum + density[cell] < target) sum += density[cell++];
      const double part = density[cell] > 0 ? std::clamp((target - sum) / density[cell], 0.0, 1.0) : 0.5;
      shares.push_back((cell + part) / cells);
    }
    shares.push_back(1);
    return shares;
  }

  std::vector<double> shares_of(EdgeId edge) {
    const EdgeId chord = chords_.of(edge);
    const auto [known, is_new] = shares_.try_emplace(chord);
    if (is_new) known->second = equidistribute(members_.at(chord));
    std::vector<double> shares = known->second;
    if (chords_.against(edge)) turn_round(shares);
    return shares;
  }

  /// A side that is a single edge takes over the spacing of several opposite edges.
  void follow(const FaceSide& one, const FaceSide& several) {
    if (one.size() != 1 || several.size() < 2) return;
    const EdgeId edge = one[0].edge;
    if (followed_.contains(chords_.of(edge))) return;
    std::vector<double> shares;
    double length = 0;
    for (const SideEdge& part : several) {
      if (counts_[part.edge] == 0) return;
      std::vector<double> own = shares_of(part.edge);
      if (!part.forward) turn_round(own);
      const double part_length = shape_.edges[part.edge].length;
      for (std::size_t i = shares.empty() ? 0 : 1; i < own.size(); ++i)
        shares.push_back(length + own[i] * part_length);
      length += part_length;
    }
    if (static_cast<int>(shares.size()) != counts_[edge] + 1 || !(length > 0)) return;
    for (double& share : shares) share /= length;
    if (one[0].forward == chords_.against(edge)) turn_round(shares);
    shares_[chords_.of(edge)] = shares;
    followed_.insert(chords_.of(edge));
  }

  /// Whether no segment would be far longer than the edge's own sizes request.
  bool suits(EdgeId edge) {
    constexpr double most = 2;
    const CountTable& table = tables_[edge];
    const std::vector<double> shares = shares_of(edge);
    const double one = table.total() / counts_[edge];
    for (std::size_t k = 0; k + 1 < shares.size(); ++k) {
      const double wanted = table.count_at_length(shares[k + 1] * table.length()) -
                            table.count_at_length(shares[k] * table.length());
      if (wanted > most * one) return false;
    }
    return true;
  }

  const CadShape& shape_;
  const Chords& chords_;
  const IdVector<EdgeId, CountTable>& tables_;
  const IdVector<EdgeId, int>& counts_;
  std::map<EdgeId, std::vector<EdgeId>> members_;  // chord -> edges
  std::map<EdgeId, std::vector<double>> shares_;   // chord -> shares of its representative, once needed
  const EdgeShares& prescribed_;
  std::set<EdgeId> followed_, is_prescribed_;  // chords with shares from opposite edges or users; from users
};

}  // namespace

EdgeShares space_chords(const CadShape& shape, const FaceOutlines& sides, const Chords& chords,
                        const IdVector<EdgeId, CountTable>& tables, const IdVector<EdgeId, int>& counts,
                        const EdgeShares& prescribed) {
  return ChordSpacing(shape, chords, tables, counts, prescribed).run(sides);
}

}  // namespace quadrille
