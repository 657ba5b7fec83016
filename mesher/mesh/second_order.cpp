/// Based on: Johnen, Remacle, Geuzaine, Geometrical validity of curvilinear finite elements (2013).

#include "mesher/mesh/second_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrille {

namespace {

/// A bound below this has no sign but that of rounding errors: where two sides are one curve.
constexpr double rounding = 1e-12;

/// 4 x 4 values or Bernstein coefficients of a bicubic polynomial on the unit square.
using Bicubic = std::array<std::array<double, 4>, 4>;
using Cubic = std::array<double, 4>;

constexpr std::array<double, 4> corner_xi{-1, 1, 1, -1}, corner_eta{-1, -1, 1, 1};
constexpr std::array<double, 4> midside_xi{0, 1, 0, -1}, midside_eta{-1, 0, 1, 0};

/// (dx/dxi) x (dx/deta) at a point of the reference square [-1, 1]^2.
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

/// Values at 0, 1/3, 2/3, 1 into Bernstein coefficients.
Cubic to_bernstein(const Cubic& f) {
  return {f[0], (-5 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 6,
          (2 * f[0] - 9 * f[1] + 18 * f[2] - 5 * f[3]) / 6, f[3]};
}

/// De Casteljau at the middle.
void halve(const Cubic& b, Cubic& low, Cubic& high) {
  const double ab = 0.5 * (b[0] + b[1]), bc = 0.5 * (b[1] + b[2]), cd = 0.5 * (b[2] + b[3]);
  const double abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), middle = 0.5 * (abc + bcd);
  low = {b[0], ab, abc, middle};
  high = {middle, bcd, cd, b[3]};
}

template <class Map>
Bicubic map_columns(const Bicubic& b, Map&& map) {
  Bicubic result{};
  for (int j = 0; j < 4; ++j) {
    const Cubic column = map(Cubic{b[0][j], b[1][j], b[2][j], b[3][j]});
    for (int i = 0; i < 4; ++i) result[i][j] = column[i];
  }
  return result;
}

double least(const Bicubic& b) {
  double result = b[0][0];
  for (const Cubic& row : b) result = std::min(result, *std::min_element(row.begin(), row.end()));
  return result;
}

double least_corner(const Bicubic& b) {
  return std::min({b[0][0], b[0][3], b[3][0], b[3][3]});
}

/// The least coefficient, sharpened until it is positive, known not to be, or near enough to a value taken.
double sharpened(const Bicubic& b, double tolerance, int depth) {
  const double bound = least(b), corner = least_corner(b);
  if (bound > 0 || corner <= 0 || corner - bound < tolerance || depth == 0) return bound;
  double result = corner;
  Bicubic low{}, high{};
  for (int i = 0; i < 4; ++i) halve(b[i], low[i], high[i]);
  for (const Bicubic& half : {low, high}) {
    const Bicubic first = map_columns(half, [](const Cubic& c) {
      Cubic l, h;
      halve(c, l, h);
      return l;
    });
    const Bicubic second = map_columns(half, [](const Cubic& c) {
      Cubic l, h;
      halve(c, l, h);
      return h;
    });
    result =
        std::min({result, sharpened(first, tolerance, depth - 1), sharpened(second, tolerance, depth - 1)});
  }
  return result;
}

/// The quad with straight sides between the corners.
struct StraightQuad {
  std::array<Vector3, 4> sides;
  Vector3 normal;     ///< unit; zero for a quad without area
  double mean = 0;    ///< of the Jacobian along the normal
  double least = -1;  ///< of the Jacobian along the normal, which is linear, so at a corner
  double turned = 0;  ///< largest part of the Jacobian across the normal

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

/// How far each midside node lies from the middle of its straight side.
std::array<Vector3, 4> bulges(const CurvedQuad& element) {
  std::array<Vector3, 4> result;
  for (int k = 0; k < 4; ++k)
    result[k] = element.midsides[k] - 0.5 * (element.corners[k] + element.corners[(k + 1) % 4]);
  return result;
}

/// The Bernstein coefficients of the Jacobian's part along a direction.
Bicubic along(const std::array<std::array<Vector3, 4>, 4>& values, const Vector3& direction) {
  Bicubic rows{};
  for (int i = 0; i < 4; ++i) {
    Cubic row{};
    for (int j = 0; j < 4; ++j) row[j] = values[i][j].dot(direction);
    rows[i] = to_bernstein(row);
  }
  return map_columns(rows, to_bernstein);
}

/// The mean of the Jacobian over the element: that of its Bernstein coefficients.
Vector3 mean_jacobian(const std::array<std::array<Vector3, 4>, 4>& values) {
  constexpr Cubic weights{1.0 / 8, 3.0 / 8, 3.0 / 8, 1.0 / 8};  // of values at 0, 1/3, 2/3, 1
  Vector3 mean = Vector3::Zero();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) mean += weights[i] * weights[j] * values[i][j];
  }
  return mean;
}

}  // namespace

CurvedQuad curved_quad(const ShellMesh& mesh, std::size_t quad) {
  CurvedQuad element;
  for (int k = 0; k < 4; ++k) {
    element.corners[k] = mesh.points[mesh.quads[quad][k]];
    element.midsides[k] = mesh.points[mesh.midsides[quad][k]];
  }
  return element;
}

CurvedQuad straight_quad(const ShellMesh& mesh, std::size_t quad) {
  CurvedQuad element;
  for (int k = 0; k < 4; ++k) element.corners[k] = mesh.points[mesh.quads[quad][k]];
  for (int k = 0; k < 4; ++k) element.midsides[k] = 0.5 * (element.corners[k] + element.corners[(k + 1) % 4]);
  return element;
}

double quick_jacobian_bound(const CurvedQuad& element) {
  const StraightQuad straight(element.corners);
  if (!(straight.mean > 0)) return -1;
  // The bulges b change the derivatives of the map by at most these, and the lengths of dx/dxi and dx/deta
  // are half those of the straight sides at most.
  std::array<double, 4> inside{}, length{}, bulge{};  // in the plane of the straight quad, and in space
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
  // All Jacobians lie in a cone round the normal: two of them form twice its angle at most.
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
