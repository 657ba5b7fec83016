#pragma once
/// Colors for the edges of a triangulation, no two alike in a triangle: without the edges of one color, the
/// triangles are quads. The state that all of the pairing works on, and the pieces of the paper's method,
/// each on its own. Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018).

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/side_twins.hpp"

namespace quadrille {

/// Small, fast and the same everywhere (SplitMix64, Steele et al. 2014).
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

/// The color of each edge of a triangulation: 0, 1, 2, or blank. Color 0 is the one to be removed: the two
/// triangles at an edge of it are a pair and become a quad; a triangle without such an edge is free. 16 bytes
/// a triangle.
class EdgeColoring {
 public:
  static constexpr std::uint8_t blank = 3;
  static constexpr int removed = 0;

  /// All edges blank. Sides between triangles of different tags are boundary. Throws Error (failure) naming
  /// the triangle where indices are out of range or repeated, where more than two triangles of a tag share a
  /// side, or where two of them run along it the same way. Time and memory: linear.
  explicit EdgeColoring(const TriangleMesh& mesh, const ExecutionContext& context = {});

  int size() const { return static_cast<int>(cells_.size()) - 1; }  ///< triangles
  Side twin(Side side) const { return cell(triangle_of(side)).twin[index_of(side)]; }
  /// The sides on the boundary, one loop of it after the other, each along the loop.
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

  /// Gives the sides of a triangle colors that neither of their triangles has, two bits a side, the first in
  /// the lowest; sides that have a color or are to have none get `blank`. Without a branch: which sides are
  /// which is different in each triangle.
  void color_blanks(int triangle, int colors) {
    Cell& own = cell(triangle);
    for (int i = 0; i < 3; ++i) {
      const int color = colors >> 2 * i & 3;
      const Side twin = own.twin[i];
      own.places ^= place_of(color, i);
      cell(triangle_of(twin)).places ^= place_of(color, index_of(twin));
    }
  }

  /// Gives a side without a color one that neither of its triangles has.
  void color_blank(Side side, int color) {
    const Side other = twin(side);
    cell(triangle_of(side)).places ^= place_of(color, index_of(side));
    cell(triangle_of(other)).places ^= place_of(color, index_of(other));
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

  /// Bit c set: a side of the triangle has the color c. 0 for the triangle -1, which is beyond the boundary.
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
  /// Pairs the two triangles at an inner side; those that they were paired with become free.
  void pair(Side side) { set_color(side, removed); }

  /// Exchanges two colors in one triangle: a part of an exchange along a chain.
  void swap_colors(int triangle, int a, int b) { cell(triangle).swap(a, b); }
  /// Exchanges two colors everywhere.
  void swap_colors(int a, int b) {
    if (a == b) return;
    for (Cell& c : cells_) c.swap(a, b);
  }

  /// Exchanges the colors a and b along the chain of edges of these two that starts with a side, and goes on
  /// beyond it; the side's own triangle must lack the other of the two. The chain ends at the boundary, or
  /// before a triangle without the next color. \return the last side of the chain, seen from the triangle
  /// before it.
  Side swap_chain(Side start, int a, int b);

  /// The same for the chain that starts at a boundary edge and goes inwards: its color is exchanged with
  /// another one. \return the last side after the first, -1 if there is none.
  Side swap_boundary_chain(Side boundary, int with);

 private:
  static constexpr std::uint8_t none = 3;

  /// Where each color is rather than what color each side has: a step along a chain is then two loads, and
  /// an exchange in a triangle one swap.
  struct Cell {
    Side twin[3]{-1, -1, -1};
    std::uint32_t places = 0b111111;  // two bits a color: index of the side with it, or none

    void clear(int color) { places |= static_cast<std::uint32_t>(none) << 2 * color; }
    int at(int color) const { return static_cast<int>(places >> 2 * color & 3); }
    void swap(int a, int b) {
      const std::uint32_t change = (places >> 2 * a ^ places >> 2 * b) & 3;
      places ^= change << 2 * a | change << 2 * b;
    }
  };

  /// By a cell's places: what colors_used() and colored_sides() give.
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

  /// By a side and a cell's places: the places when the side has no color.
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

  /// What changes in a cell's places when a color that is at no side comes to the side i; nothing for
  /// `blank` and for the side -1.
  static std::uint32_t place_of(int color, int i) {
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

  std::vector<Cell> cells_;  // the first stands for what is beyond the boundary, and never has a color
};

/// What is wrong with a coloring, naming the triangle: neighbors that do not know each other, an edge to
/// which its two triangles give different colors. So no color comes twice in a triangle (blanks may). Empty
/// if nothing is.
std::string validate(const EdgeColoring& coloring);

/// The edges without a color.
int count_blanks(const EdgeColoring& coloring);

/// Gives each blank edge, in the order of the triangles, a random one of the colors that its triangles
/// leave, or leaves it blank. \return the number of blanks. Time: linear.
int color_greedily(EdgeColoring& coloring, Random& random);

/// Removes blanks by swapping colors with neighboring edges along chains of two colors, which moves the
/// blank until it meets the boundary or another blank, or until its two triangles leave a color. Each step
/// keeps the coloring proper. \return the number of blanks that were left after many tries: 0 in practice.
int remove_blanks(EdgeColoring& coloring, Random& random);

/// Completes a coloring that has the removed color only: the other two come in turns along the paths and
/// cycles that are left. An odd cycle keeps one blank. Time: linear.
void complete(EdgeColoring& coloring);

/// How often each color comes on the boundary, given as by EdgeColoring::boundary().
std::array<int, 3> count_boundary_colors(const EdgeColoring& coloring, const std::vector<Side>& boundary);

/// The color that is least on the boundary, the first of equals.
int least_boundary_color(const EdgeColoring& coloring, const std::vector<Side>& boundary);

/// Takes a color off the boundary, two edges at a time, by exchange along the alternating paths between
/// them. \return the number of boundary edges that still have it; each has a triangle that will find no
/// partner.
int clear_boundary(EdgeColoring& coloring, const std::vector<Side>& boundary, int color, Random& random);

}  // namespace quadrille
