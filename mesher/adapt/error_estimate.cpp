#include "mesher/adapt/error_estimate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace quadrille {

namespace {

using Values = Eigen::Matrix<double, 1, 12>;  // membrane, then bending
const double fold = std::cos(30 * M_PI / 180);
constexpr std::size_t fewest_quads = 3;  // of a patch
constexpr int cubic = 6;                 // terms up to the second degree

Values values_of(const ShellStress& stress) {
  Values values;
  values << stress.membrane.transpose(), stress.bending.transpose();
  return values;
}

Vector3 vector_area(const ShellMesh& mesh, int quad) {
  const auto& [a, b, c, d] = mesh.quads[quad];
  return 0.5 * (mesh.points[c] - mesh.points[a]).cross(mesh.points[d] - mesh.points[b]);
}

/// Polynomials fitted to the stresses about a corner.
class Patch {
 public:
  Patch(const Vector3& origin, const Vector3& normal, const std::vector<const ShellStress*>& samples)
      : origin_(origin) {
    x_ = normal.unitOrthogonal();
    y_ = normal.cross(x_);
    for (const ShellStress* sample : samples) scale_ = std::max(scale_, (sample->point - origin).norm());
    const int rows = static_cast<int>(samples.size());
    const int terms = rows >= 2 * cubic ? cubic : rows > 3 ? 3 : 1;
    Eigen::MatrixXd places(rows, terms), values(rows, 12);
    for (int i = 0; i < rows; ++i) {
      places.row(i) = basis(samples[i]->point).head(terms);
      values.row(i) = values_of(*samples[i]);
    }
    coefficients_.setZero(cubic, 12);
    coefficients_.topRows(terms) = places.colPivHouseholderQr().solve(values);
  }

  Values at(const Vector3& p) const { return basis(p) * coefficients_; }

 private:
  Eigen::Matrix<double, 1, cubic> basis(const Vector3& p) const {
    const double x = (p - origin_).dot(x_) / scale_, y = (p - origin_).dot(y_) / scale_;
    Eigen::Matrix<double, 1, cubic> row;
    row << 1, x, y, x * x, x * y, y * y;
    return row;
  }

  Vector3 origin_, x_, y_;
  double scale_ = 1e-300;
  Eigen::MatrixXd coefficients_;
};

class Recovery {
 public:
  Recovery(const ShellMesh& mesh, const std::vector<std::array<ShellStress, 4>>& stresses)
      : mesh_(mesh), stresses_(stresses), quads_at_(mesh.points.size()) {
    for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
      normals_.push_back(vector_area(mesh, static_cast<int>(quad)).normalized());
      for (const int node : mesh.quads[quad]) quads_at_[node].push_back(static_cast<int>(quad));
    }
  }

  /// The patch of a node on the side of its fold where a quad is.
  Patch patch(int node, int quad) const {
    std::set<int> quads;
    const auto take = [&](int from) {
      for (const int other : quads_at_[from]) {
        if (normals_[other].dot(normals_[quad]) > fold) quads.insert(other);
      }
    };
    take(node);
    // At the border, and at a fold, the next ones too.
    if (quads.size() < fewest_quads) {
      const std::set<int> first = quads;
      for (const int near : first) {
        for (const int corner : mesh_.quads[near]) take(corner);
      }
    }
    std::vector<const ShellStress*> samples;
    for (const int near : quads) {
      for (const ShellStress& stress : stresses_[near]) samples.push_back(&stress);
    }
    return {mesh_.points[node], normals_[quad], samples};
  }

 private:
  const ShellMesh& mesh_;
  const std::vector<std::array<ShellStress, 4>>& stresses_;
  std::vector<std::vector<int>> quads_at_;
  std::vector<Vector3> normals_;
};

}  // namespace

double ErrorEstimate::sum() const {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

double ErrorEstimate::relative() const {
  const double error = sum();
  return all + error > 0 ? std::sqrt(error / (all + error)) : 0;
}

ErrorEstimate estimate_error(const ShellMesh& mesh, const std::vector<std::array<ShellStress, 4>>& stresses,
                             double poisson) {
  const Recovery recovery(mesh, stresses);
  ErrorEstimate estimate;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    std::vector<Patch> patches;
    for (const int node : mesh.quads[quad]) patches.push_back(recovery.patch(node, static_cast<int>(quad)));
    double square = 0;
    for (int k = 0; k < 4; ++k) {
      const ShellStress& own = stresses[quad][k];
      const double near = 0.5 * (1 + 1 / std::sqrt(3.0)), far = 1 - near;
      Values recovered = Values::Zero();
      for (int j = 0; j < 4; ++j) {
        const int apart = std::abs(j - k);  // 0: its own corner, 2: the opposite one
        const double weight = apart == 0 ? near * near : apart == 2 ? far * far : near * far;
        recovered += weight * patches[j].at(own.point);
      }
      const Values off = recovered - values_of(own);
      square +=
          energy(off.head<6>().transpose(), off.tail<6>().transpose(), own.area, own.thickness, poisson);
      estimate.all += energy(own.membrane, own.bending, own.area, own.thickness, poisson);
    }
    estimate.squares.push_back(square);
  }
  return estimate;
}

std::vector<double> sizes_for(const ShellMesh& mesh, const ErrorEstimate& estimate, const AdaptGoal& goal) {
  const double order = mesh.order == 2 ? 2 : 1, dimension = 2;
  const double share = 1 / (2 * order + dimension);
  std::vector<double> sizes;
  double sum = 0;
  for (const double square : estimate.squares) sum += std::pow(std::max(square, 1e-300), dimension * share);
  const double wanted = goal.error * std::sqrt(estimate.all + estimate.sum());
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const double now = std::sqrt(vector_area(mesh, static_cast<int>(quad)).norm());
    // Where there is no error there is no bound.
    const double square =
        std::max(estimate.squares[quad], 1e-12 * estimate.sum() / static_cast<double>(mesh.quads.size()));
    double size = now * std::pow(square > 0 ? square : 1, -share) * std::pow(sum, -0.5 / order);
    if (goal.error > 0) size *= std::pow(wanted, 1 / order);
    sizes.push_back(size);
  }
  if (goal.count > 0) {
    const double factor = std::sqrt(count_for(mesh, sizes) / goal.count);
    for (double& size : sizes) size *= factor;
  }
  constexpr double most = 4;
  for (std::size_t quad = 0; quad < sizes.size(); ++quad) {
    const double now = std::sqrt(vector_area(mesh, static_cast<int>(quad)).norm());
    sizes[quad] = std::clamp(sizes[quad], now / most, now * most);
  }
  return sizes;
}

double count_for(const ShellMesh& mesh, const std::vector<double>& sizes) {
  double count = 0;
  for (std::size_t quad = 0; quad < sizes.size(); ++quad)
    count += vector_area(mesh, static_cast<int>(quad)).norm() / (sizes[quad] * sizes[quad]);
  return count;
}

}  // namespace quadrille
