#pragma once
/// Grids that meet at one point inside three or five sides: which they are, and in which order they are made.
/// Internal.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace quadrille {

/// How three or five sides are filled around a point. A row leads from there to each side; `before` has the
/// number of segments from the first corner of the side to the row.
struct Spokes {
  std::array<int, 5> before{};
  int least = 0;  ///< least of `before`; below 1 if there is no such filling

  /// \param sides numbers of segments. An alternating sum over every second side gives twice `before`.
  explicit Spokes(std::span<const int> sides) {
    const int n = static_cast<int>(sides.size());
    for (int i = 0; i < n; ++i) {
      int sum = 0;
      for (int k = 0; k < n; ++k) sum += (k % 2 == 0 ? 1 : -1) * sides[(i + 2 * k) % n];
      before[i] = sum % 2 == 0 ? sum / 2 : 0;
    }
    least = *std::min_element(before.begin(), before.begin() + n);
  }

  int quads(std::span<const int> sides) const {
    int sum = 0;
    for (std::size_t i = 0, last = sides.size() - 1; i < sides.size(); last = i++)
      sum += before[i] * (sides[last] - before[last]);
    return sum;
  }
};

/// Fills three or five sides around a point. \param sides their points from corner to corner; each ends where
/// the next one begins \param middle makes the point between the feet of the rows \param row makes a row of
/// points from one to another, as a number of segments \param grid fills a loop of four sides
/// \return whether the numbers of segments allow it.
template <class Middle, class Row, class Grid>
bool fill_around_point(const std::vector<std::vector<int>>& sides, Middle&& middle, Row&& row, Grid&& grid) {
  using Line = std::vector<int>;
  const std::size_t n = sides.size();
  std::vector<int> lengths, feet;
  for (const Line& side : sides) lengths.push_back(static_cast<int>(side.size()) - 1);
  const Spokes spokes(lengths);
  if (spokes.least < 1) return false;
  for (std::size_t i = 0; i < n; ++i) feet.push_back(sides[i][spokes.before[i]]);
  const int center = middle(feet);
  std::vector<Line> rows;
  for (std::size_t i = 0; i < n; ++i) rows.push_back(row(feet[i], center, spokes.before[(i + 1) % n]));
  for (std::size_t i = 0, last = n - 1; i < n; last = i++) {
    grid(Line(sides[i].begin(), sides[i].begin() + spokes.before[i] + 1), rows[i],
         Line(rows[last].rbegin(), rows[last].rend()),
         Line(sides[last].begin() + spokes.before[last], sides[last].end()));
  }
  return true;
}

}  // namespace quadrille
