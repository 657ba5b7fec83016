#pragma once
/// Outlines of right-angled steps, laid out on the cells of a grid. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

/// A loop of points laid out in whole cells: each segment is one cell long, each corner a right angle. Based
/// on: White, Mingwu, Benzley & Sjaardema, Automated hexahedral mesh generation by virtual decomposition
/// (1995), for mapping a face with steps as a whole.
class StepLayout {
 public:
  using Line = std::vector<int>;

  /// \param sides points from corner to corner; the last point of each side is the first of the next one
  /// \param directions (sides) quarter turns from the first side; together, one full turn to the left
  /// \param points positions that determine the widths of columns and rows
  /// \return nothing if the sides do not close, or if they touch or cross each other. Time and memory: linear
  /// in the cells of the layout's bounding box. If these are more than 50 million, returns nothing.
  static std::optional<StepLayout> make(const std::vector<Line>& sides, const std::vector<int>& directions,
                                        const std::vector<Vector3>& points, SparseCheck& check);

  /// Spreads the points inside between those of the loop, by Laplace's equation. \param uv parameters of all
  /// points of the loop \return parameters of the points inside, by number, see inner()
  std::vector<Vector2> spread(const std::vector<Vector2>& uv, SparseCheck& check) const;

  /// Visits the cells with their corners, counter-clockwise. Points of the loop are >= 0, points inside < 0.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        if (cells_[cell(i, j)] != 0)
          visit(std::array<int, 4>{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  /// The number, from 0, of a point inside, which for_each_cell() gives as -2 or less.
  static int inner(int point) { return -2 - point; }

 private:
  static constexpr int outside = -1;  ///< marks grid points outside the loop

  bool walk(const std::vector<Line>& sides, const std::vector<int>& directions);
  bool find_cells();
  void measure(const std::vector<Vector3>& points);

  std::size_t cell(int i, int j) const { return static_cast<std::size_t>(j) * columns_ + i; }
  int& at(int i, int j) { return points_[static_cast<std::size_t>(j) * (columns_ + 1) + i]; }
  int at(int i, int j) const { return points_[static_cast<std::size_t>(j) * (columns_ + 1) + i]; }

  /// A segment of the loop: its start on the grid, its direction, and the points at its ends.
  struct Step {
    int i, j, direction, from, to;
  };

  std::vector<Step> steps_;
  int columns_ = 0, rows_ = 0, inner_count_ = 0;
  std::vector<int> points_;               ///< (rows + 1, columns + 1) the grid points of the bounding box
  std::vector<char> cells_;               ///< (rows, columns) 1 = the cell is inside the loop
  std::vector<double> widths_, heights_;  ///< mean widths of the columns, mean heights of the rows
};

}  // namespace quadrille
