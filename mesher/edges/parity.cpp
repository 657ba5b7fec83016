/// A T-join (Edmonds & Johnson, Matching, Euler tours and the Chinese postman, 1973), approximated by a
/// minimum-weight basis over GF(2), which holds for edges of any number of faces.

#include "mesher/edges/count_balance.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <boost/dynamic_bitset.hpp>

namespace quadrille {

EdgeFlags make_even(const IdVector<EdgeId, ParityEdge>& edges, const FaceFlags& odd,
                    std::vector<FaceId>& left_odd, const std::function<void()>& check) {
  std::vector<EdgeId> order;
  for (const EdgeId edge : edges.ids()) {
    if (std::isfinite(edges[edge].cost) && !edges[edge].faces.empty()) order.push_back(edge);
  }
  std::ranges::stable_sort(order, {}, [&](EdgeId edge) { return edges[edge].cost; });
  using Bits = boost::dynamic_bitset<>;
  struct Row {
    Bits faces, edges;
  };
  const Row none{Bits(odd.size()), Bits(edges.size())};
  std::map<std::size_t, Row> basis;  // by the first face
  // Adds rows of the basis as long as one begins with the same face. Returns the first face that is left.
  const auto reduce = [&](Row& row) {
    std::size_t first = row.faces.find_first();
    for (auto it = basis.find(first); it != basis.end(); it = basis.find(first)) {
      row.faces ^= it->second.faces;
      row.edges ^= it->second.edges;
      first = row.faces.find_first();
    }
    return first;
  };
  for (const EdgeId edge : order) {
    check();
    Row row = none;
    for (const FaceId face : edges[edge].faces) row.faces.flip(face.index());
    row.edges.flip(edge.index());
    if (const std::size_t first = reduce(row); first != Bits::npos) basis.emplace(first, std::move(row));
  }
  Row target = none;
  for (const FaceId face : odd.ids()) {
    if (odd[face]) target.faces.flip(face.index());
  }
  for (std::size_t face = reduce(target); face != Bits::npos; face = reduce(target)) {
    left_odd.push_back(FaceId::from_index(static_cast<int>(face)));
    target.faces.flip(face);
  }
  EdgeFlags change(edges.size());
  for (const EdgeId edge : edges.ids()) change[edge] = target.edges[edge.index()];
  return change;
}

}  // namespace quadrille
