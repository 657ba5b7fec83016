#pragma once
/// Outlines of right-angled steps as cells of a grid. Internal.

#include <array>
#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

/// A loop of points laid out in whole cells: each segment is one cell wide, each corner a right angle. Based
/// on: White, Mingwu, Benzley & Sjaardema, Automated hexahedral mesh generation by virtual decomposition
/// (1995), for mapping a face with steps as a whole.
class StepLayout {
 public:
  using Line = std::vector<int>;

  /// \param sides points from corner to corner, the last of each the first of the next
  /// \param directions (sides) quarters of a turn from the first one; a full turn to the left in all
  /// \param points of which the widths of columns and rows are taken
  /// \return nothing where the sides do not close, or where they touch or cross each other. Time and memory:
  /// linear in the cells of the layout's bounding box, of which there may be 50 million.
  static std::optional<StepLayout> make(const std::vector<Line>& sides, const std::vector<int>& directions,
                                        const std::vector<Vector3>& points, SparseCheck& check);

  /// The points inside, spread between those of the loop: solutions of Laplace's equation.
  /// \param uv of all points \return by number, which see inner()
  std::vector<Vector2> spread(const std::vector<Vector2>& uv, SparseCheck& check) const;

  /// The cells, counter-clockwise: a point of the loop from 0, or one inside, below 0.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        if (cells_[cell(i, j)] != 0)
          visit(std::array<int, 4>{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  /// The number of a point inside, from 0.
  static int inner(int point) { return -2 - point; }

 private:
  static constexpr int outside = -1;  ///< of points, which are -2 and less inside

  bool walk(const std::vector<Line>& sides, const std::vector<int>& directions);
  bool find_cells();
  void measure(const std::vector<Vector3>& points);

  std::size_t cell(int i, int j) const { return static_cast<std::size_t>(j) * columns_ + i; }
  int& at(int i, int j) { return points_[static_cast<std::size_t>(j) * (columns_ + 1) + i]; }
  int at(int i, int j) const { return points_[static_cast<std::size_t>(j) * (columns_ + 1) + i]; }

  /// A segment of the loop: from a place in its direction.
  struct Step {
    int i, j, direction, from, to;
  };

  std::vector<Step> steps_;
  int columns_ = 0, rows_ = 0, inner_count_ = 0;
  std::vector<int> points_;               ///< of the bounding box's grid
  std::vector<char> cells_;               ///< of that grid: 1 = inside
  std::vector<double> widths_, heights_;  ///< of the columns and rows, in the mean
};

}  // namespace quadrille
