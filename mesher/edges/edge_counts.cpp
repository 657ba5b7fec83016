/// Gives chords counts near the wanted ones and balances faces, with fewer and fewer rules until all hold.

#include "mesher/edges/edge_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/pending/disjoint_sets.hpp>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "mesher/edges/count_balance.hpp"

namespace quadrille {

namespace {

constexpr double largest_ratio = 2;  // between wanted counts of the sides of a pair, or edges of a chord
/// The same between sides of several edges, which leave the other edges on them no choice.
constexpr double largest_ratio_of_sums = 1.3;

bool has_sums(const FaceSides& sides) {
  return std::ranges::any_of(sides.facing, &FacingPair::has_sum);
}

bool is_on(EdgeId edge, FaceSides sides) {
  sides.drop_facing();
  return std::ranges::find(sides.rest, edge) != sides.rest.end();
}

/// Chords with the numbers that users prescribe for them.
struct FixedChords {
  Chords chords;
  IdVector<EdgeId, int> fixed;  // (representatives) segments of the final mesh; 0 = any number

  int fixed_of(EdgeId edge) const { return fixed[chords.of(edge)]; }

  /// Merges two chords, unless users prescribe different numbers for them.
  bool tie(const SideEdge& a, const SideEdge& b, double ratio) {
    const int one = fixed_of(a.edge), other = fixed_of(b.edge);
    if (one > 0 && other > 0 && one != other) return false;
    if (!chords.tie(a, b, std::max(one, other) > 0 ? std::max(ratio, largest_fixed_ratio) : ratio))
      return false;
    fixed[chords.of(a.edge)] = std::max(one, other);
    return true;
  }
};

/// Whether the wanted counts of two facing sides differ too much for one number. \param effective wanted
/// count, at least the least one
bool is_far_off(const FixedChords& chords, const IdVector<EdgeId, double>& effective,
                const FacingPair& pair) {
  const auto [low, high] = std::minmax({sum_over(pair.first, effective), sum_over(pair.second, effective)});
  const bool has_fixed =
      std::ranges::any_of(pair.edges(), [&](const SideEdge& edge) { return chords.fixed_of(edge.edge) > 0; });
  const bool is_sum = pair.has_sum();
  return high > (has_fixed ? largest_fixed_ratio : is_sum ? largest_ratio_of_sums : largest_ratio) * low;
}

/// Ties edges with the same nodes, and edges that face each other. \param sides see choose_counts()
FixedChords tie_chords(const CadShape& shape, const CountTargets& targets, const TinyFeatures& tiny,
                       FaceOutlines& sides) {
  IdVector<EdgeId, double> effective;  // wanted count, at least the least one
  for (const EdgeId edge : targets.wanted.ids())
    effective.push_back(std::max(targets.wanted[edge], 1.0 * targets.least[edge]));
  FixedChords chords{Chords(effective), targets.fixed};
  chords.fixed.resize(effective.size());
  for (const EdgeId edge : effective.ids()) {
    const EdgeId same = tiny.edges[edge];
    if (same != edge && !chords.tie({same, true}, {edge, !tiny.reversed_edges[edge]},
                                    std::numeric_limits<double>::infinity()))
      throw usage_error("segments",
                        fmt::format("`segments` gives different numbers to Edge{} and Edge{}, which "
                                    "have the same nodes",
                                    shape.edges[same].number, shape.edges[edge].number));
  }
  for (const FaceId face : sides.ids()) {
    const auto& facing = sides[face].facing;
    bool fits = std::ranges::none_of(
        facing, [&](const FacingPair& pair) { return is_far_off(chords, effective, pair); });
    for (const FacingPair& pair : facing) {
      if (fits && !pair.has_sum()) fits = chords.tie(pair.first[0], pair.second[0], largest_ratio);
    }
    if (!fits) sides[face].drop_facing();
  }
  return chords;
}

/// The change by one, 1 or -1, that fits the wanted count better.
int change_of(const BalanceProblem::Variable& variable) {
  return variable.wanted >= variable.value || variable.value <= variable.least ? 1 : -1;
}

double cost_of_change(const BalanceProblem::Variable& variable) {
  const double ratio = (variable.value + change_of(variable)) / std::max(variable.wanted, 0.5);
  return std::abs(std::log(ratio)) + 1e-6;
}

/// Numbers of segments for all chords.
struct BalancedCounts {
  std::vector<FaceId> odd;       // faces that stay odd
  IdVector<EdgeId, int> units;   // (representatives) segments of the final mesh per unit of the count
  IdVector<EdgeId, int> values;  // (representatives) in units
};

/// The counts as a problem with a variable for each chord, and a rule for each face and each pair of sides.
class CountProblem {
 public:
  /// \param sides see choose_counts()
  CountProblem(const CountTargets& targets, const FixedChords& chords, FaceOutlines& sides)
      : targets_(targets), chords_(chords), sides_(sides), members_(chords.fixed.size()) {
    units_.assign(chords.fixed.size(), targets.stride);
    for (const EdgeId edge : units_.ids())
      if (targets.least[edge] != 0) members_[chords.chords.of(edge)].push_back(edge);
    problem_.variables.resize(chords.fixed.size());
    for (const EdgeId chord : units_.ids()) start_value(chord);
  }

  /// Balances all faces. Drops faces whose facing sides cannot have equal counts until the others can.
  BalancedCounts balance_faces() && {
    std::vector<FaceId> odd;
    for (bool dropped = true; dropped;) {
      targets_.check();
      set_up_rules();
      dropped = false;
      odd.clear();
      for (const int node : balance(problem_, targets_.check)) {
        const FaceId face = faces_of_nodes_[node];
        if (problem_.rules[node] == BalanceProblem::Rule::even) odd.push_back(face);
        if (sides_[face].facing.empty()) continue;
        sides_[face].drop_facing();
        dropped = true;
      }
    }
    return counts(std::move(odd));
  }

  /// Balances faces by parity alone.
  BalancedCounts make_faces_even() && {
    set_up_rules();
    IdVector<EdgeId, ParityEdge> edges(problem_.variables.size());
    FaceFlags odd(sides_.size());
    for (const EdgeId chord : edges.ids()) {
      const auto& variable = this->variable(chord);
      edges[chord].cost = variable.fixed ? std::numeric_limits<double>::infinity()
                                         : variable.weight * cost_of_change(variable);
      for (const auto& [node, coefficient] : variable.terms) {
        const FaceId face = faces_of_nodes_[node];
        edges[chord].faces.push_back(face);
        if (variable.value % 2 != 0) odd[face] ^= 1;
      }
    }
    std::vector<FaceId> left;
    const EdgeFlags change = make_even(edges, odd, left, targets_.check);
    for (const EdgeId chord : edges.ids()) {
      if (change[chord]) variable(chord).value += change_of(variable(chord));
    }
    return counts(std::move(left));
  }

 private:
  BalancedCounts counts(std::vector<FaceId> odd) {
    BalancedCounts result{std::move(odd), std::move(units_), {}};
    for (const auto& variable : problem_.variables) result.values.push_back(variable.value);
    return result;
  }

  /// Sets all of a chord's variable but its terms, near the mean count of its members. One unit is
  /// `units_[chord]` segments of the final mesh.
  void start_value(EdgeId chord) {
    const std::vector<EdgeId>& members = members_[chord];
    if (members.empty()) return;
    auto& variable = this->variable(chord);
    const int unit = units_[chord], parts = targets_.stride / unit;
    const bool final_segments = unit < targets_.stride;
    bool even = false;
    double wanted = 0;
    variable.least = 1;
    for (const EdgeId i : members) {
      wanted += targets_.wanted[i];
      variable.least =
          std::max(variable.least, final_segments ? targets_.least_of_grids[i] : targets_.least[i]);
      even |= is_set(targets_.even, i);
    }
    variable.wanted = parts * (wanted / static_cast<double>(members.size()));
    variable.weight = static_cast<double>(members.size());
    variable.value = std::max(variable.least, round_to_int(variable.wanted));
    variable.fixed = chords_.fixed[chord] > 0 || even;
    if (chords_.fixed[chord] > 0) {
      variable.wanted = 1.0 * chords_.fixed[chord] / unit;
      variable.value = variable.least = std::max(1, chords_.fixed[chord] / unit);
    } else if (even) {
      variable.value = 2 * round_to_int(0.5 * std::max(variable.wanted, 1.0 * variable.least));
      variable.wanted = variable.value;
    }
  }

  /// Chords that only grids use, and that sums connect only to other such chords, are counted in segments of
  /// the final mesh: nothing there is cut in two.
  void choose_units() {
    const std::size_t chords = problem_.variables.size(), all = chords + problem_.rules.size();
    boost::disjoint_sets_with_storage<> groups(all);  // of chords, then nodes
    for (std::size_t i = 0; i < chords; ++i)
      for (const auto& [node, coefficient] : problem_.variables[i].terms) groups.union_set(i, chords + node);
    std::vector<int> units(all, 1);
    const auto unit_of = [&](EdgeId chord) -> int& {
      return units[groups.find_set(static_cast<std::size_t>(chord.index()))];
    };
    for (const EdgeId chord : units_.ids()) {
      if (!is_between_grids_[chord]) unit_of(chord) = targets_.stride;
    }
    for (const EdgeId chord : units_.ids()) {
      if (units_[chord] == unit_of(chord)) continue;
      units_[chord] = unit_of(chord);
      start_value(chord);
    }
  }

  /// Turns the rules of all faces into nodes of the problem.
  void set_up_rules() {
    for (auto& variable : problem_.variables) variable.terms.clear();
    problem_.rules.clear();
    faces_of_nodes_.clear();
    is_between_grids_.assign(problem_.variables.size(), 1);
    for (const FaceId face : sides_.ids()) {
      const FaceSides& sides = sides_[face];
      const bool is_grid = sides.rest.empty() && sides.is_filled();
      for (const EdgeId edge : sides.facing_edges()) is_between_grids_[chords_.chords.of(edge)] &= is_grid;
      add_facing(face);
      for (const EdgeId edge : sides.rest) is_between_grids_[chords_.chords.of(edge)] = 0;
      if (sides.rest.empty() || (sides.may_be_odd && targets_.stride == 2)) continue;
      const int node = add_node(face, BalanceProblem::Rule::even);
      for (const EdgeId edge : sides.rest) add_term(edge, node, 1);
    }
    drop_idle_terms();
    choose_units();
  }

  void drop_idle_terms() {
    for (auto& variable : problem_.variables) {
      std::erase_if(variable.terms, [&](const auto& term) {
        return problem_.rules[term.first] == BalanceProblem::Rule::zero ? term.second == 0
                                                                        : term.second % 2 == 0;
      });
    }
  }

  /// Adds the rules that facing sides have equal counts.
  void add_facing(FaceId face) {
    for (const FacingPair& pair : sides_[face].facing) {
      const int node = add_node(face, BalanceProblem::Rule::zero);
      for (const SideEdge& edge : pair.first) add_term(edge.edge, node, 1);
      for (const SideEdge& edge : pair.second) add_term(edge.edge, node, -1);
    }
  }

  int add_node(FaceId face, BalanceProblem::Rule rule) {
    problem_.rules.push_back(rule);
    faces_of_nodes_.push_back(face);
    return static_cast<int>(problem_.rules.size()) - 1;
  }

  void add_term(EdgeId edge, int node, int coefficient) {
    if (targets_.least[edge] == 0) return;
    auto& terms = variable(chords_.chords.of(edge)).terms;
    const auto it = std::ranges::find_if(terms, [&](const auto& term) { return term.first == node; });
    if (it == terms.end()) {
      terms.push_back({node, coefficient});
    } else {
      it->second += problem_.rules[node] == BalanceProblem::Rule::even ? 1 - 2 * it->second : coefficient;
    }
  }

  BalanceProblem::Variable& variable(EdgeId chord) { return problem_.variables[chord.index()]; }

  const CountTargets& targets_;
  const FixedChords& chords_;
  FaceOutlines& sides_;
  // By the representative edge of a chord:
  IdVector<EdgeId, std::vector<EdgeId>> members_;  // edges
  IdVector<EdgeId, int> units_;                    // segments of the final mesh per unit of the count
  EdgeFlags is_between_grids_;                     // 1 = all its faces are grids
  BalanceProblem problem_;                         // one variable for each edge; only those of chords matter
  std::vector<FaceId> faces_of_nodes_;             // (nodes)
};

/// Names the included edges whose numbers are fixed, as "Edge4, Edge7".
template <class Includes>
std::string fixed_edges(const CadShape& shape, const CountTargets& targets, Includes&& includes) {
  std::set<int> numbers;  // the pieces of an edge that a seam divides have one number
  for (const EdgeId edge : targets.fixed.ids()) {
    if (targets.fixed[edge] > 0 && includes(edge)) numbers.insert(shape.edges[edge].number);
  }
  return numbers.empty() ? "" : fmt::format("Edge{}", fmt::join(numbers, ", Edge"));
}

/// Throws if fixed numbers cannot be kept.
void hold_fixed(const CadShape& shape, const CountTargets& targets, const FixedChords& chords,
                FaceOutlines& sides, const BalancedCounts& counts) {
  for (const EdgeId chord : chords.fixed.ids()) {
    const int fixed = chords.fixed[chord];
    if (chords.chords.of(chord) != chord || fixed % counts.units[chord] == 0) continue;
    throw usage_error(
        "segments",
        fmt::format("`segments` gives {} to {}, and a face there that is not a grid needs an "
                    "even number: use {}, or `strategy` direct",
                    fixed,
                    fixed_edges(shape, targets, [&](EdgeId edge) { return chords.chords.of(edge) == chord; }),
                    fixed > 1 ? fmt::format("{} or {}", fixed - 1, fixed + 1) : "2"));
  }
  for (const FaceId face : counts.odd) {
    const std::string names =
        fixed_edges(shape, targets, [&](EdgeId edge) { return is_on(edge, sides[face]); });
    if (names.empty()) continue;
    const bool is_halved = targets.stride == 2;
    throw usage_error(
        "segments",
        fmt::format(
            "`segments` leaves Face{} with {} around it: use {} more or less on one of {}", face.number(),
            is_halved ? "a number of segments that is no multiple of four" : "an odd number of segments",
            targets.stride, names));
  }
}

}  // namespace

EdgeCounts choose_counts(const CadShape& shape, const CountTargets& targets, const TinyFeatures& tiny,
                         FaceOutlines& sides) {
  FixedChords chords = tie_chords(shape, targets, tiny, sides);
  BalancedCounts counts = CountProblem(targets, chords, sides).balance_faces();
  if (!counts.odd.empty()) {
    // Usually edges of three or more faces. First drop faces with sides of several edges, then all.
    for (FaceSides& face : sides)
      if (has_sums(face)) face.drop_facing();
    counts = CountProblem(targets, chords, sides).make_faces_even();
  }
  if (!counts.odd.empty()) {
    for (FaceSides& face : sides) face.drop_facing();
    chords = tie_chords(shape, targets, tiny, sides);
    counts = CountProblem(targets, chords, sides).make_faces_even();
  }
  hold_fixed(shape, targets, chords, sides, counts);
  EdgeCounts result{IdVector<EdgeId, int>(shape.edges.size()), std::move(chords.chords)};
  for (const EdgeId edge : result.counts.ids()) {
    const EdgeId chord = result.chords.of(edge);
    if (targets.least[edge] == 0) continue;
    result.counts[edge] =
        chords.fixed[chord] > 0 ? chords.fixed[chord] : counts.units[chord] * counts.values[chord];
  }
  choose_single_segments(shape, targets, sides, result);
  return result;
}

}  // namespace quadrille
