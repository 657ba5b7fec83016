/// Corrects one wrong sum after another along cheapest paths of changes by one (Dijkstra).

#include "mesher/edges/count_balance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <queue>

namespace quadrille {

namespace {

using Rule = BalanceProblem::Rule;
constexpr double infinity = std::numeric_limits<double>::infinity();

class Balancer {
 public:
  Balancer(BalanceProblem& problem, const std::function<void()>& check)
      : problem_(problem),
        check_(check),
        variables_(problem.variables),
        sums_(problem.sums()),
        at_node_(problem.rules.size()) {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (!can_change(variables_[i])) continue;
      for (const auto& [node, coefficient] : variables_[i].terms)
        at_node_[node].push_back(static_cast<int>(i));
    }
  }

  std::vector<int> run() {
    std::vector<int> left;
    for (int node = 0; node < static_cast<int>(sums_.size()); ++node) {
      while (is_wrong(node) && mend(node)) {
      }
      if (is_wrong(node)) left.push_back(node);
    }
    return left;
  }

 private:
  /// A stop on a path: a node and the change that its sum needs: +1 or -1, or 0 for either at an `even` rule.
  struct State {
    int node, need;
  };
  struct Step {
    int from = -1, variable = -1, change = 0;
  };

  static bool can_change(const BalanceProblem::Variable& variable) {
    return !variable.fixed && variable.terms.size() <= 2 &&
           std::ranges::all_of(variable.terms, [](const auto& term) { return std::abs(term.second) == 1; });
  }

  bool is_wrong(int node) const {
    return problem_.rules[node] == Rule::zero ? sums_[node] != 0 : sums_[node] % 2 != 0;
  }

  /// The number of a state.
  static int key(const State& state) { return 2 * state.node + (state.need > 0); }
  State state(int key) const {
    const int node = key / 2;
    if (problem_.rules[node] == Rule::even) return {node, 0};
    return {node, key % 2 ? 1 : -1};
  }

  double cost(const BalanceProblem::Variable& variable, int change) const {
    const int after = variable.value + change;
    const double possible = std::max(variable.wanted, 1.0 * variable.least);
    if (after < variable.least || after > 2 * possible + 1 || 2 * (after + 1) < possible) return infinity;
    // Relative to the wanted value even if that is below `least`: two rows in a strip whose wanted count is a
    // fifth of a row are worse than eleven segments instead of ten.
    constexpr double smallest_wanted = 0.1;
    const double wanted = std::max(variable.wanted, smallest_wanted);
    const auto deviation = [&](int value) { return std::pow((value - wanted) / wanted, 2); };
    constexpr double smallest = 1e-6;  // prefers short paths where all else is equal
    return variable.weight * std::max(0.0, deviation(after) - deviation(variable.value)) + smallest;
  }

  /// Applies the cheapest path from a node; false if there is none.
  bool mend(int start) {
    constexpr int tries = 8;
    banned_.clear();
    for (int i = 0; i < tries; ++i) {
      check_();
      const std::vector<Step> walk = find_walk({start, problem_.rules[start] == Rule::even ? 0
                                                       : sums_[start] > 0                  ? -1
                                                                                           : 1});
      if (walk.empty()) return false;
      if (apply(walk)) return true;
    }
    return false;
  }

  std::vector<Step> find_walk(const State& start) const {
    std::vector<double> distance(2 * sums_.size(), infinity);
    std::vector<Step> arrived(2 * sums_.size());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    double best = infinity;
    Step last;
    distance[key(start)] = 0;
    queue.push({0, key(start)});
    while (!queue.empty() && queue.top().first < best) {
      const double d = queue.top().first;
      const auto at = queue.top().second;
      queue.pop();
      if (d > distance[at]) continue;
      for_each_change(state(at), [&](int variable, int change, int other, int effect) {
        const double next = d + cost(variables_[variable], change);
        if (!(next < best)) return;
        const Step step{at, variable, change};
        if (other < 0 || (other == start.node ? closes(start, effect) : absorbs(other, effect))) {
          best = next;
          last = step;
          return;
        }
        const int to = key(problem_.rules[other] == Rule::even ? State{other, 0} : State{other, -effect});
        if (!(next < distance[to])) return;
        distance[to] = next;
        arrived[to] = step;
        queue.push({next, to});
      });
    }
    std::vector<Step> walk;
    for (Step step = last; step.variable >= 0; step = arrived[step.from]) {
      walk.push_back(step);
      if (step.from == key(start)) break;
    }
    return walk;
  }

  /// Visits the changes by one that give a node what it needs, with the node at the variable's other term
  /// (-1 = none) and the change of its sum.
  template <class Visit>
  void for_each_change(const State& at, Visit&& visit) const {
    for (const int i : at_node_[at.node]) {
      const auto& terms = variables_[i].terms;
      const std::size_t here = terms[0].first == at.node ? 0 : 1;
      const auto other = terms.size() == 2 ? terms[1 - here] : std::pair<int, int>{-1, 0};
      for (const int change : {1, -1}) {
        if (at.need != 0 && change * terms[here].second != at.need) continue;
        if (std::ranges::find(banned_, std::pair{i, change}) != banned_.end()) continue;
        visit(i, change, other.first, change * other.second);
      }
    }
  }

  /// Whether a path that returns to its start reduces the error there by two.
  bool closes(const State& start, int effect) const {
    return problem_.rules[start.node] == Rule::zero && std::abs(sums_[start.node]) >= 2 &&
           effect == start.need;
  }

  bool absorbs(int node, int effect) const {
    if (problem_.rules[node] == Rule::even) return sums_[node] % 2 != 0;
    return std::abs(sums_[node] + effect) < std::abs(sums_[node]);
  }

  /// \return false, with nothing changed, if a path that uses a variable twice would take it below `least`.
  bool apply(const std::vector<Step>& walk) {
    std::size_t done = 0;
    bool fits = true;
    for (; done < walk.size() && fits; ++done) {
      auto& variable = variables_[walk[done].variable];
      variable.value += walk[done].change;
      fits = variable.value >= variable.least;
    }
    if (!fits) {
      banned_.push_back({walk[done - 1].variable, walk[done - 1].change});
      while (done > 0) {
        --done;
        variables_[walk[done].variable].value -= walk[done].change;
      }
      return false;
    }
    for (const Step& step : walk) {
      for (const auto& [node, coefficient] : variables_[step.variable].terms)
        sums_[node] += coefficient * step.change;
    }
    return true;
  }

  BalanceProblem& problem_;
  const std::function<void()>& check_;
  std::vector<BalanceProblem::Variable>& variables_;
  std::vector<int> sums_;
  std::vector<std::vector<int>> at_node_;
  std::vector<std::pair<int, int>> banned_;  // variable and change
};

}  // namespace

std::vector<int> BalanceProblem::sums() const {
  std::vector<int> result(rules.size(), 0);
  for (const Variable& variable : variables) {
    for (const auto& [node, coefficient] : variable.terms) result[node] += coefficient * variable.value;
  }
  return result;
}

std::vector<int> balance(BalanceProblem& problem, const std::function<void()>& check) {
  return Balancer(problem, check).run();
}

}  // namespace quadrille
