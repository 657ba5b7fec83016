/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018), section 2; the
/// chains of two colors are Kempe's (1879), as in Vizing's proof (1964).

#include "mesher/pairing/edge_coloring.hpp"

#include <algorithm>
#include <bit>
#include <boost/dynamic_bitset.hpp>

namespace quadrille {

namespace {

/// Index of the lowest bit of a mask in 1 .. 7.
int lowest(int mask) {
  return std::countr_zero(static_cast<unsigned>(mask));
}

/// A random bit of a mask in 1 .. 7.
int pick(int mask, Random& random) {
  const int count = std::popcount(static_cast<unsigned>(mask));
  for (int skip = count == 1 ? 0 : random.below(count); skip > 0; --skip) mask &= mask - 1;
  return lowest(mask);
}

/// The colors that no triangle of an edge has.
int available(const EdgeColoring& coloring, Side side) {
  const Side twin = coloring.twin(side);
  return 7 & ~(coloring.colors_used(triangle_of(side)) | coloring.colors_used(triangle_of(twin)));
}

/// Colors one blank edge, if its triangles leave a color or can be made to.
class BlankRemover {
 public:
  BlankRemover(EdgeColoring& coloring, Random& random) : coloring_(coloring), random_(random) {}

  bool remove(Side side) {
    if (fill(side)) return true;
    for (int tries = 0; tries < max_tries; ++tries) {
      // Two triangles that leave no color: either one has a single color and the other the other two, or each
      // has one color of its own and both have one in common.
      const int one = triangle_of(side), two = triangle_of(coloring_.twin(side));
      const int of_one = coloring_.colors_used(one), of_two = coloring_.colors_used(two);
      if (lone(of_one) || lone(of_two)) {
        if (swap_lone(side)) return true;
        continue;
      }
      const int own = lowest(of_one & ~of_two), other = lowest(of_two & ~of_one),
                common = lowest(of_one & of_two);
      // The chains of the two colors that are not common: unless they lead from one triangle to the other, an
      // exchange along one of them makes both triangles leave the same color.
      const Side start_one = coloring_.side_of(one, own), start_two = coloring_.side_of(two, other);
      const int winner = race({start_one, other, own}, {start_two, own, other});
      if (winner != met) {
        for (int t : winner == first ? passed_one_ : passed_two_) coloring_.swap_colors(t, own, other);
        return fill(side);
      }
      // They do. Exchange along a chain of the common color; every fourth time, move the blank instead.
      if (tries % 4 == 3) {
        side = shift(start_one, own, other);
        continue;
      }
      const Chain from_one{coloring_.side_of(one, common), other, common},
          from_two{coloring_.side_of(two, common), own, common};
      const bool take_one = tries == 0 ? race(from_one, from_two) == first : random_.below(2) == 0;
      const Chain& chain = take_one ? from_one : from_two;
      coloring_.swap_chain(chain.side, common, chain.next_color);
    }
    return false;
  }

 private:
  static constexpr int max_tries = 200;
  enum Winner { first, second, met };

  /// A place on a chain: a side, the next color, and the one after that (the side's own).
  struct Chain {
    Side side;
    int next_color, color;
  };

  /// Advances along the chain. \param passed out: the triangles passed. \return false at the chain's end.
  bool advance(Chain& chain, std::vector<int>& passed) const {
    const Side across = coloring_.twin(chain.side);
    if (across < 0) return false;
    passed.push_back(triangle_of(across));
    const Side next = coloring_.side_of(triangle_of(across), chain.next_color);
    if (next < 0) return false;
    chain = {next, chain.color, chain.next_color};
    return true;
  }

  /// Follows two chains in turns. The shorter one wins; if they are the two ends of one chain, they meet.
  Winner race(Chain one, Chain two) {
    passed_one_.assign(1, triangle_of(one.side));
    passed_two_.assign(1, triangle_of(two.side));
    for (;;) {
      if (coloring_.twin(one.side) == two.side) return met;
      if (!advance(one, passed_one_)) return first;
      if (coloring_.twin(one.side) == two.side) return met;
      if (!advance(two, passed_two_)) return second;
    }
  }

  static bool lone(int mask) { return (mask & (mask - 1)) == 0; }

  bool fill(Side side) {
    const int colors = available(coloring_, side);
    if (colors == 0) return false;
    coloring_.set_color(side, pick(colors, random_));
    return true;
  }

  /// Shifts the colors of the first few edges of a chain that leads from one triangle of the blank edge to
  /// the other, each to the edge before. \return the edge that is blank then.
  Side shift(Side side, int a, int b) {
    Side blank = coloring_.blank_side_of(triangle_of(side));
    for (int steps = 1 + random_.below(16); steps > 0 && side >= 0; --steps) {
      const int color = coloring_.color(side);
      coloring_.set_color(blank, color);
      coloring_.set_color(side, EdgeColoring::blank);
      blank = side;
      const Side across = coloring_.twin(side);
      side = coloring_.side_of(triangle_of(across), color == a ? b : a);
    }
    return blank;
  }

  /// For a triangle with a single color, the only one that the other triangle leaves: exchanges that color.
  bool swap_lone(Side side) {
    int t = triangle_of(side);
    if (!lone(coloring_.colors_used(t))) t = triangle_of(coloring_.twin(side));
    const int color = lowest(coloring_.colors_used(t));
    const int wanted = (color + 1 + random_.below(2)) % 3;
    coloring_.swap_chain(coloring_.side_of(t, color), color, wanted);
    return fill(side);
  }

  EdgeColoring& coloring_;
  Random& random_;
  std::vector<int> passed_one_, passed_two_;  // in a race: an exchange needs no second search
};

}  // namespace

EdgeColoring::EdgeColoring(const TriangleMesh& mesh, const ExecutionContext& context) {
  check_indices(mesh);
  context.check();
  cells_.resize(mesh.triangles.size() + 1);
  SparseCheck check(context);
  join_twins(mesh, [&](Side a, Side b) {
    check();
    cell(triangle_of(a)).twin[index_of(a)] = b;
    cell(triangle_of(b)).twin[index_of(b)] = a;
  });
}

std::vector<Side> EdgeColoring::boundary() const {
  std::vector<Side> sides;
  boost::dynamic_bitset<> done(4 * cells_.size());
  for (int t = 0; t < size(); ++t) {
    const auto& twins = cell(t).twin;
    if (twins[0] >= 0 && twins[1] >= 0 && twins[2] >= 0) continue;
    for (int i = 0; i < 3; ++i) {
      if (twins[i] >= 0) continue;
      for (Side side = make_side(t, i); !done.test_set(side); side = next_on_boundary(side))
        sides.push_back(side);
    }
  }
  return sides;
}

Side EdgeColoring::next_on_boundary(Side side) const {
  for (;;) {
    side = make_side(triangle_of(side), next_index(index_of(side)));
    if (twin(side) < 0) return side;
    side = twin(side);
  }
}

Side EdgeColoring::swap_chain(Side start, int a, int b) {
  int then = color(start) == a ? b : a;
  cell(triangle_of(start)).swap(a, b);
  for (Side side = start;;) {
    const Side across = twin(side);
    if (across < 0) return side;
    const int t = triangle_of(across);
    const int next = cell(t).at(then);
    cell(t).swap(a, b);
    if (next == none) return side;
    side = make_side(t, next);
    then = a + b - then;
  }
}

Side EdgeColoring::swap_boundary_chain(Side boundary, int with) {
  const int from = color(boundary);
  const Side next = side_of(triangle_of(boundary), with);
  if (next < 0) {
    set_color(boundary, with);
    return -1;
  }
  return swap_chain(next, from, with);
}

namespace {

/// The ways to color the three sides of a triangle, no two alike, from the colors that each may have (three
/// bits per side), that leave the fewest sides blank. Two bits per side, the first side in the lowest.
struct Choices {
  std::uint8_t count = 0;
  std::array<std::uint8_t, 6> ways{};
};

constexpr std::array<Choices, 512> list_choices() {
  std::array<Choices, 512> table{};
  for (int masks = 0; masks < 512; ++masks) {
    Choices& choices = table[masks];
    int most = 0;
    for (int way = 0; way < 64; ++way) {
      int used = 0, colored = 0;
      bool possible = true;
      for (int i = 0; i < 3; ++i) {
        const int color = way >> 2 * i & 3;
        if (color == EdgeColoring::blank) continue;
        possible = possible && (masks >> 3 * i & ~used & 1 << color) != 0;
        used |= 1 << color;
        ++colored;
      }
      if (!possible || colored < most) continue;
      if (colored > most) choices.count = 0;
      most = colored;
      choices.ways[choices.count++] = static_cast<std::uint8_t>(way);
    }
  }
  return table;
}

}  // namespace

int color_greedily(EdgeColoring& coloring, Random& random) {
  static constexpr std::array<Choices, 512> table = list_choices();
  int blanks = 0;
  for (int t = 0; t < coloring.size(); ++t) {
    // No branches: the state of the neighbors is unpredictable, and a misprediction costs more than all else.
    const int left = 7 & ~coloring.colors_used(t), colored = coloring.colored_sides(t);
    int masks = 0, later = 0;
    for (int i = 0; i < 3; ++i) {
      const Side twin = coloring.twin(make_side(t, i));
      const int mask = left & ~coloring.colors_used(triangle_of(twin)) & ((colored >> i & 1) - 1);
      masks |= mask << 3 * i;
      later |= (static_cast<std::uint32_t>(twin) > static_cast<std::uint32_t>(make_side(t, i))) << i;
    }
    const Choices& choices = table[masks];
    coloring.color_blanks(t, choices.ways[random.below(choices.count)]);
    // Blanks shared with lower triangles were counted there, and still find no color.
    blanks += std::popcount(static_cast<unsigned>(later & ~coloring.colored_sides(t)));
  }
  return blanks;
}

int remove_blanks(EdgeColoring& coloring, Random& random) {
  BlankRemover remover(coloring, random);
  int left = 0;
  for (int t = 0; t < coloring.size(); ++t) {
    if (coloring.colors_used(t) == 7) continue;
    for (int i = 0; i < 3; ++i) {
      const Side side = make_side(t, i), twin = coloring.twin(side);
      // Sides shared with a lower triangle were tried there.
      if ((twin >= 0 && twin < side) || coloring.color(side) != EdgeColoring::blank) continue;
      if (!remover.remove(side)) ++left;
    }
  }
  return left;
}

std::array<int, 3> count_boundary_colors(const EdgeColoring& coloring, const std::vector<Side>& boundary) {
  std::array<int, 4> counts{};
  for (Side side : boundary) ++counts[coloring.color(side)];
  return {counts[0], counts[1], counts[2]};
}

int least_boundary_color(const EdgeColoring& coloring, const std::vector<Side>& boundary) {
  const std::array<int, 3> counts = count_boundary_colors(coloring, boundary);
  return static_cast<int>(std::min_element(counts.begin(), counts.end()) - counts.begin());
}

int clear_boundary(EdgeColoring& coloring, const std::vector<Side>& boundary, int color, Random& random) {
  std::vector<Side> sides;
  for (Side side : boundary) {
    if (coloring.color(side) == color) sides.push_back(side);
  }
  constexpr int max_tries = 6;
  for (Side at : sides) {
    const int first = random.below(2);
    for (int tries = 0; at >= 0 && coloring.color(at) == color && tries < max_tries; ++tries) {
      // A path that ends at a boundary edge of the other color gives that edge ours. Continue there.
      const Side end = coloring.swap_boundary_chain(at, (color + 1 + (first + tries) % 2) % 3);
      at = end >= 0 && coloring.twin(end) < 0 ? end : -1;
    }
  }
  return count_boundary_colors(coloring, boundary)[color];
}

}  // namespace quadrille
