/// Fits polynomials to the stresses around each corner node, apart on each side of a fold, and compares.

#include "mesher/adapt/error_estimate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

using Values = Eigen::Matrix<double, 1, 12>;  // membrane, then bending
const double fold = std::cos(30 * M_PI / 180);
constexpr std::size_t fewest_quads = 3;  // in a patch
constexpr int cubic = 6;                 // number of terms up to the second degree

Values values_of(const ShellStress& stress) {
  Values values;
  values << stress.membrane.transpose(), stress.bending.transpose();
  return values;
}

/// Polynomials fitted to the stresses around a corner node.
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
      : mesh_(mesh), stresses_(stresses), corners_(corners_by_node(mesh.points.size(), mesh.quads)) {
    for (const auto& quad : mesh.quads) normals_.push_back(quad_area_vector(mesh.points, quad).normalized());
  }

  /// The patch around a node. If the node lies on a fold, only quads on the side of `quad` belong to it.
  Patch patch(int node, int quad) const {
    std::set<int> quads;
    const auto take = [&](int from) {
      for (const Side corner : corners_[from]) {
        const int other = element_of(corner);
        if (normals_[other].dot(normals_[quad]) > fold) quads.insert(other);
      }
    };
    take(node);
    // At a boundary or a fold there are few quads: take their neighbors too.
    if (quads.size() < fewest_quads) {
      const std::vector<int> first(quads.begin(), quads.end());
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
  Rows<Side> corners_;  // at each node
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
        const int apart = std::abs(j - k);  // 0: corner nearest to the point, 2: the opposite one
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

std::vector<double> sizes_of(const ShellMesh& mesh) {
  std::vector<double> sizes;
  for (const auto& quad : mesh.quads) sizes.push_back(std::sqrt(quad_area_vector(mesh.points, quad).norm()));
  return sizes;
}

std::vector<double> even_sizes(const ShellMesh& mesh, const ErrorEstimate& estimate) {
  // In two dimensions the square of an element's error is proportional to this power of its size.
  const double power = 2 * mesh.order + 2;
  const std::vector<double> now = sizes_of(mesh);
  std::vector<double> errors(mesh.points.size(), 0), powers(mesh.points.size(), 0);
  double all = 0;
  for (std::size_t quad = 0; quad < mesh.quads.size(); ++quad) {
    const double own = std::pow(now[quad], power);
    all += own;
    for (const int node : mesh.quads[quad]) {
      errors[node] += estimate.squares[quad];
      powers[node] += own;
    }
  }
  // Without an error the size would be unbounded.
  constexpr double least_share = 1e-12;
  const double least = std::max(least_share * estimate.sum() / all, 1e-300);
  std::vector<double> sizes(mesh.points.size(), 0);
  for (std::size_t node = 0; node < sizes.size(); ++node) {
    if (powers[node] > 0) sizes[node] = std::pow(std::max(errors[node] / powers[node], least), -1 / power);
  }
  return sizes;
}

std::vector<char> singular_corners(const ShellMesh& mesh, const ErrorEstimate& estimate) {
  constexpr double much = 4;  // ratio of the mean squared errors per quad
  const Rows<Side> corners = corners_by_node(mesh.points.size(), mesh.quads);
  const auto add_quads_at = [&](std::size_t node, std::set<int>& quads) {
    for (const Side corner : corners[node]) quads.insert(element_of(corner));
  };
  const auto mean_of = [&](const std::set<int>& quads) {
    double sum = 0;
    for (const int quad : quads) sum += estimate.squares[quad];
    return sum / static_cast<double>(quads.size());
  };
  std::vector<char> singular(mesh.points.size(), 0);
  for (std::size_t node = 0; node < singular.size(); ++node) {
    std::set<int> own, round;
    add_quads_at(node, own);
    for (const int quad : own) {
      for (const int corner : mesh.quads[quad]) add_quads_at(corner, round);
    }
    for (const int quad : own) round.erase(quad);
    singular[node] = !own.empty() && !round.empty() && mean_of(own) > much * mean_of(round);
  }
  return singular;
}

}  // namespace quadrille
