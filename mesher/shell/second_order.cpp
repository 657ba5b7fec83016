/// Based on: Johnen, Remacle, Geuzaine, Geometrical validity of curvilinear finite elements (2013).

#include "mesher/shell/second_order.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille {

namespace {

/// 4 x 4 values or Bernstein coefficients of a bicubic polynomial on the unit square.
using Bicubic = std::array<std::array<double, 4>, 4>;
using Cubic = std::array<double, 4>;

constexpr std::array<double, 4> corner_xi{-1, 1, 1, -1}, corner_eta{-1, -1, 1, 1};
constexpr std::array<double, 4> midside_xi{0, 1, 0, -1}, midside_eta{-1, 0, 1, 0};

/// (dx/dxi) x (dx/deta) at a point of the reference square [-1, 1]^2.
Vector3 area_vector(const std::array<Vector3, 4>& corners, const std::array<Vector3, 4>& midsides, double xi,
                    double eta) {
  Vector3 along = Vector3::Zero(), across = Vector3::Zero();
  for (int k = 0; k < 4; ++k) {
    const double a = corner_xi[k], b = corner_eta[k];
    along += 0.25 * a * (1 + eta * b) * (2 * xi * a + eta * b) * corners[k];
    across += 0.25 * b * (1 + xi * a) * (2 * eta * b + xi * a) * corners[k];
    const double c = midside_xi[k], d = midside_eta[k];
    if (c == 0) {
      along += -xi * (1 + eta * d) * midsides[k];
      across += 0.5 * (1 - xi * xi) * d * midsides[k];
    } else {
      along += 0.5 * c * (1 - eta * eta) * midsides[k];
      across += -eta * (1 + xi * c) * midsides[k];
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

}  // namespace

double jacobian_bound(const std::array<Vector3, 4>& corners, const std::array<Vector3, 4>& midsides) {
  const Vector3 normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
  const double length = normal.norm();
  if (!(length > 0)) return -1;
  Bicubic values{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      values[i][j] = area_vector(corners, midsides, 2.0 * j / 3 - 1, 2.0 * i / 3 - 1).dot(normal) / length;
    }
  }
  Bicubic rows{};
  for (int i = 0; i < 4; ++i) rows[i] = to_bernstein(values[i]);
  const Bicubic coefficients = map_columns(rows, to_bernstein);
  // The mean Jacobian over the reference square, whose area is 4, is about the element's area over 4.
  const double mean = length / 8;
  constexpr int max_depth = 5;
  return sharpened(coefficients, 1e-3 * mean, max_depth) / mean;
}

double jacobian_bound(const ShellMesh& mesh, std::size_t quad) {
  std::array<Vector3, 4> corners, midsides;
  for (int k = 0; k < 4; ++k) {
    corners[k] = mesh.points[mesh.quads[quad][k]];
    midsides[k] = mesh.points[mesh.midsides[quad][k]];
  }
  return jacobian_bound(corners, midsides);
}

}  // namespace quadrille
