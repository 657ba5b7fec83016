/// Walks the outline in whole cells, fills the cells inside row by row, and solves for their points.

#include "mesher/faces/step_layout.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace quadrille {

std::optional<StepLayout> StepLayout::make(const std::vector<Line>& sides, const std::vector<int>& directions,
                                           const std::vector<Vector3>& points, SparseCheck& check) {
  StepLayout layout;
  if (sides.empty() || sides.size() != directions.size() || !layout.walk(sides, directions))
    return std::nullopt;
  check();
  if (!layout.find_cells()) return std::nullopt;
  check();
  layout.measure(points);
  return layout;
}

/// Lays out the loop. False if it does not close, visits a place twice, or has no or too many cells.
bool StepLayout::walk(const std::vector<Line>& sides, const std::vector<int>& directions) {
  int i = 0, j = 0;
  std::array<int, 2> low{}, high{};
  for (std::size_t k = 0; k < sides.size(); ++k) {
    for (std::size_t n = 0; n + 1 < sides[k].size(); ++n) {
      const int d = directions[k];
      steps_.push_back({i, j, d, sides[k][n], sides[k][n + 1]});
      (d % 2 == 0 ? i : j) += d < 2 ? 1 : -1;
      low = {std::min(low[0], i), std::min(low[1], j)};
      high = {std::max(high[0], i), std::max(high[1], j)};
    }
  }
  if (i != 0 || j != 0) return false;
  columns_ = high[0] - low[0];
  rows_ = high[1] - low[1];
  constexpr double most_cells = 5e7;
  if (columns_ == 0 || rows_ == 0 || 1.0 * columns_ * rows_ > most_cells) return false;
  points_.assign(static_cast<std::size_t>(columns_ + 1) * (rows_ + 1), outside);
  for (Step& step : steps_) {
    step.i -= low[0];
    step.j -= low[1];
    if (at(step.i, step.j) != outside) return false;
    at(step.i, step.j) = step.from;
  }
  return true;
}

/// Finds the cells inside the loop and numbers their points. The inside is on the loop's left: in each row,
/// cells lie between a step down and the next step up. These alternate in a loop that does not touch itself,
/// and a step down comes first unless the loop runs clockwise, which gives false.
bool StepLayout::find_cells() {
  cells_.assign(static_cast<std::size_t>(columns_) * rows_, 0);
  std::vector<signed char> walls(static_cast<std::size_t>(columns_ + 1) * rows_, 0);
  for (const Step& step : steps_) {
    const int row = step.direction == 1 ? step.j : step.j - 1;
    if (step.direction % 2 != 0)
      walls[static_cast<std::size_t>(row) * (columns_ + 1) + step.i] = step.direction == 3 ? 1 : -1;
  }
  for (int j = 0; j < rows_; ++j) {
    int inside = 0;
    for (int i = 0; i < columns_; ++i) {
      inside += walls[static_cast<std::size_t>(j) * (columns_ + 1) + i];
      if (inside != 0 && inside != 1) return false;
      cells_[cell(i, j)] = static_cast<char>(inside);
    }
  }
  for (int j = 0; j < rows_; ++j) {
    for (int i = 0; i < columns_; ++i) {
      if (cells_[cell(i, j)] == 0) continue;
      for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        int& point = at(i + di, j + dj);
        if (point == outside) point = -2 - inner_count_++;
      }
    }
  }
  return true;
}

void StepLayout::measure(const std::vector<Vector3>& points) {
  std::array<std::vector<int>, 2> counts{std::vector<int>(columns_, 0), std::vector<int>(rows_, 0)};
  widths_.assign(columns_, 0);
  heights_.assign(rows_, 0);
  for (const Step& step : steps_) {
    const bool along = step.direction % 2 == 0;
    const int band = (along ? step.i : step.j) - (step.direction < 2 ? 0 : 1);
    (along ? widths_ : heights_)[band] += (points[step.to] - points[step.from]).norm();
    ++counts[along ? 0 : 1][band];
  }
  constexpr double smallest_positive = std::numeric_limits<double>::min();
  for (int i = 0; i < columns_; ++i) widths_[i] = std::max(widths_[i] / counts[0][i], smallest_positive);
  for (int j = 0; j < rows_; ++j) heights_[j] = std::max(heights_[j] / counts[1][j], smallest_positive);
}

std::vector<Vector2> StepLayout::spread(const std::vector<Vector2>& uv, SparseCheck& check) const {
  if (inner_count_ == 0) return {};
  std::vector<Eigen::Triplet<double>> terms;
  terms.reserve(5 * static_cast<std::size_t>(inner_count_));
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(inner_count_, 2);
  for (int j = 1; j < rows_; ++j) {
    for (int i = 1; i < columns_; ++i) {
      if (at(i, j) >= outside) continue;
      check();
      const int row = inner(at(i, j));
      const double width = 0.5 * (widths_[i - 1] + widths_[i]),
                   height = 0.5 * (heights_[j - 1] + heights_[j]);
      double sum = 0;
      const auto add = [&](int neighbor, double weight) {
        sum += weight;
        if (neighbor >= 0) {
          right.row(row) += weight * uv[neighbor].transpose();
        } else {
          terms.emplace_back(row, inner(neighbor), -weight);
        }
      };
      add(at(i - 1, j), height / widths_[i - 1]);
      add(at(i + 1, j), height / widths_[i]);
      add(at(i, j - 1), width / heights_[j - 1]);
      add(at(i, j + 1), width / heights_[j]);
      terms.emplace_back(row, row, sum);
    }
  }
  Eigen::SparseMatrix<double> matrix(inner_count_, inner_count_);
  matrix.setFromTriplets(terms.begin(), terms.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  check();
  const Eigen::MatrixX2d solution = solver.solve(right);
  std::vector<Vector2> result(inner_count_);
  for (int k = 0; k < inner_count_; ++k) result[k] = solution.row(k);
  return result;
}

}  // namespace quadrille
