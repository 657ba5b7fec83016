#pragma once
/// Integers near wanted values whose sums must balance, or be even around every face. Internal.

#include <functional>
#include <utility>
#include <vector>

#include "geometry/cad/ids.hpp"

namespace quadrille {

/// Finds integers with small weighted squared deviations from the wanted values, such that at each node the
/// sum of the terms is zero, or even.
struct BalanceProblem {
  struct Variable {
    double wanted = 0;
    double weight = 1;  ///< weight of the squared deviation
    int least = 1;
    int value = 1;                           ///< in: start value, at least `least`; out: the solution
    std::vector<std::pair<int, int>> terms;  ///< node and coefficient
    bool fixed = false;                      ///< `value` stays as it is
  };
  enum class Rule { zero, even };
  std::vector<Variable> variables;
  std::vector<Rule> rules;  ///< (nodes)

  /// (nodes) sums of the terms at the current values.
  std::vector<int> sums() const;
};

/// Changes the values until all sums keep their rules. Each step starts at a node whose sum breaks its rule
/// and takes the cheapest path of changes by one to another such node, or to a variable with one term only.
/// The sums of the nodes on the path stay as they are. Variables with more than two terms, or with
/// coefficients other than 1 and -1, do not change. No changed value ends further than a factor of about two
/// from the wanted one. The model's edges form a bidirected graph here: Heistermann et al.,
/// Min-Deviation-Flow in Bi-directed Graphs for T-Mesh Quantization (2023), solve the same problem exactly.
/// \return the nodes whose rules remain broken, ascending; empty = solved. Time: (sum of all errors) x
/// (variables reached) x log. \param check called once for each path; may throw
std::vector<int> balance(
    BalanceProblem& problem, const std::function<void()>& check = [] {});

/// An edge of the parity problem: the faces that change parity with the edge's count.
struct ParityEdge {
  std::vector<FaceId> faces;  ///< faces that use the edge an odd number of times
  double cost = 0;            ///< cost of changing the edge's count by one; infinite = must not change
};

/// Chooses a cheap set of edges to change by one so that every odd face becomes even (a T-join): no edge of
/// the set costs more than it must. Edges may have any number of faces. Faces that cannot be made even are
/// added to `left_odd`. Time: edges x faces squared at worst. \param check called once for each edge; may
/// throw \return 1 = change the edge's count.
EdgeFlags make_even(
    const IdVector<EdgeId, ParityEdge>& edges, const FaceFlags& odd, std::vector<FaceId>& left_odd,
    const std::function<void()>& check = [] {});

}  // namespace quadrille
