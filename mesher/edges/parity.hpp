#pragma once
/// Counts on edges made even round every face. Internal.

#include <vector>

namespace quadrille {

/// A model's edges for the parity problem: which faces change parity with the edge's count.
struct ParityEdge {
  std::vector<int> faces;  ///< faces (from 0) that use the edge an odd number of times
  double cost = 0;         ///< of changing the edge's count by one; infinite = must not change
};

/// Chooses a cheap set of edges to change by one so that every odd face becomes even (a T-join; by shortest
/// paths, and by elimination over GF(2) where edges join three faces and more). Faces that cannot be made
/// even are returned in `left_odd`. \return (edge count) 1 = change the edge.
std::vector<char> make_even(const std::vector<ParityEdge>& edges, std::vector<char> odd,
                            std::vector<int>& left_odd);

}  // namespace quadrille
