#include "mesher/edges/edge_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/edges/parity.hpp"

namespace quadrille {

namespace {

/// The faces used that have the edge an odd number of times.
std::vector<int> odd_uses(const CadEdge& edge, const std::vector<char>& used) {
  std::vector<int> faces;
  for (const int face : edge.faces) {
    if (!used[face - 1]) continue;
    if (!faces.empty() && faces.back() == face - 1) {
      faces.pop_back();
    } else {
      faces.push_back(face - 1);
    }
  }
  return faces;
}

/// Edges that get the same count, because they face each other across a face. A union-find structure.
class TiedEdges {
 public:
  explicit TiedEdges(const std::vector<double>& wanted)
      : parent_(wanted.size()), low_(wanted), high_(wanted) {
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<int>(i);
  }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Ties two edges unless that would take some edge of either class too far from its wanted count.
  void tie(int a, int b, double largest_ratio = 1.5) {
    a = find(a);
    b = find(b);
    const double low = std::min(low_[a], low_[b]), high = std::max(high_[a], high_[b]);
    if (a == b || high > largest_ratio * low) return;
    parent_[b] = a;
    low_[a] = low;
    high_[a] = high;
  }

 private:
  std::vector<int> parent_;
  std::vector<double> low_, high_;
};

/// Sides that face each other: of faces with four always, of wedges and crescents where they are narrow.
/// \returns a flag for each face, whether it is a narrow wedge.
std::vector<char> tie_facing_sides(const CadShape& shape, const std::vector<char>& used,
                                   const std::vector<double>& wanted, TiedEdges& tied) {
  std::vector<char> is_wedge(shape.faces.size(), 0);
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    if (!used[i]) continue;
    const auto pairs = facing_sides(shape, shape.faces[i]);
    if (pairs.empty() || has_unusual_edges(shape, shape.faces[i])) continue;
    for (const FacingSides& sides : pairs) {
      const int a = sides.first->edge - 1, b = sides.second->edge - 1;
      const std::size_t count = shape.faces[i].wires[0].coedges.size();
      const bool is_narrow = sides.width < narrow * segment_length(shape, wanted, a);
      if (count == 4 || is_narrow) tied.tie(a, b);
      if (count == 3 && is_narrow) is_wedge[i] = 1;
    }
  }
  return is_wedge;
}

/// Whether one more or one fewer segment fits the wanted count better.
int change_of(int count, double wanted, int least) {
  return wanted >= count || count <= least ? 1 : -1;
}

double cost_of_change(int count, double wanted, int least) {
  const double ratio = (count + change_of(count, wanted, least)) / std::max(wanted, 0.5);
  return std::abs(std::log(ratio)) + 1e-6;
}

}  // namespace

std::vector<int> choose_counts(const CadShape& shape, const std::vector<char>& used,
                               const CountWishes& wishes, const TinyFeatures& tiny, bool tie,
                               const std::vector<SplitStrip>& strips, int stride,
                               std::vector<int>& odd_faces) {
  const std::vector<double>& wanted = wishes.wanted;
  const std::vector<int>& least = wishes.least;
  const int n = static_cast<int>(wanted.size());
  TiedEdges tied(wanted);
  for (int i = 0; i < n; ++i) {
    if (tiny.edges[i] != i) tied.tie(tiny.edges[i], i, std::numeric_limits<double>::infinity());
  }
  // One node more at the base of a wedge or the end of a strip would make elements far shorter than they are
  // wide; the triangle that is left is cut up by the subdivision.
  std::vector<char> may_be_odd(shape.faces.size(), 0);
  if (tie) {
    const std::vector<char> is_wedge = tie_facing_sides(shape, used, wanted, tied);
    if (stride == 2) may_be_odd = is_wedge;
  }
  for (const SplitStrip& strip : strips) may_be_odd[strip.face] = stride == 2;
  struct Class {
    double wanted = 0;
    int members = 0, least = 0, count = 0;
  };
  std::vector<Class> classes(n);
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    Class& c = classes[tied.find(i)];
    c.wanted += wanted[i];
    ++c.members;
    c.least = std::max(c.least, least[i]);
  }
  std::vector<ParityEdge> parity(n);
  std::vector<char> odd(shape.faces.size(), 0);
  for (int i = 0; i < n; ++i) {
    Class& c = classes[i];
    parity[i].cost = std::numeric_limits<double>::infinity();
    if (c.members == 0) continue;
    c.wanted /= c.members;
    c.count = std::max(c.least, static_cast<int>(std::lround(c.wanted)));
    parity[i].cost = c.members * cost_of_change(c.count, c.wanted, c.least);
  }
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    const int c = tied.find(i);
    for (const int face : odd_uses(shape.edges[i], used)) {
      if (may_be_odd[face]) continue;
      auto& faces = parity[c].faces;
      const auto it = std::find(faces.begin(), faces.end(), face);
      if (it == faces.end()) {
        faces.push_back(face);
      } else {
        faces.erase(it);
      }
      if (classes[c].count % 2 != 0) odd[face] ^= 1;
    }
  }
  odd_faces.clear();
  const std::vector<char> change = make_even(parity, odd, odd_faces);
  std::vector<int> counts(n, 0);
  for (int i = 0; i < n; ++i) {
    if (least[i] == 0) continue;
    const int c = tied.find(i);
    counts[i] = classes[c].count;
    if (change[c]) counts[i] += change_of(classes[c].count, classes[c].wanted, classes[c].least);
  }
  const auto raise = [&](int edge, int by) {
    for (int i = 0; i < n; ++i) {
      if (counts[i] > 0 && tied.find(i) == tied.find(edge)) counts[i] += by;
    }
  };
  // A face that becomes odd by that keeps a triangle, which subdivision cuts up.
  for (const SplitStrip& strip : strips) {
    int more = -counts[strip.whole->edge - 1];
    int longest = strip.parts[0]->edge - 1;
    for (const Coedge* part : strip.parts) {
      more += counts[part->edge - 1];
      if (shape.edges[part->edge - 1].length > shape.edges[longest].length) longest = part->edge - 1;
    }
    if (more % 2 != 0 && stride == 1) continue;
    raise(more > 0 ? strip.whole->edge - 1 : longest, std::abs(more));
  }
  return counts;
}

}  // namespace quadrille
