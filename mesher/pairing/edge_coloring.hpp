#pragma once
/// Colors for the edges of a triangulation, no two alike in a triangle: without the edges of one color, the
/// triangles become quads. Has the state on which all pairing works, and the steps of the paper's method.
/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018).

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/side_twins.hpp"

namespace quadrille {

/// Random numbers: small, fast and the same on all platforms (SplitMix64, Steele et al. 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, n), n small.
  int below(int n) { return static_cast<int>((next() >> 32) * static_cast<std::uint64_t>(n) >> 32); }

 private:
  std::uint64_t state_;
};

/// The color of each edge of a triangulation: 0, 1, 2, or blank. Color 0 is the one to remove: the two
/// triangles at such an edge are a pair and become a quad. A triangle without such an edge is free. 16 bytes
/// per triangle.
class EdgeColoring {
 public:
  static constexpr std::uint8_t blank = 3;
  static constexpr int removed = 0;

  /// All edges blank. Sides between triangles of different tags are boundary. Throws Error (failure) naming
  /// the triangle if indices are out of range or repeated, if more than two triangles of a tag share a side,
  /// or if two of them run along it the same way. Time and memory: linear.
  explicit EdgeColoring(const TriangleMesh& mesh, const ExecutionContext& context = {});

  int size() const { return static_cast<int>(cells_.size()) - 1; }  ///< triangles
  Side twin(Side side) const { return cell(triangle_of(side)).twin[index_of(side)]; }
  /// The sides on the boundary, one loop after the other, in order along each loop.
  std::vector<Side> boundary() const;

  int color(Side side) const {
    const Cell& c = cell(triangle_of(side));
    const int i = index_of(side);
    return c.at(0) == i ? 0 : c.at(1) == i ? 1 : c.at(2) == i ? 2 : blank;
  }

  /// Other sides of the two triangles that had the color become blank: the coloring stays proper.
  void set_color(Side side, int color) {
    paint(side, color);
    const Side other = twin(side);
    if (other >= 0) paint(other, color);
  }

  /// Colors blank sides of a triangle. \param colors two bits per side, the first side in the lowest; each is
  /// a color that neither triangle at the side has, or `blank` to leave the side as it is. No branches, since
  /// they would be unpredictable.
  void color_blanks(int triangle, int colors) {
    Cell& own = cell(triangle);
    for (int i = 0; i < 3; ++i) {
      const int color = colors >> 2 * i & 3;
      const Side twin = own.twin[i];
      own.places ^= place_of(color, i);
      cell(triangle_of(twin)).places ^= place_of(color, index_of(twin));
    }
  }

  /// The side of a triangle that has a color; -1 if none has.
  Side side_of(int triangle, int color) const {
    const int i = cell(triangle).at(color);
    return i == none ? -1 : make_side(triangle, i);
  }

  /// The side of a triangle that has no color, the first of several; -1 if all have.
  Side blank_side_of(int triangle) const {
    const int blanks = 7 & ~colored_sides(triangle);
    return blanks == 0 ? -1 : make_side(triangle, std::countr_zero(static_cast<unsigned>(blanks)));
  }

  /// Bit c set: a side of the triangle has the color c. 0 for triangle -1, which stands for the outside.
  int colors_used(int triangle) const { return used_at[cell(triangle).places]; }
  /// Bit i set: the side i of the triangle has a color.
  int colored_sides(int triangle) const { return colored_at[cell(triangle).places]; }

  /// The side of a triangle that has the removed color; -1 if none has.
  Side diagonal_of(int triangle) const { return side_of(triangle, removed); }
  bool free(int triangle) const { return cell(triangle).at(removed) == none; }
  /// The other triangle of the pair; -1 = free.
  int mate_of(int triangle) const {
    const Cell& c = cell(triangle);
    return c.at(removed) == none ? -1 : triangle_of(c.twin[c.at(removed)]);
  }
  /// Pairs the two triangles at an inner side; their former partners become free.
  void pair(Side side) { set_color(side, removed); }

  /// Exchanges two colors in one triangle: one step of an exchange along a chain.
  void swap_colors(int triangle, int a, int b) { cell(triangle).swap(a, b); }
  /// Exchanges two colors everywhere.
  void swap_colors(int a, int b) {
    for (Cell& c : cells_) c.swap(a, b);
  }

  /// Exchanges the colors a and b along the chain of edges of these colors that starts with a side and
  /// continues beyond it. The side's own triangle must lack the other color. The chain ends at the boundary,
  /// or at a triangle without the next color. \return the last side of the chain, seen from the triangle
  /// before it.
  Side swap_chain(Side start, int a, int b);

  /// The same for the chain that starts at a boundary edge and leads inward: exchanges the edge's color with
  /// another one. \return the last side of the chain, -1 if it has only the boundary edge.
  Side swap_boundary_chain(Side boundary, int with);

 private:
  static constexpr std::uint8_t none = 3;

  /// Stores where each color is rather than which color each side has. So a step along a chain takes two
  /// loads, and an exchange in a triangle one swap.
  struct Cell {
    Side twin[3]{-1, -1, -1};
    std::uint32_t places = 0b111111;  // two bits per color: index of its side, or none

    void clear(int color) { places |= static_cast<std::uint32_t>(none) << 2 * color; }
    int at(int color) const { return static_cast<int>(places >> 2 * color & 3); }
    void swap(int a, int b) {
      const std::uint32_t change = (places >> 2 * a ^ places >> 2 * b) & 3;
      places ^= change << 2 * a | change << 2 * b;
    }
  };

  /// Indexed by a cell's places: what colors_used() and colored_sides() return.
  using Table = std::array<std::uint8_t, 64>;
  static constexpr Table used_at = [] {
    Table table{};
    for (int p = 0; p < 64; ++p) {
      for (int c = 0; c < 3; ++c) table[p] |= (p >> 2 * c & 3) == none ? 0 : 1 << c;
    }
    return table;
  }();
  static constexpr Table colored_at = [] {
    Table table{};
    for (int p = 0; p < 64; ++p) {
      for (int c = 0; c < 3; ++c) table[p] |= 1 << (p >> 2 * c & 3) & 7;
    }
    return table;
  }();

  /// Indexed by side and a cell's places: the places after the side has lost its color.
  static constexpr std::array<Table, 3> without_at = [] {
    std::array<Table, 3> table{};
    for (int p = 0; p < 64; ++p) {
      for (int i = 0; i < 3; ++i) {
        table[i][p] = static_cast<std::uint8_t>(p);
        for (int c = 0; c < 3; ++c) table[i][p] |= (p >> 2 * c & 3) == i ? none << 2 * c : 0;
      }
    }
    return table;
  }();

  /// The bits of a cell's places that change when side i gets a color that no side has; none for `blank` or
  /// the side -1.
  static std::uint32_t place_of(int color, int i) {
    // Colors are 0 to 3. NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
    return static_cast<std::uint32_t>(none ^ i) << 2 * color & 0b111111;
  }

  /// The boundary side that starts where another ends.
  Side next_on_boundary(Side side) const;

  /// One triangle's part of set_color().
  void paint(Side side, int color) {
    Cell& c = cell(triangle_of(side));
    const int i = index_of(side), before = color == blank ? none : c.at(color);
    if (before != none && before != i) {
      if (c.twin[before] >= 0) cell(triangle_of(c.twin[before])).clear(color);
      c.clear(color);
    }
    c.places = without_at[i][c.places] ^ place_of(color, i);
  }

 protected:
  Cell& cell(int triangle) { return cells_[triangle + 1]; }
  const Cell& cell(int triangle) const { return cells_[triangle + 1]; }

  std::vector<Cell> cells_;  // the first stands for the outside, and never has a color
};

/// Gives each blank edge, in the order of the triangles, a random color of those that its triangles leave. An
/// edge for which they leave none stays blank. \return the number of blanks. Time: linear.
int color_greedily(EdgeColoring& coloring, Random& random);

/// Colors blank edges: exchanges two colors along chains that start at the edge's triangles, until these
/// leave a color. If that does not help, the blank moves along a chain. The coloring always stays proper.
/// \return the number of blanks left after many tries: 0 in practice.
int remove_blanks(EdgeColoring& coloring, Random& random);

/// How often each color occurs on the boundary, which is given as by EdgeColoring::boundary().
std::array<int, 3> count_boundary_colors(const EdgeColoring& coloring, const std::vector<Side>& boundary);

/// The color that occurs least on the boundary, the first one if several do.
int least_boundary_color(const EdgeColoring& coloring, const std::vector<Side>& boundary);

/// Takes a color off the boundary, two edges at a time, by exchange along the alternating paths between
/// them. \return the number of boundary edges that still have it; each has a triangle that will find no
/// partner.
int clear_boundary(EdgeColoring& coloring, const std::vector<Side>& boundary, int color, Random& random);

}  // namespace quadrille
