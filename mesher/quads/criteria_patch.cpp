/// Measures the quads around a node without branches, four places at a time, and steps by Newton's method.

#include "mesher/quads/criteria_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/mesh/criteria.hpp"

// Compiled a second time for processors with registers of four numbers; the results are the same bit for bit.
// The choice when the program starts needs ELF.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define QUADRILLE_FOR_WIDER_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define QUADRILLE_FOR_WIDER_REGISTERS
#endif

namespace quadrille {
namespace {

constexpr double huge = 1e30;
constexpr double tiny = std::numeric_limits<double>::min();
/// Bound on an objective, so that a quad that the CAD forces out of shape does not outweigh its neighbors.
constexpr double ceiling = 1000;
/// A quad with a smaller cosine between its normal and `up` is drawn in the plane of u and v instead.
constexpr double facing = 0.1;
constexpr double square(double x) {
  return x * x;
}

constexpr double sin2_corner = 0.586824;  // squared sine of 50 degrees
constexpr double sin2_skew = 0.413176;    // squared sine of 40 degrees
static_assert(usual_limit(Criterion::angle_min) == 90 - 50 && usual_limit(Criterion::angle_max) == 90 + 50 &&
              usual_limit(Criterion::skew) == 40);
constexpr double aspect2 = square(usual_limit(Criterion::aspect));
/// With taper t the Jacobian ratio of a plane quad is (1 - t / root 3) / (1 + t / root 3).
constexpr double taper2 =
    3 * square((1 - usual_limit(Criterion::jacobian_ratio)) / (1 + usual_limit(Criterion::jacobian_ratio)));
static_assert(aspect2 == 25 && taper2 == 0.1875);
/// Weight of the squared aspect in the squareness term, beside 1 for the squared cosines of the corners.
/// Without it, rows would close up where that term turns corners.
constexpr double evenness = 0.02;
/// Weight of the squared taper there. With it, grids that are sheared as a whole stay so, and no quads become
/// squares at the expense of the others.
constexpr double parallelism = 3;

/// A plane quad p, b, c, d. Written without branches, so that compilers can process several at once: not by a
/// call, which takes nine times the instructions.
struct Plane {
  double sine2, value;  // square of the least corner's sine; -1 if not convex
  double side2;         // squared length from p to b

  [[gnu::always_inline]] Plane(double px, double py, double bx, double by, double cx, double cy, double dx,
                               double dy, double squareness) {
    const double sx = bx - px, sy = by - py, tx = cx - bx, ty = cy - by;
    const double wx = dx - cx, wy = dy - cy, zx = px - dx, zy = py - dy;
    const double ss = sx * sx + sy * sy, tt = tx * tx + ty * ty, ww = wx * wx + wy * wy,
                 zz = zx * zx + zy * zy;
    const double cp = zx * sy - zy * sx, cb = sx * ty - sy * tx, cc = tx * wy - ty * wx,
                 cd = wx * zy - wy * zx;
    // One division for all four corners' squared sines would lose small quads to underflow.
    const double qp = cp / (zz * ss + tiny) * cp, qb = cb / (ss * tt + tiny) * cb,
                 qc = cc / (tt * ww + tiny) * cc, qd = cd / (ww * zz + tiny) * cd;
    const double corners = square(1 - qp) + square(1 - qb) + square(1 - qc) + square(1 - qd);
    const double turned = 4 - qp - qb - qc - qd;
    const double longest = std::max(std::max(ss, tt), std::max(ww, zz));
    const double shortest = std::min(std::min(ss, tt), std::min(ww, zz));
    const double aspect = longest / (shortest + tiny);
    const double mx = tx - zx, my = ty - zy, nx = wx - sx, ny = wy - sy;  // along the mid-lines
    const double dot = mx * nx + my * ny;
    const double skew = dot / ((mx * mx + my * my) * (nx * nx + ny * ny) + tiny) * dot;
    const double mean = cp + cb + cc + cd;
    const double taper =
        (std::abs(cb + cc - cp - cd) + std::abs(cc + cd - cp - cb)) / (std::abs(mean) + tiny);
    const double sum = corners * (1 / square(sin2_corner)) + square(skew * (1 / sin2_skew)) +
                       square(aspect * (1 / aspect2)) + square(taper * taper * (1 / taper2)) +
                       squareness * (turned + evenness * (aspect - 1) + parallelism * taper * taper);
    side2 = ss;
    const double least = std::min(std::min(cp, cb), std::min(cc, cd));
    sine2 = least > 0 ? std::min(std::min(qp, qb), std::min(qc, qd)) : -1;
    value = least > 0 ? sum / (1 + sum * (1 / ceiling)) : huge;
  }
};

/// The plane of a quad's diagonals, the first of which is its x axis.
struct Frame {
  Vector3 x{0, 0, 0}, y{0, 0, 0}, normal;
  double length = 0;  // length of the first diagonal; 0 for a quad without area

  Frame(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    const Vector3 first = c - a;
    normal = first.cross(d - b);
    const double area = normal.norm();
    length = first.norm();
    if (!(area > 0)) {
      length = 0;
      normal.setZero();
      return;
    }
    normal /= area;
    x = first / length;
    y = normal.cross(x);
  }
};

}  // namespace

QuadObjective measure_objective(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                                double squareness) {
  const Frame frame(a, b, c, d);
  if (frame.length == 0) return {ceiling, -1, frame.normal};
  const Vector3 ab = b - a, ad = d - a;
  const Plane plane(0, 0, frame.x.dot(ab), frame.y.dot(ab), frame.length, 0, frame.x.dot(ad), frame.y.dot(ad),
                    squareness);
  return {std::min(plane.value, ceiling), plane.sine2 < 0 ? -1 : std::sqrt(plane.sine2), frame.normal};
}

FlatQuad::FlatQuad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, const Vector3& up,
                   const Vector3& u, const Vector3& v) {
  Frame frame(a, b, c, d);
  if (!(frame.normal.dot(up) > facing)) {
    frame.x = u;
    frame.y = v;
  }
  const std::array<Vector3, 4> along{Vector3::Zero(), b - a, c - a, d - a};
  for (int k = 0; k < 4; ++k) {
    x_[k] = frame.x.dot(along[k]);
    y_[k] = frame.y.dot(along[k]);
  }
  ux_ = frame.x.dot(u);
  uy_ = frame.y.dot(u);
  vx_ = frame.x.dot(v);
  vy_ = frame.y.dot(v);
}

void FlatQuad::move(int corner, double x, double y) {
  x_[corner] += x * ux_ + y * vx_;
  y_[corner] += x * uy_ + y * vy_;
}

QuadObjective FlatQuad::measure() const {
  const Plane plane(x_[0], y_[0], x_[1], y_[1], x_[2], y_[2], x_[3], y_[3], 0);
  return {std::min(plane.value, ceiling), plane.sine2 < 0 ? -1 : std::sqrt(plane.sine2), Vector3::Zero()};
}

std::array<double, 2> FlatQuad::sides_at(int corner) const {
  const auto side = [&](int other) {
    const double x = x_[other & 3] - x_[corner], y = y_[other & 3] - y_[corner];
    return std::sqrt(x * x + y * y);
  };
  return {side(corner + 1), side(corner + 3)};
}

bool CriteriaPatch::add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d,
                        double weight) {
  const Frame frame(a, b, c, d);
  if (count_ == max_quads || frame.length == 0) return false;
  const Vector3 ab = b - a, ad = d - a;
  quads_[count_++] = {frame.x.dot(ab), frame.y.dot(ab), frame.length,    0,
                      frame.x.dot(ad), frame.y.dot(ad), frame.x.dot(u_), frame.y.dot(u_),
                      frame.x.dot(v_), frame.y.dot(v_), weight};
  return true;
}

bool CriteriaPatch::add(const FlatQuad& quad, int corner) {
  if (count_ == max_quads) return false;
  const auto x = [&](int k) { return quad.x_[(corner + k) & 3] - quad.x_[corner]; };
  const auto y = [&](int k) { return quad.y_[(corner + k) & 3] - quad.y_[corner]; };
  quads_[count_++] = {x(1), y(1), x(2), y(2), x(3), y(3), quad.ux_, quad.uy_, quad.vx_, quad.vy_, 1};
  return true;
}

QUADRILLE_FOR_WIDER_REGISTERS
CriteriaPatch::Lanes CriteriaPatch::evaluate(const Lanes& x, const Lanes& y) const {
  Lanes result{};
  for (int i = 0; i < count_; ++i) {
    const Quad& q = quads_[i];
    for (int k = 0; k < lanes; ++k) {
      const Plane plane(x[k] * q.ux + y[k] * q.vx, x[k] * q.uy + y[k] * q.vy, q.bx, q.by, q.cx, q.cy, q.dx,
                        q.dy, squareness_);
      result[k] += q.weight * plane.value;
    }
  }
  return result;
}

QUADRILLE_FOR_WIDER_REGISTERS
CriteriaPatch::Lanes CriteriaPatch::merits(const Lanes& x, const Lanes& y, double short_side) const {
  Lanes least, shortest, sum{};
  least.fill(1);
  shortest.fill(std::numeric_limits<double>::max());
  for (int i = 0; i < count_; ++i) {
    const Quad& q = quads_[i];
    for (int k = 0; k < lanes; ++k) {
      const Plane plane(x[k] * q.ux + y[k] * q.vx, x[k] * q.uy + y[k] * q.vy, q.bx, q.by, q.cx, q.cy, q.dx,
                        q.dy, squareness_);
      least[k] = std::min(least[k], plane.sine2);
      shortest[k] = std::min(shortest[k], plane.side2);
      sum[k] += std::sqrt(plane.side2);
    }
  }
  Lanes result;
  for (int k = 0; k < lanes; ++k) {
    const double share = std::sqrt(shortest[k]) * count_ / (short_side * sum[k] + tiny);
    result[k] = least[k] > 0 ? std::sqrt(least[k]) * std::min(1.0, share) : least[k];
  }
  return result;
}

std::array<double, 2> CriteriaPatch::lowest(double shortest, double longest) const {
  const double h = 0.1 * shortest;
  const Lanes x{0, h, -h, 0, 0, h, -h, 0}, y{0, 0, 0, h, -h, h, -h, 0};
  const auto f = evaluate(x, y);
  const double gx = (f[1] - f[2]) / (2 * h), gy = (f[3] - f[4]) / (2 * h);
  double xx = (f[1] + f[2] - 2 * f[0]) / (h * h), yy = (f[3] + f[4] - 2 * f[0]) / (h * h);
  const double xy = (f[5] + f[6] + 2 * f[0] - f[1] - f[2] - f[3] - f[4]) / (2 * h * h);
  // Shift the eigenvalues until the lower one is at least a tenth of the largest magnitude.
  const double middle = 0.5 * (xx + yy), radius = std::sqrt(square(0.5 * (xx - yy)) + square(xy));
  const double wanted = 0.1 * (std::abs(middle) + radius), shift = std::max(0.0, wanted - (middle - radius));
  xx += shift;
  yy += shift;
  const double determinant = xx * yy - xy * xy;
  double sx = -(yy * gx - xy * gy) / determinant, sy = -(xx * gy - xy * gx) / determinant;
  const double length = std::sqrt(square(sx) + square(sy));
  const auto best = std::min_element(f.begin(), f.end()) - f.begin();
  if (!std::isfinite(length) || length == 0) return {x[best], y[best]};
  if (length > longest) {
    sx *= longest / length;
    sy *= longest / length;
  }
  constexpr Lanes shares{1.5, 1.2, 1, 0.7, 0.4, 0.2, 0.1, 0.03};
  Lanes px, py;
  for (int k = 0; k < lanes; ++k) {
    px[k] = shares[k] * sx;
    py[k] = shares[k] * sy;
  }
  const auto along = evaluate(px, py);
  const auto lowest = std::min_element(along.begin(), along.end()) - along.begin();
  if (f[best] < along[lowest]) return {x[best], y[best]};
  return {px[lowest], py[lowest]};
}

}  // namespace quadrille
