/// Gives chords counts near the wanted ones and balances faces, with fewer and fewer rules until all hold.

#include "mesher/edges/edge_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/pending/disjoint_sets.hpp>

#include "geometry/base/error.hpp"
#include "geometry/base/whole_number.hpp"
#include "mesher/edges/count_balance.hpp"
#include "mesher/edges/parity.hpp"
#include "mesher/edges/single_segments.hpp"

namespace quadrille {

namespace {

constexpr double largest_ratio = 2;  // between wanted counts of the sides of a pair, or edges of a chord
/// The same between sides of several edges, which leave the other edges on them no choice.
constexpr double largest_ratio_of_sums = 1.3;
constexpr double largest_fixed_ratio = 4;  // the same if one of them is fixed

class CountChooser {
 public:
  CountChooser(const CadShape& shape, const CountTargets& targets, const TinyFeatures& tiny,
               FaceOutlines& sides)
      : shape_(shape), targets_(targets), tiny_(tiny), sides_(sides), chords_(IdVector<EdgeId, double>()) {
    for (const EdgeId edge : targets.wanted.ids())
      effective_.push_back(std::max(targets.wanted[edge], 1.0 * targets.least[edge]));
  }

  EdgeCounts run() {
    tie_chords();
    std::vector<FaceId> odd = balance_faces();
    if (!odd.empty()) {
      // Usually edges of three or more faces. First drop faces with sides of several edges, then all.
      for (const FaceId face : sides_.ids()) {
        if (has_sums(sides_[face])) sides_[face].drop_facing();
      }
      odd = make_faces_even();
    }
    if (!odd.empty()) {
      for (const FaceId face : sides_.ids()) sides_[face].drop_facing();
      tie_chords();
      odd = make_faces_even();
    }
    hold_fixed(odd);
    EdgeCounts result{IdVector<EdgeId, int>(effective_.size()), chords_};
    for (const EdgeId edge : effective_.ids()) {
      const EdgeId chord = chords_.of(edge);
      if (targets_.least[edge] == 0) continue;
      result.counts[edge] = fixed_[chord] > 0 ? fixed_[chord] : units_[chord] * variable(chord).value;
    }
    return result;
  }

 private:
  static int rounded(double value) { return round_to_int(value); }

  static bool has_sums(const FaceSides& sides) {
    return std::any_of(sides.facing.begin(), sides.facing.end(),
                       [](const FacingPair& pair) { return pair.first.size() + pair.second.size() > 2; });
  }

  double sum_of(const FaceSide& side) const {
    double sum = 0;
    for (const SideEdge& edge : side) sum += effective_[edge.edge];
    return sum;
  }

  bool has_fixed(const FacingPair& pair) const {
    const auto is_fixed = [&](const SideEdge& edge) { return fixed_[chords_.of(edge.edge)] > 0; };
    return std::any_of(pair.first.begin(), pair.first.end(), is_fixed) ||
           std::any_of(pair.second.begin(), pair.second.end(), is_fixed);
  }

  bool is_far_off(const FacingPair& pair) const {
    const auto [low, high] = std::minmax({sum_of(pair.first), sum_of(pair.second)});
    const bool is_sum = pair.first.size() + pair.second.size() > 2;
    return high > (has_fixed(pair) ? largest_fixed_ratio
                   : is_sum        ? largest_ratio_of_sums
                                   : largest_ratio) *
                      low;
  }

  /// Merges two chords, unless users prescribe different numbers for them.
  bool tie(const SideEdge& a, const SideEdge& b, double ratio) {
    const int one = fixed_[chords_.of(a.edge)], other = fixed_[chords_.of(b.edge)];
    if (one > 0 && other > 0 && one != other) return false;
    if (!chords_.tie(a, b, std::max(one, other) > 0 ? std::max(ratio, largest_fixed_ratio) : ratio))
      return false;
    fixed_[chords_.of(a.edge)] = std::max(one, other);
    return true;
  }

  /// Names the included edges whose numbers are fixed, as "Edge4, Edge7".
  template <class Includes>
  std::string fixed_edges(Includes&& includes) const {
    std::set<int> numbers;  // the pieces of an edge that a seam divides have one number
    for (const EdgeId edge : targets_.fixed.ids()) {
      if (targets_.fixed[edge] > 0 && includes(edge)) numbers.insert(shape_.edges[edge].number);
    }
    return numbers.empty() ? "" : fmt::format("Edge{}", fmt::join(numbers, ", Edge"));
  }

  /// Throws if fixed numbers cannot be kept. \param odd faces that stay odd.
  void hold_fixed(const std::vector<FaceId>& odd) {
    for (const EdgeId chord : fixed_.ids()) {
      const int fixed = fixed_[chord];
      if (chords_.of(chord) != chord || fixed % units_[chord] == 0) continue;
      throw usage_error(
          "segments", fmt::format("`segments` gives {} to {}, and a face there that is not a grid needs an "
                                  "even number: use {}, or `strategy` direct",
                                  fixed, fixed_edges([&](EdgeId edge) { return chords_.of(edge) == chord; }),
                                  fixed > 1 ? fmt::format("{} or {}", fixed - 1, fixed + 1) : "2"));
    }
    for (const FaceId face : odd) {
      const std::string names = fixed_edges([&](EdgeId edge) { return is_on(edge, sides_[face]); });
      if (names.empty()) continue;
      throw usage_error("segments",
                        fmt::format("`segments` leaves Face{} with {} around it: {}", face.number(),
                                    targets_.stride == 2 ? "a number of segments that is no multiple of four"
                                                         : "an odd number of segments",
                                    numbers_that_work(face, odd.size(), names)));
    }
  }

  /// What to do about a face that stays odd. \param odd number of faces that do
  std::string numbers_that_work(FaceId face, std::size_t odd, const std::string& names) {
    std::vector<std::string> ways;
    std::set<EdgeId> chords;
    for (const EdgeId edge : targets_.fixed.ids())
      if (targets_.fixed[edge] > 0 && is_on(edge, sides_[face])) chords.insert(chords_.of(edge));
    for (const EdgeId chord : chords) {
      const auto is_here = [&](EdgeId edge) {
        return chords_.of(edge) == chord && is_on(edge, sides_[face]);
      };
      const std::string edges = fixed_edges(is_here);
      const int fixed = fixed_[chord];
      fixed_[chord] = fixed + units_[chord];
      const std::vector<FaceId> left = make_faces_even();
      fixed_[chord] = fixed;
      if (left.size() >= odd || std::find(left.begin(), left.end(), face) != left.end()) continue;
      const int all = segments_of_whole(is_here), less = all - units_[chord], more = all + units_[chord];
      const std::string way =
          less > 0 ? fmt::format("{} or {} on {}", less, more, edges) : fmt::format("{} on {}", more, edges);
      // Several pieces of an edge give the same.
      if (std::find(ways.begin(), ways.end(), way) == ways.end()) ways.push_back(way);
    }
    if (ways.empty()) return "change the numbers on two or more of " + names;
    return fmt::format("use {}", fmt::join(ways, ", or "));
  }

  /// The number that users prescribe for the first of the edges included, with all its pieces.
  template <class Includes>
  int segments_of_whole(Includes&& includes) const {
    const auto ids = targets_.fixed.ids();
    const auto first = std::find_if(ids.begin(), ids.end(), includes);
    int sum = 0;
    for (const EdgeId edge : ids)
      if (shape_.edges[edge].number == shape_.edges[*first].number) sum += targets_.fixed[edge];
    return sum;
  }

  static bool is_on(EdgeId edge, const FaceSides& sides) {
    const auto is_it = [&](const SideEdge& side) { return side.edge == edge; };
    return std::find(sides.rest.begin(), sides.rest.end(), edge) != sides.rest.end() ||
           std::any_of(sides.facing.begin(), sides.facing.end(), [&](const FacingPair& pair) {
             return std::any_of(pair.first.begin(), pair.first.end(), is_it) ||
                    std::any_of(pair.second.begin(), pair.second.end(), is_it);
           });
  }

  void tie_chords() {
    chords_ = Chords(effective_);
    fixed_ = targets_.fixed;
    fixed_.resize(effective_.size());
    const auto unite = [&](const SideEdge& a, const SideEdge& b) {
      if (!tie(a, b, std::numeric_limits<double>::infinity()))
        throw usage_error("segments",
                          fmt::format("`segments` gives different numbers to Edge{} and Edge{}, which "
                                      "have the same nodes",
                                      shape_.edges[a.edge].number, shape_.edges[b.edge].number));
    };
    for (const EdgeId edge : effective_.ids()) {
      const EdgeId same = tiny_.edges[edge];
      if (same != edge) unite({same, true}, {edge, !tiny_.reversed_edges[edge]});
    }
    for (const auto& [a, b] : targets_.tied) unite(a, b);
    for (const FaceId face : sides_.ids()) {
      const auto& facing = sides_[face].facing;
      bool fits = std::none_of(facing.begin(), facing.end(),
                               [&](const FacingPair& pair) { return is_far_off(pair); });
      for (const FacingPair& pair : facing) {
        if (fits && pair.first.size() == 1 && pair.second.size() == 1)
          fits = tie(pair.first[0], pair.second[0], largest_ratio);
      }
      if (!fits) sides_[face].drop_facing();
    }
    start_values();
  }

  /// Starts each chord near the mean count of its members, in segments of the mesh that is recombined.
  void start_values() {
    units_.assign(effective_.size(), targets_.stride);
    members_.assign(effective_.size(), {});
    for (const EdgeId edge : effective_.ids()) {
      if (targets_.least[edge] != 0) members_[chords_.of(edge)].push_back(edge);
    }
    problem_.variables.assign(effective_.size(), {});
    for (const EdgeId chord : effective_.ids()) start_value(chord);
  }

  /// Sets all of a chord's variable but its terms. One unit is `units_[chord]` segments of the final mesh.
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
      even |= !targets_.even.empty() && targets_.even[i] != 0;
    }
    variable.wanted = parts * (wanted / static_cast<double>(members.size()));
    variable.weight = static_cast<double>(members.size());
    variable.value = std::max(variable.least, rounded(variable.wanted));
    variable.fixed = fixed_[chord] > 0 || even;
    if (fixed_[chord] > 0) {
      variable.wanted = 1.0 * fixed_[chord] / unit;
      variable.value = variable.least = std::max(1, fixed_[chord] / unit);
    } else if (even) {
      variable.value = 2 * rounded(0.5 * std::max(variable.wanted, 1.0 * variable.least));
      variable.wanted = variable.value;
    }
  }

  /// Chords that only grids use, and that sums connect only to other such chords, are counted in segments of
  /// the final mesh: nothing there is cut in two.
  void choose_units() {
    boost::disjoint_sets_with_storage<> groups(problem_.variables.size());
    std::vector<int> first(problem_.rules.size(), -1);
    for (std::size_t i = 0; i < problem_.variables.size(); ++i) {
      for (const auto& [node, coefficient] : problem_.variables[i].terms) {
        if (first[node] < 0) first[node] = static_cast<int>(i);
        groups.union_set(i, static_cast<std::size_t>(first[node]));
      }
    }
    std::vector<int> units(problem_.variables.size(), 1);
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
      for_each_edge(sides, [&](EdgeId edge) { is_between_grids_[chords_.of(edge)] &= is_grid; });
      add_facing(face);
      for (const EdgeId edge : sides.rest) is_between_grids_[chords_.of(edge)] = 0;
      if (sides.rest.empty() || (sides.may_be_odd() && targets_.stride == 2)) continue;
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

  template <class Visit>
  static void for_each_edge(const FaceSides& sides, Visit&& visit) {
    for (const FacingPair& pair : sides.facing) {
      for (const FaceSide* side : {&pair.first, &pair.second}) {
        for (const SideEdge& edge : *side) visit(edge.edge);
      }
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
    auto& terms = variable(chords_.of(edge)).terms;
    const auto it =
        std::find_if(terms.begin(), terms.end(), [&](const auto& term) { return term.first == node; });
    if (it == terms.end()) {
      terms.push_back({node, coefficient});
    } else {
      it->second += problem_.rules[node] == BalanceProblem::Rule::even ? 1 - 2 * it->second : coefficient;
    }
  }

  /// Balances all faces. Drops faces whose facing sides cannot have equal counts until the others can.
  /// \return faces that stay odd.
  std::vector<FaceId> balance_faces() {
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
    return odd;
  }

  /// Balances faces by parity alone. \return faces that stay odd.
  std::vector<FaceId> make_faces_even() {
    start_values();
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
    return left;
  }

  /// The change by one, 1 or -1, that fits the wanted count better.
  static int change_of(const BalanceProblem::Variable& variable) {
    return variable.wanted >= variable.value || variable.value <= variable.least ? 1 : -1;
  }

  static double cost_of_change(const BalanceProblem::Variable& variable) {
    const double ratio = (variable.value + change_of(variable)) / std::max(variable.wanted, 0.5);
    return std::abs(std::log(ratio)) + 1e-6;
  }

  BalanceProblem::Variable& variable(EdgeId chord) { return problem_.variables[chord.index()]; }

  const CadShape& shape_;
  const CountTargets& targets_;
  const TinyFeatures& tiny_;
  FaceOutlines& sides_;
  IdVector<EdgeId, double> effective_;  // wanted count, at least `least`
  Chords chords_;
  // By the representative edge of a chord:
  IdVector<EdgeId, int> fixed_;                    // segments of the final mesh; 0 = any number
  IdVector<EdgeId, std::vector<EdgeId>> members_;  // edges
  IdVector<EdgeId, int> units_;                    // segments of the final mesh per unit of the count
  EdgeFlags is_between_grids_;                     // 1 = all its faces are grids
  BalanceProblem problem_;                         // one variable for each edge; only those of chords matter
  std::vector<FaceId> faces_of_nodes_;             // (nodes)
};

}  // namespace

EdgeCounts choose_counts(const CadShape& shape, const CountTargets& targets, const TinyFeatures& tiny,
                         FaceOutlines& sides) {
  EdgeCounts result = CountChooser(shape, targets, tiny, sides).run();
  choose_single_segments(shape, targets, sides, result);
  return result;
}

}  // namespace quadrille
