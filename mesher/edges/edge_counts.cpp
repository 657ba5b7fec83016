#include "mesher/edges/edge_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/pending/disjoint_sets.hpp>

#include "geometry/base/error.hpp"
#include "mesher/edges/count_balance.hpp"
#include "mesher/edges/parity.hpp"

namespace quadrille {

namespace {

constexpr double largest_ratio = 2;  // between wanted counts of the sides of a pair, or edges of a chord
constexpr double largest_fixed_ratio = 4;  // the same if one of them is fixed

class CountChooser {
 public:
  CountChooser(const CountWishes& wishes, const TinyFeatures& tiny, std::vector<FaceSides>& sides)
      : wishes_(wishes), tiny_(tiny), sides_(sides), chords_({}) {
    for (std::size_t i = 0; i < wishes.wanted.size(); ++i)
      effective_.push_back(std::max(wishes.wanted[i], 1.0 * wishes.least[i]));
  }

  EdgeCounts run() {
    is_waiting_.assign(sides_.size(), 0);
    for (std::size_t face = 0; face < sides_.size(); ++face)
      is_waiting_[face] = sides_[face].outline == FaceSides::Outline::stepped;
    tie_chords();
    std::vector<int> odd = balance_faces();
    if (odd.empty() && take_steps()) {
      odd = balance_faces();
      if (!odd.empty()) odd = balance_without_steps();
    }
    if (!odd.empty()) {
      // Usually edges of three or more faces. First drop faces with sides of several edges, then all.
      for (std::size_t face = 0; face < sides_.size(); ++face) {
        if (has_sums(sides_[face])) drop(static_cast<int>(face));
      }
      odd = make_faces_even();
    }
    if (!odd.empty()) {
      for (std::size_t face = 0; face < sides_.size(); ++face) drop(static_cast<int>(face));
      tie_chords();
      odd = make_faces_even();
    }
    hold_fixed(odd);
    EdgeCounts result{std::vector<int>(effective_.size(), 0), chords_, odd};
    for (std::size_t i = 0; i < effective_.size(); ++i) {
      const int chord = chords_.of(static_cast<int>(i));
      if (wishes_.least[i] == 0) continue;
      result.counts[i] = fixed_[chord] > 0 ? fixed_[chord] : units_[chord] * problem_.variables[chord].value;
    }
    return result;
  }

 private:
  static int rounded(double value) { return static_cast<int>(std::lround(value)); }

  static bool has_sums(const FaceSides& sides) {
    return std::any_of(sides.facing.begin(), sides.facing.end(),
                       [](const FacingPair& pair) { return pair.first.size() + pair.second.size() > 2; });
  }

  /// Reduces a face to a parity condition.
  void drop(int face) {
    FaceSides& sides = sides_[face];
    for (const FacingPair& pair : sides.facing) {
      for (const Side* side : {&pair.first, &pair.second}) {
        for (const SideEdge& edge : *side) sides.rest.push_back(edge.edge);
      }
    }
    sides.facing.clear();
    is_waiting_[face] = 0;
    if (sides.outline != FaceSides::Outline::odd) sides.outline = FaceSides::Outline::other;
  }

  double sum_of(const Side& side) const {
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
    return high > (has_fixed(pair) ? largest_fixed_ratio : largest_ratio) * low;
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
    std::vector<std::string> names;
    for (std::size_t i = 0; i < wishes_.fixed.size(); ++i) {
      if (wishes_.fixed[i] > 0 && includes(static_cast<int>(i)))
        names.push_back(fmt::format("Edge{}", i + 1));
    }
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// Throws if fixed numbers cannot be kept. \param odd faces (from 1) that stay odd.
  void hold_fixed(const std::vector<int>& odd) const {
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
      const int chord = static_cast<int>(i);
      if (chords_.of(chord) != chord || fixed_[i] % units_[i] == 0) continue;
      throw usage_error(
          "segments",
          fmt::format(
              "`segments` gives {} to {}, and a face there that is no grid takes even numbers only: {} or "
              "{}, or `strategy` direct",
              fixed_[i], fixed_edges([&](int edge) { return chords_.of(edge) == chord; }), fixed_[i] - 1,
              fixed_[i] + 1));
    }
    for (const int face : odd) {
      const std::string names = fixed_edges([&](int edge) { return is_on(edge, sides_[face - 1]); });
      if (names.empty()) continue;
      throw usage_error("segments",
                        fmt::format("`segments` leaves Face{} with an odd number of segments around it: "
                                    "one more or fewer on one of {}",
                                    face, names));
    }
  }

  static bool is_on(int edge, const FaceSides& sides) {
    const auto is_it = [&](const SideEdge& side) { return side.edge == edge; };
    return std::find(sides.rest.begin(), sides.rest.end(), edge) != sides.rest.end() ||
           std::any_of(sides.facing.begin(), sides.facing.end(), [&](const FacingPair& pair) {
             return std::any_of(pair.first.begin(), pair.first.end(), is_it) ||
                    std::any_of(pair.second.begin(), pair.second.end(), is_it);
           });
  }

  void tie_chords() {
    chords_ = Chords(effective_);
    fixed_ = wishes_.fixed;
    fixed_.resize(effective_.size(), 0);
    for (std::size_t i = 0; i < effective_.size(); ++i) {
      const int edge = static_cast<int>(i), same = tiny_.edges[i];
      if (same == edge) continue;
      if (!tie({same, true}, {edge, !tiny_.reversed_edges[i]}, std::numeric_limits<double>::infinity()))
        throw usage_error("segments",
                          fmt::format("`segments` gives different numbers to Edge{} and Edge{}, which "
                                      "have the same nodes",
                                      same + 1, edge + 1));
    }
    for (std::size_t face = 0; face < sides_.size(); ++face) {
      const auto& facing = sides_[face].facing;
      if (is_waiting_[face]) continue;
      bool fits = std::none_of(facing.begin(), facing.end(),
                               [&](const FacingPair& pair) { return is_far_off(pair); });
      for (const FacingPair& pair : facing) {
        if (fits && pair.first.size() == 1 && pair.second.size() == 1)
          fits = tie(pair.first[0], pair.second[0], largest_ratio);
      }
      if (!fits) drop(static_cast<int>(face));
    }
    start_values();
  }

  /// Starts each chord near the mean count of its members, in segments of the mesh that is recombined.
  void start_values() {
    units_.assign(effective_.size(), wishes_.stride);
    members_.assign(effective_.size(), {});
    for (std::size_t i = 0; i < effective_.size(); ++i) {
      if (wishes_.least[i] != 0) members_[chords_.of(static_cast<int>(i))].push_back(static_cast<int>(i));
    }
    problem_.variables.assign(effective_.size(), {});
    for (std::size_t i = 0; i < effective_.size(); ++i) start_value(static_cast<int>(i));
  }

  /// Sets all of a chord's variable but its terms. One unit is `units_[chord]` segments of the final mesh.
  void start_value(int chord) {
    const std::vector<int>& members = members_[chord];
    if (members.empty()) return;
    auto& variable = problem_.variables[chord];
    const int unit = units_[chord], parts = wishes_.stride / unit;
    const bool final_segments = unit < wishes_.stride;
    bool even = false;
    double wanted = 0;
    variable.least = 1;
    for (const int i : members) {
      wanted += wishes_.wanted[i];
      variable.least =
          std::max(variable.least, final_segments ? wishes_.least_of_grids[i] : wishes_.least[i]);
      even |= !wishes_.even.empty() && wishes_.even[i] != 0;
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
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (!is_between_grids_[i]) units[groups.find_set(i)] = wishes_.stride;
    }
    for (std::size_t i = 0; i < units.size(); ++i) {
      const int unit = units[groups.find_set(i)];
      if (units_[i] == unit) continue;
      units_[i] = unit;
      start_value(static_cast<int>(i));
    }
  }

  /// Turns the rules of all faces into nodes of the problem.
  void set_up_rules() {
    for (auto& variable : problem_.variables) variable.terms.clear();
    problem_.rules.clear();
    faces_of_nodes_.clear();
    is_between_grids_.assign(problem_.variables.size(), 1);
    for (std::size_t face = 0; face < sides_.size(); ++face) {
      const FaceSides& sides = sides_[face];
      const bool is_grid =
          sides.rest.empty() && sides.outline != FaceSides::Outline::other && !is_waiting_[face];
      for_each_edge(sides, [&](int edge) { is_between_grids_[chords_.of(edge)] &= is_grid; });
      if (is_waiting_[face]) {
        const int node = add_node(static_cast<int>(face), BalanceProblem::Rule::even);
        for_each_edge(sides, [&](int edge) { add_term(edge, node, 1); });
        continue;
      }
      add_facing(static_cast<int>(face));
      for (const int edge : sides.rest) is_between_grids_[chords_.of(edge)] = 0;
      // One more node at the base of a wedge or the end of a strip would make elements far shorter than they
      // are wide.
      const bool may_be_odd = !sides.facing.empty() && sides.outline != FaceSides::Outline::holed;
      if (sides.rest.empty() || (may_be_odd && wishes_.stride == 2)) continue;
      const int node = add_node(static_cast<int>(face), BalanceProblem::Rule::even);
      for (const int edge : sides.rest) add_term(edge, node, 1);
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

  /// Adds the facing sides of stepped faces, one face at a time. A face whose sides would take the counts too
  /// far from the wanted ones loses its outline instead, so that no other face suffers for it.
  /// \return whether there are stepped faces.
  bool take_steps() {
    bool any = false;
    for (std::size_t face = 0; face < sides_.size(); ++face) {
      if (!is_waiting_[face]) continue;
      any = true;
      if (!take_steps_of(static_cast<int>(face))) drop(static_cast<int>(face));
      is_waiting_[face] = 0;
    }
    if (any) set_up_rules();
    return any;
  }

  std::vector<int> balance_without_steps() {
    for (std::size_t face = 0; face < sides_.size(); ++face) {
      if (sides_[face].outline == FaceSides::Outline::stepped) drop(static_cast<int>(face));
    }
    start_values();
    return balance_faces();
  }

  bool take_steps_of(int face) {
    const auto& facing = sides_[face].facing;
    if (std::any_of(facing.begin(), facing.end(), [&](const FacingPair& pair) { return is_far_off(pair); }))
      return false;
    const int rules = static_cast<int>(problem_.rules.size());
    constexpr double most = 0.25;  // added squared deviation: that of an edge with 1.5 times its wanted count
    // The facing sides replace the face's even sum.
    const auto ruled = std::find(faces_of_nodes_.begin(), faces_of_nodes_.end(), face);
    const int even = static_cast<int>(ruled - faces_of_nodes_.begin());
    std::vector<int> values;
    std::vector<std::size_t> ruled_chords;
    for (std::size_t i = 0; i < problem_.variables.size(); ++i) {
      auto& variable = problem_.variables[i];
      values.push_back(variable.value);
      if (std::erase_if(variable.terms, [&](const auto& term) { return term.first == even; }) > 0)
        ruled_chords.push_back(i);
    }
    add_facing(face);
    drop_idle_terms();
    const double cost = deviation(problem_);
    if (balance(problem_).empty() && deviation(problem_) <= cost + most) return true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      problem_.variables[i].value = values[i];
      std::erase_if(problem_.variables[i].terms, [&](const auto& term) { return term.first >= rules; });
    }
    for (const std::size_t i : ruled_chords) problem_.variables[i].terms.push_back({even, 1});
    problem_.rules.resize(rules);
    faces_of_nodes_.resize(rules);
    return false;
  }

  static double deviation(const BalanceProblem& problem) {
    double sum = 0;
    for (const auto& variable : problem.variables) {
      const double wanted = std::max(variable.wanted, 1.0 * variable.least);
      sum += variable.weight * std::pow((variable.value - wanted) / wanted, 2);
    }
    return sum;
  }

  template <class Visit>
  static void for_each_edge(const FaceSides& sides, Visit&& visit) {
    for (const FacingPair& pair : sides.facing) {
      for (const Side* side : {&pair.first, &pair.second}) {
        for (const SideEdge& edge : *side) visit(edge.edge);
      }
    }
  }

  /// Adds the rules that facing sides have equal counts.
  void add_facing(int face) {
    for (const FacingPair& pair : sides_[face].facing) {
      const int node = add_node(face, BalanceProblem::Rule::zero);
      for (const SideEdge& edge : pair.first) add_term(edge.edge, node, 1);
      for (const SideEdge& edge : pair.second) add_term(edge.edge, node, -1);
    }
  }

  int add_node(int face, BalanceProblem::Rule rule) {
    problem_.rules.push_back(rule);
    faces_of_nodes_.push_back(face);
    return static_cast<int>(problem_.rules.size()) - 1;
  }

  void add_term(int edge, int node, int coefficient) {
    if (wishes_.least[edge] == 0) return;
    auto& terms = problem_.variables[chords_.of(edge)].terms;
    const auto it =
        std::find_if(terms.begin(), terms.end(), [&](const auto& term) { return term.first == node; });
    if (it == terms.end()) {
      terms.push_back({node, coefficient});
    } else {
      it->second += problem_.rules[node] == BalanceProblem::Rule::even ? 1 - 2 * it->second : coefficient;
    }
  }

  /// Balances all faces. Drops faces whose facing sides cannot have equal counts until the others can.
  /// \return faces (from 1) that stay odd.
  std::vector<int> balance_faces() {
    std::vector<int> odd;
    for (bool dropped = true; dropped;) {
      set_up_rules();
      dropped = false;
      odd.clear();
      for (const int node : balance(problem_)) {
        const int face = faces_of_nodes_[node];
        if (problem_.rules[node] == BalanceProblem::Rule::even) odd.push_back(face + 1);
        if (sides_[face].facing.empty()) continue;
        drop(face);
        dropped = true;
      }
    }
    return odd;
  }

  /// Balances faces by parity alone. \return faces (from 1) that stay odd.
  std::vector<int> make_faces_even() {
    start_values();
    set_up_rules();
    std::vector<ParityEdge> edges(problem_.variables.size());
    std::vector<char> odd(sides_.size(), 0);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto& variable = problem_.variables[i];
      edges[i].cost = variable.fixed ? std::numeric_limits<double>::infinity()
                                     : variable.weight * cost_of_change(variable);
      for (const auto& [node, coefficient] : variable.terms) {
        const int face = faces_of_nodes_[node];
        edges[i].faces.push_back(face);
        if (variable.value % 2 != 0) odd[face] ^= 1;
      }
    }
    std::vector<int> left;
    const std::vector<char> change = make_even(edges, odd, left);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (change[i]) problem_.variables[i].value += change_of(problem_.variables[i]);
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

  const CountWishes& wishes_;
  const TinyFeatures& tiny_;
  std::vector<FaceSides>& sides_;
  std::vector<double> effective_;  // (edges) wanted count, at least `least`
  Chords chords_;
  std::vector<int> fixed_;                 // (chords) segments of the final mesh; 0 = any number
  std::vector<std::vector<int>> members_;  // (chords) edges
  std::vector<int> units_;                 // (chords) segments of the final mesh per unit of the count
  BalanceProblem problem_;           // one variable for each edge; only those of chord representatives matter
  std::vector<int> faces_of_nodes_;  // (nodes) from 0
  std::vector<char> is_between_grids_;  // (chords) 1 = all its faces are grids
  std::vector<char> is_waiting_;        // (faces) 1 = stepped, only its even sum counts so far
};

}  // namespace

EdgeCounts choose_counts(const CountWishes& wishes, const TinyFeatures& tiny, std::vector<FaceSides>& sides) {
  return CountChooser(wishes, tiny, sides).run();
}

}  // namespace quadrille
