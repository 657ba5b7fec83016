#pragma once
/// The shape measure of a quad that clean-up and smoothing share. Not part of the public interface.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/base/vector.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

/// If a side is shorter than this times the longest side, its direction is only rounding error.
constexpr double no_length = 1e-9;
/// A scaled Jacobian up to this is only rounding error: three corners lie in a line.
constexpr double no_jacobian = 1e-9;

/// q of a quad of indices into points.
inline double quad_q(std::span<const Vector3> points, const std::array<int, 4>& quad) {
  return quad_q(points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]);
}

/// Scaled Jacobian of a quad of indices into points.
inline double quad_scaled_jacobian(std::span<const Vector3> points, const std::array<int, 4>& quad) {
  return quad_scaled_jacobian(points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]);
}

/// \param mesh with points and quads
template <class Mesh>
bool has_inverted_quads(const Mesh& mesh) {
  return std::any_of(mesh.quads.begin(), mesh.quads.end(), [&](const std::array<int, 4>& quad) {
    return !(quad_scaled_jacobian(mesh.points, quad) > no_jacobian);
  });
}

/// A vector as long as the area of a quad and normal to it. Indices into points.
inline Vector3 quad_area_vector(std::span<const Vector3> points, const std::array<int, 4>& quad) {
  return 0.5 * (points[quad[2]] - points[quad[0]]).cross(points[quad[3]] - points[quad[1]]);
}

/// Scaled Jacobian of the quad a, b, c, d; negative also when the quad is folded against the surface normal.
/// For convex quads q = (2 / pi) asin(scaled Jacobian). Both rank quads in the same order, and this one needs
/// no arcsine.
inline double folded_scaled_jacobian(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                                     const Vector3& normal) {
  Vector3 mean = (c - a).cross(d - b);
  const double norm = mean.norm();
  if (!(norm > 0)) return -1;
  mean /= norm;
  const Vector3 ab = b - a, bc = c - b, cd = d - c, da = a - d;
  const double lab = ab.squaredNorm(), lbc = bc.squaredNorm(), lcd = cd.squaredNorm(), lda = da.squaredNorm();
  const double longest = std::max(std::max(lab, lbc), std::max(lcd, lda));
  if (std::min(std::min(lab, lbc), std::min(lcd, lda)) < no_length * no_length * longest) return -1e-3;
  const auto sine = [&](const Vector3& u, const Vector3& v, double squares) {
    return u.cross(v).dot(mean) / std::sqrt(std::max(squares, std::numeric_limits<double>::min()));
  };
  const double least = std::min(std::min(sine(da, ab, lda * lab), sine(ab, bc, lab * lbc)),
                                std::min(sine(bc, cd, lbc * lcd), sine(cd, da, lcd * lda)));
  return mean.dot(normal) > 0 ? least : std::min(-std::abs(least), -1e-3);
}

}  // namespace quadrille
