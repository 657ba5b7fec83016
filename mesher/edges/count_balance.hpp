#pragma once
/// Whole numbers near those wanted, under sums that must balance. Internal.

#include <utility>
#include <vector>

namespace quadrille {

/// Whole numbers x with weighted squares of their deviations from what is wanted small, such that at each
/// node the sum of the terms is zero, or even.
struct BalanceProblem {
  struct Variable {
    double wanted = 0;
    double weight = 1;  ///< of the deviation
    int least = 1;
    int value = 1;  ///< in: where to start from, not below `least`; out: the solution
    std::vector<std::pair<int, int>> terms;  ///< node and coefficient
    bool fixed = false;                      ///< `value` stays as it is
  };
  enum class Rule { zero, even };
  std::vector<Variable> variables;
  std::vector<Rule> rules;  ///< (nodes)

  /// (nodes) sums of the terms.
  std::vector<int> sums() const;
};

/// Changes the values until the sums keep their rules: each step takes a node that does not, and the cheapest
/// walk of changes by one from it to another such node or to a variable's free end, so that nodes on the way
/// stay as they are. Variables of more than two terms, or of coefficients other than 1 and -1, are left
/// alone; none ends further from what is wanted than a factor of about two. The model's edges make a
/// bidirected graph here: Heistermann et al., Min-Deviation-Flow in Bi-directed Graphs for T-Mesh
/// Quantization (2023), solve the same problem exactly. \return the nodes whose rules cannot be kept so,
/// ascending; empty = solved. Time: (sum of what is wrong) x (variables reached) x log.
std::vector<int> balance(BalanceProblem& problem);

}  // namespace quadrille
