/// A T-join (Edmonds & Johnson, Matching, Euler tours and the Chinese postman, 1973), approximated by nearest
/// pairs or, if these fail, by a minimum-weight basis over GF(2).

#include "mesher/edges/parity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>

namespace quadrille {

namespace {

/// Dijkstra's algorithm from an odd face to the nearest other one or to the outside. Flips the path's edges.
class NearestPairs {
 public:
  NearestPairs(const std::vector<ParityEdge>& edges, int faces)
      : edges_(edges), outside_(faces), adjacency_(faces + 1), change_(edges.size(), 0) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto& uses = edges[i].faces;
      if (!std::isfinite(edges[i].cost) || uses.empty() || uses.size() > 2) continue;
      const int a = uses[0], b = uses.size() == 2 ? uses[1] : outside_;
      adjacency_[a].push_back({b, static_cast<int>(i)});
      adjacency_[b].push_back({a, static_cast<int>(i)});
    }
  }

  /// \return false if no other odd face and no edge of a single face can be reached.
  bool pair_up(int start, std::vector<char>& odd) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> distance(adjacency_.size(), infinity);
    std::vector<std::pair<int, int>> from(adjacency_.size(), {-1, -1});
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    distance[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [d, at] = queue.top();
      queue.pop();
      if (d > distance[at]) continue;
      if (at != start && (at == outside_ || odd[at])) {
        for (int node = at; node != start; node = from[node].first) change_[from[node].second] ^= 1;
        odd[start] = 0;
        if (at != outside_) odd[at] = 0;
        return true;
      }
      for (const auto& [to, edge] : adjacency_[at]) {
        const double next = d + (change_[edge] ? 0 : edges_[edge].cost);
        if (next < distance[to]) {
          distance[to] = next;
          from[to] = {at, edge};
          queue.push({next, to});
        }
      }
    }
    return false;
  }

  const std::vector<char>& change() const { return change_; }

 private:
  const std::vector<ParityEdge>& edges_;
  int outside_;
  std::vector<std::vector<std::pair<int, int>>> adjacency_;
  std::vector<char> change_;
};

using Bits = std::vector<std::uint64_t>;

void add_to(Bits& a, const Bits& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] ^= b[i];
}

int lowest_bit(const Bits& bits) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i]) return static_cast<int>(64 * i) + __builtin_ctzll(bits[i]);
  }
  return -1;
}

/// Solves for the odd faces with the cheapest basis of columns. Faces that cannot be made even stay odd.
std::vector<char> eliminate(const std::vector<ParityEdge>& edges, std::vector<char>& odd) {
  struct Row {
    Bits faces, combination;
  };
  std::vector<int> order;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (std::isfinite(edges[i].cost) && !edges[i].faces.empty()) order.push_back(static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return edges[a].cost < edges[b].cost; });
  const std::size_t face_words = (odd.size() + 63) / 64, edge_words = (edges.size() + 63) / 64;
  std::map<int, Row> basis;  // by lowest bit
  for (const int edge : order) {
    Row row{Bits(face_words), Bits(edge_words)};
    for (const int face : edges[edge].faces) row.faces[face / 64] ^= std::uint64_t{1} << (face % 64);
    row.combination[edge / 64] |= std::uint64_t{1} << (edge % 64);
    for (int bit = lowest_bit(row.faces); bit >= 0; bit = lowest_bit(row.faces)) {
      const auto it = basis.find(bit);
      if (it == basis.end()) {
        basis.emplace(bit, std::move(row));
        break;
      }
      add_to(row.faces, it->second.faces);
      add_to(row.combination, it->second.combination);
    }
  }
  Row target{Bits(face_words), Bits(edge_words)};
  for (std::size_t face = 0; face < odd.size(); ++face) {
    if (odd[face]) target.faces[face / 64] |= std::uint64_t{1} << (face % 64);
  }
  std::fill(odd.begin(), odd.end(), 0);
  for (int bit = lowest_bit(target.faces); bit >= 0; bit = lowest_bit(target.faces)) {
    const auto it = basis.find(bit);
    if (it == basis.end()) {
      odd[bit] = 1;
      target.faces[bit / 64] ^= std::uint64_t{1} << (bit % 64);
      continue;
    }
    add_to(target.faces, it->second.faces);
    add_to(target.combination, it->second.combination);
  }
  std::vector<char> change(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) change[i] = target.combination[i / 64] >> (i % 64) & 1;
  return change;
}

}  // namespace

std::vector<char> make_even(const std::vector<ParityEdge>& edges, std::vector<char> odd,
                            std::vector<int>& left_odd) {
  const std::vector<char> start = odd;
  NearestPairs pairs(edges, static_cast<int>(odd.size()));
  bool solved = true;
  for (std::size_t face = 0; face < odd.size() && solved; ++face) {
    if (odd[face]) solved = pairs.pair_up(static_cast<int>(face), odd);
  }
  std::vector<char> change = pairs.change();
  if (!solved) {
    odd = start;
    change = eliminate(edges, odd);
  }
  for (std::size_t face = 0; face < odd.size(); ++face) {
    if (odd[face]) left_odd.push_back(static_cast<int>(face) + 1);
  }
  return change;
}

}  // namespace quadrille
