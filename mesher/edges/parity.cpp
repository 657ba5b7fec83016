/// A T-join (Edmonds & Johnson, Matching, Euler tours and the Chinese postman, 1973), approximated by a
/// minimum-weight basis over GF(2), which holds for edges of any number of faces.

#include "mesher/edges/parity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace quadrille {

namespace {

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

struct Row {
  Bits faces, combination;
};

}  // namespace

EdgeFlags make_even(const IdVector<EdgeId, ParityEdge>& edges, const FaceFlags& odd,
                    std::vector<FaceId>& left_odd, const std::function<void()>& check) {
  std::vector<EdgeId> order;
  for (const EdgeId edge : edges.ids()) {
    if (std::isfinite(edges[edge].cost) && !edges[edge].faces.empty()) order.push_back(edge);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](EdgeId a, EdgeId b) { return edges[a].cost < edges[b].cost; });
  const std::size_t face_words = (odd.size() + 63) / 64, edge_words = (edges.size() + 63) / 64;
  std::map<int, Row> basis;  // by lowest bit
  for (const EdgeId edge : order) {
    check();
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
  for (int bit = lowest_bit(target.faces); bit >= 0; bit = lowest_bit(target.faces)) {
    const auto it = basis.find(bit);
    if (it == basis.end()) {
      left_odd.push_back(FaceId::from_index(bit));
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

}  // namespace quadrille
