/// Based on: Johnen, Remacle, Geuzaine, Geometrical validity of curvilinear finite elements (2013).

#include "mesher/mesh/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace quadrille {

namespace {

/// The sign of a bound below this is only rounding error, as where two sides lie on one curve.
constexpr double rounding = 1e-12;

/// A bicubic polynomial on the unit square: Bernstein coefficients, or values at 0, 1/3, 2/3, 1 in each
/// direction.
using Bicubic = Eigen::Matrix4d;

constexpr std::array<double, 4> corner_xi{-1, 1, 1, -1}, corner_eta{-1, -1, 1, 1};
constexpr std::array<double, 4> midside_xi{0, 1, 0, -1}, midside_eta{-1, 0, 1, 0};

/// Converts the values of a cubic at 0, 1/3, 2/3, 1 to its Bernstein coefficients.
const Eigen::Matrix4d to_bernstein =
    (Eigen::Matrix4d() << 6, 0, 0, 0, -5, 18, -9, 2, 2, -9, 18, -5, 0, 0, 0, 6).finished() / 6;

/// Convert the coefficients of a cubic to those of its first and its second half (de Casteljau).
const Eigen::Matrix4d first_half =
    (Eigen::Matrix4d() << 8, 0, 0, 0, 4, 4, 0, 0, 2, 4, 2, 0, 1, 3, 3, 1).finished() / 8;
const Eigen::Matrix4d second_half = first_half.reverse();

/// The least coefficient, sharpened until it is positive, or a corner value is not positive, or it is within
/// `tolerance` of a corner value. At most `depth` subdivisions.
double sharpened(const Bicubic& b, double tolerance, int depth) {
  const double bound = b.minCoeff();
  const double corner = std::min({b(0, 0), b(0, 3), b(3, 0), b(3, 3)});
  if (bound > 0 || corner <= 0 || corner - bound < tolerance || depth == 0) return bound;
  double result = corner;
  for (const Eigen::Matrix4d* half : {&first_half, &second_half}) {
    const Bicubic rows = *half * b;
    for (const Eigen::Matrix4d* part : {&first_half, &second_half})
      result = std::min(result, sharpened(rows * part->transpose(), tolerance, depth - 1));
  }
  return result;
}

/// The quad with straight sides between the corners.
struct StraightQuad {
  std::array<Vector3, 4> sides;
  Vector3 normal;     ///< unit; zero for a quad without area
  double mean = 0;    ///< mean Jacobian along the normal
  double least = -1;  ///< least Jacobian along the normal; it is linear, so the least is at a corner
  double turned = 0;  ///< largest component of the Jacobian perpendicular to the normal

  explicit StraightQuad(const std::array<Vector3, 4>& corners) {
    for (int k = 0; k < 4; ++k) sides[k] = corners[(k + 1) % 4] - corners[k];
    normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    const double length = normal.norm();
    if (!(length > 0)) return;
    normal /= length;
    mean = length / 8;
    least = std::numeric_limits<double>::max();
    for (int k = 0; k < 4; ++k) {
      const Vector3 jacobian = 0.25 * sides[(k + 3) % 4].cross(sides[k]);
      const double along = jacobian.dot(normal);
      least = std::min(least, along);
      turned = std::max(turned, (jacobian - along * normal).norm());
    }
  }
};

/// The offset of each midside node from the middle of its straight side.
std::array<Vector3, 4> bulges(const CurvedQuad& element) {
  std::array<Vector3, 4> result;
  for (int k = 0; k < 4; ++k)
    result[k] = element.midsides[k] - 0.5 * (element.corners[k] + element.corners[(k + 1) % 4]);
  return result;
}

/// The Bernstein coefficients of the Jacobian's component along a direction.
Bicubic along(const std::array<std::array<Vector3, 4>, 4>& values, const Vector3& direction) {
  Bicubic parts;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) parts(i, j) = values[i][j].dot(direction);
  return to_bernstein * parts * to_bernstein.transpose();
}

/// The mean Jacobian over the element, which equals the mean of its Bernstein coefficients.
Vector3 mean_jacobian(const std::array<std::array<Vector3, 4>, 4>& values) {
  constexpr std::array<double, 4> weights{1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8};  // at 0, 1/3, 2/3, 1
  Vector3 mean = Vector3::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) mean += weights[i] * weights[j] * values[i][j];
  }
  return mean;
}

}  // namespace

Vector3 area_vector(const CurvedQuad& element, double xi, double eta) {
  Vector3 along = Vector3::Zero(), across = Vector3::Zero();
  for (int k = 0; k < 4; ++k) {
    const double a = corner_xi[k], b = corner_eta[k];
    along += 0.25 * a * (1 + eta * b) * (2 * xi * a + eta * b) * element.corners[k];
    across += 0.25 * b * (1 + xi * a) * (2 * eta * b + xi * a) * element.corners[k];
    const double c = midside_xi[k], d = midside_eta[k];
    if (c == 0) {
      along += -xi * (1 + eta * d) * element.midsides[k];
      across += 0.5 * (1 - xi * xi) * d * element.midsides[k];
    } else {
      along += 0.5 * c * (1 - eta * eta) * element.midsides[k];
      across += -eta * (1 + xi * c) * element.midsides[k];
    }
  }
  return along.cross(across);
}

CurvedQuad curved_quad(const ShellMesh& mesh, std::size_t quad) {
  CurvedQuad element;
  for (int k = 0; k < 4; ++k) {
    element.corners[k] = mesh.points[mesh.quads[quad][k]];
    element.midsides[k] = mesh.points[mesh.midsides[quad][k]];
  }
  return element;
}

void straighten(CurvedQuad& element) {
  for (int k = 0; k < 4; ++k) element.midsides[k] = 0.5 * (element.corners[k] + element.corners[(k + 1) % 4]);
}

CurvedQuad straight_quad(const ShellMesh& mesh, std::size_t quad) {
  CurvedQuad element;
  for (int k = 0; k < 4; ++k) element.corners[k] = mesh.points[mesh.quads[quad][k]];
  straighten(element);
  return element;
}

double quick_jacobian_bound(const CurvedQuad& element) {
  const StraightQuad straight(element.corners);
  if (!(straight.mean > 0)) return -1;
  // `along` and `across` below bound the change of the map's derivatives by the bulges b. The lengths of
  // dx/dxi and dx/deta are at most half those of the straight sides.
  std::array<double, 4> inside{}, length{}, bulge{};  // bulge in the quad's plane, side, bulge in space
  const std::array<Vector3, 4> offsets = bulges(element);
  double largest = 0;
  for (int k = 0; k < 4; ++k) {
    const double out = offsets[k].dot(straight.normal);
    bulge[k] = offsets[k].norm();
    inside[k] = (offsets[k] - out * straight.normal).norm();
    length[k] = straight.sides[k].norm();
    largest = std::max(largest, bulge[k]);
  }
  if (largest == 0) return straight.least / straight.mean;
  const auto change = [&](const std::array<double, 4>& b) {
    const double along = 2 * std::max(b[0], b[2]) + 0.5 * (b[1] + b[3]),
                 across = 2 * std::max(b[1], b[3]) + 0.5 * (b[0] + b[2]);
    return 0.5 * std::max(length[0], length[2]) * across + 0.5 * std::max(length[1], length[3]) * along +
           along * across;
  };
  const double least = straight.least - change(inside), turned = straight.turned + change(bulge);
  // All Jacobians lie in a cone around the normal: two of them differ by at most twice its half angle.
  return turned < least ? (least - turned) / std::sqrt(2.0) / straight.mean : -1;
}

double jacobian_bound(const CurvedQuad& element) {
  const StraightQuad straight(element.corners);
  if (!(straight.mean > 0)) return -1;
  const auto is_zero = [](const Vector3& bulge) { return bulge.isZero(0); };
  const std::array<Vector3, 4> offsets = bulges(element);
  if (std::all_of(offsets.begin(), offsets.end(), is_zero)) return straight.least / straight.mean;
  std::array<std::array<Vector3, 4>, 4> values;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) values[i][j] = area_vector(element, 2.0 * j / 3 - 1, 2.0 * i / 3 - 1);
  }
  double bound = std::numeric_limits<double>::max();
  for (const Vector3& normal : {straight.normal, area_vector(element, 0, 0), mean_jacobian(values)}) {
    const double length = normal.norm();
    if (!(length > 0)) return -1;
    constexpr int max_depth = 5;
    bound = std::min(bound, sharpened(along(values, normal / length), 1e-3 * straight.mean, max_depth));
  }
  return bound / straight.mean;
}

bool folds(const CurvedQuad& element) {
  return !(quick_jacobian_bound(element) > rounding) && !(jacobian_bound(element) > rounding);
}

}  // namespace quadrille
