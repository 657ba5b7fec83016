/// Uses LEMON's maximum weighted matching (Edmonds 1965, in O(n m log n)). LEMON 1.3 is C++17.

#include "bench/best_pairing.hpp"

#include <lemon/matching.h>
#include <lemon/smart_graph.h>

#include <cmath>

namespace quadrille::bench {

namespace {

using Graph = lemon::SmartGraph;
using Weights = Graph::EdgeMap<long>;

template <class Matching>
std::vector<int> chosen(Matching& matching, const Graph& graph) {
  matching.run();
  std::vector<int> pairs;
  for (Graph::EdgeIt edge(graph); edge != lemon::INVALID; ++edge) {
    if (matching.matching(edge)) pairs.push_back(graph.id(edge));
  }
  return pairs;
}

}  // namespace

std::vector<int> best_pairing(int triangle_count, const std::vector<PossiblePair>& pairs, bool perfect) {
  Graph graph;
  graph.reserveNode(triangle_count);
  for (int t = 0; t < triangle_count; ++t) graph.addNode();
  Weights weights(graph);
  for (const PossiblePair& pair : pairs) {
    weights[graph.addEdge(Graph::nodeFromId(pair.one), Graph::nodeFromId(pair.two))] =
        std::lround(1e6 * pair.q);
  }
  if (!perfect) {
    lemon::MaxWeightedMatching<Graph, Weights> matching(graph, weights);
    return chosen(matching, graph);
  }
  lemon::MaxWeightedPerfectMatching<Graph, Weights> matching(graph, weights);
  const std::vector<int> result = chosen(matching, graph);
  return static_cast<int>(2 * result.size()) == triangle_count ? result : std::vector<int>{};
}

}  // namespace quadrille::bench
