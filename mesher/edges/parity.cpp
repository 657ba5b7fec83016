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
  NearestPairs(const IdVector<EdgeId, ParityEdge>& edges, int faces)
      : edges_(edges), outside_(faces), adjacency_(faces + 1), change_(edges.size()) {
    for (const EdgeId edge : edges.ids()) {
      const auto& uses = edges[edge].faces;
      if (!std::isfinite(edges[edge].cost) || uses.empty() || uses.size() > 2) continue;
      const int a = uses[0].index(), b = uses.size() == 2 ? uses[1].index() : outside_;
      adjacency_[a].push_back({b, edge});
      adjacency_[b].push_back({a, edge});
    }
  }

  /// \return false if no other odd face and no edge of a single face can be reached.
  bool pair_up(FaceId start_face, FaceFlags& odd) {
    constexpr double unreached = std::numeric_limits<double>::infinity();
    const int start = start_face.index();
    std::vector<double> distance(adjacency_.size(), unreached);
    std::vector<std::pair<int, EdgeId>> from(adjacency_.size());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    distance[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [d, at] = queue.top();
      queue.pop();
      if (d > distance[at]) continue;
      if (at != start && (at == outside_ || odd[FaceId::from_index(at)])) {
        for (int node = at; node != start; node = from[node].first) change_[from[node].second] ^= 1;
        odd[start_face] = 0;
        if (at != outside_) odd[FaceId::from_index(at)] = 0;
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

  const EdgeFlags& change() const { return change_; }

 private:
  const IdVector<EdgeId, ParityEdge>& edges_;
  int outside_;  // node of the graph; the others are indices of faces
  std::vector<std::vector<std::pair<int, EdgeId>>> adjacency_;
  EdgeFlags change_;
};

using Bits = std::vector<std::uint64_t>;

void add_to(Bits& a, const Bits& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] ^= b[i];
}

void flip(Bits& bits, int bit) {
  bits[bit / 64] ^= std::uint64_t{1} << (bit % 64);
}

int lowest_bit(const Bits& bits) {
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i]) return static_cast<int>(64 * i) + __builtin_ctzll(bits[i]);
  }
  return -1;
}

/// Solves for the odd faces with the cheapest basis of columns. Faces that cannot be made even stay odd.
EdgeFlags eliminate(const IdVector<EdgeId, ParityEdge>& edges, FaceFlags& odd) {
  struct Row {
    Bits faces, combination;
  };
  std::vector<EdgeId> order;
  for (const EdgeId edge : edges.ids()) {
    if (std::isfinite(edges[edge].cost) && !edges[edge].faces.empty()) order.push_back(edge);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](EdgeId a, EdgeId b) { return edges[a].cost < edges[b].cost; });
  const std::size_t face_words = (odd.size() + 63) / 64, edge_words = (edges.size() + 63) / 64;
  std::map<int, Row> basis;  // by lowest bit
  for (const EdgeId edge : order) {
    Row row{Bits(face_words), Bits(edge_words)};
    for (const FaceId face : edges[edge].faces) flip(row.faces, face.index());
    flip(row.combination, edge.index());
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
  for (const FaceId face : odd.ids()) {
    if (odd[face]) flip(target.faces, face.index());
  }
  std::fill(odd.begin(), odd.end(), 0);
  for (int bit = lowest_bit(target.faces); bit >= 0; bit = lowest_bit(target.faces)) {
    const auto it = basis.find(bit);
    if (it == basis.end()) {
      odd[FaceId::from_index(bit)] = 1;
      flip(target.faces, bit);
      continue;
    }
    add_to(target.faces, it->second.faces);
    add_to(target.combination, it->second.combination);
  }
  EdgeFlags change(edges.size());
  for (const EdgeId edge : edges.ids())
    change[edge] = target.combination[edge.index() / 64] >> (edge.index() % 64) & 1;
  return change;
}

}  // namespace

EdgeFlags make_even(const IdVector<EdgeId, ParityEdge>& edges, FaceFlags odd, std::vector<FaceId>& left_odd) {
  const FaceFlags start = odd;
  NearestPairs pairs(edges, static_cast<int>(odd.size()));
  bool solved = true;
  for (const FaceId face : odd.ids()) {
    if (solved && odd[face]) solved = pairs.pair_up(face, odd);
  }
  EdgeFlags change = pairs.change();
  if (!solved) {
    odd = start;
    change = eliminate(edges, odd);
  }
  for (const FaceId face : odd.ids()) {
    if (odd[face]) left_odd.push_back(face);
  }
  return change;
}

}  // namespace quadrille
