/// Takes strains from the solver's 8- or 20-node bricks and splits stresses into membrane and bending parts.

#include "mesher/adapt/shell_stress.hpp"

#include <Eigen/LU>
#include <cmath>

#include <fmt/format.h>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// Local coordinates of a brick's nodes in the order of the .frd format: corners of the bottom and the top,
/// then midside nodes of the bottom, of the upright sides, and of the top.
constexpr double places[20][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1},
                                  {1, -1, 1},   {1, 1, 1},   {-1, 1, 1},  {0, -1, -1}, {1, 0, -1},
                                  {0, 1, -1},   {-1, 0, -1}, {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},
                                  {-1, 1, 0},   {0, -1, 1},  {1, 0, 1},   {0, 1, 1},   {-1, 0, 1}};

/// The shape function of a node: trilinear for 8 nodes, serendipity for 20.
double shape(const Vector3& at, int node, int nodes) {
  double product = 1, sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double here = at[k] * places[node][k];
    product *= places[node][k] == 0 ? 1 - at[k] * at[k] : 1 + here;
    sum += here;
  }
  if (nodes == 8) return product / 8;
  return node < 8 ? product * (sum - 2) / 8 : product / 4;
}

/// A brick element of CalculiX.
class Brick {
 public:
  Brick(const SolverResult& result, const SolverResult::Element& element)
      : result_(result), nodes_(element.nodes), n_(static_cast<int>(nodes_.size())) {}

  /// The point halfway between corner k at the bottom and at the top.
  Vector3 corner(int k) const { return 0.5 * (result_.points[nodes_[k]] + result_.points[nodes_[k + 4]]); }

  /// Derivatives of position and of displacement with respect to the three local coordinates.
  struct Derivatives {
    Eigen::Matrix3d place = Eigen::Matrix3d::Zero(), moved = Eigen::Matrix3d::Zero();
  };
  Derivatives derivatives(const Vector3& at) const {
    Derivatives result;
    for (int k = 0; k < 3; ++k) {
      // Central differences are exact: along each coordinate the functions are quadratic.
      constexpr double h = 0.5;
      const Vector3 step = h * Vector3::Unit(k);
      for (int i = 0; i < n_; ++i) {
        const double slope = (shape(at + step, i, n_) - shape(at - step, i, n_)) / (2 * h);
        result.place.col(k) += slope * result_.points[nodes_[i]];
        result.moved.col(k) += slope * result_.displacements[nodes_[i]];
      }
    }
    return result;
  }

  Vector3 point(const Vector3& at) const {
    Vector3 p = Vector3::Zero();
    for (int i = 0; i < n_; ++i) p += shape(at, i, n_) * result_.points[nodes_[i]];
    return p;
  }

  /// The stress at a point, plane in the layer there.
  Tensor stress(const Vector3& at, double poisson) const {
    const auto [place, moved] = derivatives(at);
    const Eigen::Matrix3d gradient = moved * place.inverse();
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const Vector3 normal = place.col(0).cross(place.col(1)).normalized();
    const Vector3 a = place.col(0).normalized(), b = normal.cross(a);
    const double aa = a.dot(strain * a), bb = b.dot(strain * b), ab = a.dot(strain * b);
    const double factor = 1 / (1 - poisson * poisson);
    const Eigen::Matrix3d stress = factor * (aa + poisson * bb) * a * a.transpose() +
                                   factor * (bb + poisson * aa) * b * b.transpose() +
                                   ab / (1 + poisson) * (a * b.transpose() + b * a.transpose());
    Tensor result;
    result << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0);
    return result;
  }

 private:
  const SolverResult& result_;
  const std::vector<int>& nodes_;
  int n_;
};

/// Whether a brick lies at a quad, whichever corner comes first. The tolerance allows for section offsets.
bool belongs(const ShellMesh& mesh, int quad, const Brick& brick) {
  Vector3 apart = Vector3::Zero();  // of the centers
  for (int k = 0; k < 4; ++k) apart += (brick.corner(k) - mesh.points[mesh.quads[quad][k]]) / 4;
  const double side = (mesh.points[mesh.quads[quad][2]] - mesh.points[mesh.quads[quad][0]]).norm();
  const Eigen::Matrix3d place = brick.derivatives(Vector3::Zero()).place;
  constexpr double share = 0.1;
  return apart.norm() <= share * side + 1.1 * place.col(2).norm();
}

ShellStress stress_at(const Brick& brick, double x, double y, double poisson) {
  const double layer = 1 / std::sqrt(3.0);  // where bricks are most accurate
  const Tensor low = brick.stress({x, y, -layer}, poisson), high = brick.stress({x, y, layer}, poisson);
  const Eigen::Matrix3d place = brick.derivatives({x, y, 0}).place;
  const Vector3 normal = place.col(0).cross(place.col(1));
  return {brick.point({x, y, 0}), normal.norm(), 2 * std::abs(place.col(2).dot(normal.normalized())),
          0.5 * (low + high), 0.5 / layer * (high - low)};
}

/// Stresses near the corners of the quad, in its corner order and for its normal. The brick may have the
/// opposite orientation, since solvers may need that.
std::array<ShellStress, 4> stresses_of(const ShellMesh& mesh, int quad, const Brick& brick, double poisson) {
  const auto& corners = mesh.quads[quad];
  const Vector3 normal = (mesh.points[corners[2]] - mesh.points[corners[0]])
                             .cross(mesh.points[corners[3]] - mesh.points[corners[1]]);
  const Eigen::Matrix3d place = brick.derivatives(Vector3::Zero()).place;
  const double side = place.col(0).cross(place.col(1)).dot(normal) < 0 ? -1 : 1;
  std::array<ShellStress, 4> stresses;
  for (int k = 0; k < 4; ++k) {
    int nearest = 0;
    for (int j = 1; j < 4; ++j) {
      const Vector3& corner = mesh.points[corners[k]];
      if ((brick.corner(j) - corner).norm() < (brick.corner(nearest) - corner).norm()) nearest = j;
    }
    const double at = 1 / std::sqrt(3.0);
    stresses[k] = stress_at(brick, at * places[nearest][0], at * places[nearest][1], poisson);
    stresses[k].bending *= side;
  }
  return stresses;
}

}  // namespace

double energy(const Tensor& membrane, const Tensor& bending, double area, double thickness, double poisson) {
  const auto density = [&](const Tensor& s) {
    const double trace = s[0] + s[1] + s[2];
    const double squares = s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm();
    return (1 + poisson) * squares - poisson * trace * trace;
  };
  return area * thickness * (density(membrane) + density(bending) / 3);
}

std::vector<std::array<ShellStress, 4>> shell_stresses(const ShellMesh& mesh, const SolverResult& result,
                                                       double poisson, const std::string& name) {
  std::vector<const SolverResult::Element*> bricks;
  for (const SolverResult::Element& element : result.elements) {
    const bool fits = (element.type == SolverResult::Element::eight_nodes && element.nodes.size() == 8) ||
                      (element.type == SolverResult::Element::twenty_nodes && element.nodes.size() == 20);
    if (!fits)
      throw failure(name, fmt::format("{}: element {} is not a solid element of 8 or 20 nodes: request the "
                                      "results with *NODE FILE, OUTPUT=3D",
                                      name, element.number));
    bricks.push_back(&element);
  }
  if (bricks.size() != mesh.quads.size())
    throw failure(name, fmt::format("{} does not fit the mesh: it has {} elements, the mesh {}", name,
                                    bricks.size(), mesh.quads.size()));
  std::vector<std::array<ShellStress, 4>> stresses(bricks.size());
  for (std::size_t quad = 0; quad < bricks.size(); ++quad) {
    const Brick brick(result, *bricks[quad]);
    if (!belongs(mesh, static_cast<int>(quad), brick))
      throw failure(name, fmt::format("{} does not fit the mesh: its element {} lies elsewhere than quad {}",
                                      name, bricks[quad]->number, quad + 1));
    stresses[quad] = stresses_of(mesh, static_cast<int>(quad), brick, poisson);
  }
  return stresses;
}

}  // namespace quadrille
