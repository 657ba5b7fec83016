/// Measures of quads.
/// Based on: Giuliani & Krivodonova, Fast unstructured quadrilateral mesh generation (2018), eq. 1 (q);
/// Knupp, Achieving finite element mesh quality via optimization of the Jacobian matrix norm, part I (2000).

#include "mesher/mesh/quality.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "geometry/base/whole_number.hpp"
#include "mesher/mesh/quad_geometry.hpp"
#include "mesher/mesh/second_order.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {
namespace {

constexpr double pi = std::numbers::pi;

/// The side from each corner j to j + 1, the cross products at the corners, and their sum.
struct Frame {
  std::array<Vector3, 4> sides, crosses;
  std::array<double, 4> lengths;
  double shortest = 0, longest = 0;  ///< of the sides
  double area = 0;                   ///< four times the quad's area
  Vector3 normal;  ///< unit length; zero for a degenerate quad, without area or with a side of no length

  explicit Frame(const std::array<const Vector3*, 4>& p) {
    for (int j = 0; j < 4; ++j) {
      sides[j] = *p[(j + 1) & 3] - *p[j];
      lengths[j] = sides[j].norm();
    }
    normal.setZero();
    for (int j = 0; j < 4; ++j) {
      crosses[j] = sides[(j + 3) & 3].cross(sides[j]);
      normal += crosses[j];
    }
    area = normal.norm();
    if (area > 0) normal /= area;
    std::tie(shortest, longest) = std::minmax({lengths[0], lengths[1], lengths[2], lengths[3]});
    if (shortest < no_length * longest) normal.setZero();
  }

  /// Sine and cosine of the angle of corner j, signed by the mean normal.
  std::pair<double, double> sine_cosine(int j) const {
    const int before = (j + 3) & 3;
    const double length = std::max(lengths[before] * lengths[j], std::numeric_limits<double>::min());
    return {crosses[j].dot(normal) / length, -sides[before].dot(sides[j]) / length};
  }

  double scaled_jacobian() const {
    double least = 1;
    for (int j = 0; j < 4; ++j) least = std::min(least, sine_cosine(j).first);
    return least;
  }

  double q() const {
    double off = 0;
    for (int j = 0; j < 4; ++j) {
      const auto [sine, cosine] = sine_cosine(j);
      const double angle = std::atan2(sine, cosine);
      off = std::max(off, std::abs(pi / 2 - (angle < 0 ? angle + 2 * pi : angle)));
    }
    return std::max(1 - 2 / pi * off, 0.0);
  }

  /// The least Jacobian at a corner, divided by the mean of the four: the cross products are proportional to
  /// the Jacobians, and `area` is their sum.
  double jacobian() const {
    double least = area;
    for (const Vector3& cross : crosses) least = std::min(least, cross.dot(normal));
    return area > 0 ? 4 * least / area : 0;
  }

  /// The largest angle between a corner's normal and the mean normal.
  double warping() const {
    double largest = 0;
    for (const Vector3& cross : crosses) largest = std::max(largest, angle_between(cross, normal));
    return largest;
  }
};

/// Marks the nodes that elements of two faces share.
void mark_shared_nodes(const ShellMesh& mesh, std::vector<char>& border) {
  if (mesh.quad_faces.size() != mesh.quads.size()) return;
  std::vector<int> face_of(mesh.points.size(), 0);
  for (std::size_t i = 0; i < mesh.quads.size(); ++i)
    for (const int node : mesh.quads[i]) {
      if (face_of[node] != 0 && face_of[node] != mesh.quad_faces[i]) border[node] = 1;
      face_of[node] = mesh.quad_faces[i];
    }
}

/// Adds one element's Jacobian to the summary: over the whole element at second order, else at its corners.
/// \param least,is_inverted by the corners
void measure_jacobian(const ShellMesh& mesh, std::size_t quad, double least, bool is_inverted,
                      QualitySummary& summary) {
  if (mesh.order == 2 && quad < mesh.midsides.size()) {
    // jacobian_bound() costs far more than quick_jacobian_bound(), which is enough for good elements.
    const CurvedQuad element = curved_quad(mesh, quad);
    least = quick_jacobian_bound(element);
    is_inverted = is_inverted || (!(least > 0) && folds(element));
    if (least < summary.jacobian_min) least = jacobian_bound(element);
  }
  summary.inverted += is_inverted;
  summary.jacobian_min = std::min(summary.jacobian_min, least);
}

/// Measures some of the elements. The means of the result are still sums.
QualitySummary measure_range(const ShellMesh& mesh, std::size_t begin, std::size_t end) {
  const auto& x = mesh.points;
  QualitySummary summary;
  summary.q_min = summary.sj_min = summary.jacobian_min = 1;
  for (std::size_t i = begin; i < end; ++i) {
    const auto& quad = mesh.quads[i];
    const Frame frame({&x[quad[0]], &x[quad[1]], &x[quad[2]], &x[quad[3]]});
    const double q = frame.q(), scaled_jacobian = frame.scaled_jacobian();
    summary.q_min = std::min(summary.q_min, q);
    summary.q_mean += q;
    summary.sj_min = std::min(summary.sj_min, scaled_jacobian);
    summary.sj_mean += scaled_jacobian;
    measure_jacobian(mesh, i, frame.jacobian(), scaled_jacobian <= 0, summary);
    ++summary.q_histogram[cell_at(q * 20, 20)];
    const double aspect = frame.longest / std::max(frame.shortest, std::numeric_limits<double>::min());
    summary.aspect_max = std::max(summary.aspect_max, aspect);
    summary.aspect_mean += aspect;
    summary.warping_max_degrees = std::max(summary.warping_max_degrees, frame.warping() * 180 / pi);
  }
  return summary;
}

void measure_elements(const ShellMesh& mesh, QualitySummary& summary) {
  // Partial sums are added in the order of the mesh, so the result is the same on any number of threads.
  constexpr std::size_t at_once = 16384;
  const std::size_t size = mesh.quads.size();
  std::vector<QualitySummary> parts((size + at_once - 1) / at_once);
  oneapi::tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = measure_range(mesh, i * at_once, std::min((i + 1) * at_once, size));
  });
  summary.q_min = summary.sj_min = summary.jacobian_min = 1;
  for (const QualitySummary& part : parts) {
    summary.q_min = std::min(summary.q_min, part.q_min);
    summary.q_mean += part.q_mean;
    summary.sj_min = std::min(summary.sj_min, part.sj_min);
    summary.sj_mean += part.sj_mean;
    summary.inverted += part.inverted;
    summary.jacobian_min = std::min(summary.jacobian_min, part.jacobian_min);
    for (std::size_t k = 0; k < part.q_histogram.size(); ++k) summary.q_histogram[k] += part.q_histogram[k];
    summary.aspect_max = std::max(summary.aspect_max, part.aspect_max);
    summary.aspect_mean += part.aspect_mean;
    summary.warping_max_degrees = std::max(summary.warping_max_degrees, part.warping_max_degrees);
  }
  const auto count = static_cast<double>(size);
  summary.q_mean /= count;
  summary.sj_mean /= count;
  summary.aspect_mean /= count;
}

void measure_sides(const ShellMesh& mesh, QualitySummary& summary) {
  std::vector<int> valence(mesh.points.size(), 0);
  std::vector<char> border(mesh.points.size(), 0);
  std::vector<double> lengths;
  lengths.reserve(2 * mesh.quads.size() + 2 * mesh.triangles.size());
  const auto measure_side = [&](int low, int high, std::span<const Side> sides) {
    lengths.push_back((mesh.points[low] - mesh.points[high]).norm());
    ++valence[low];
    ++valence[high];
    if (sides.size() != 2) border[low] = border[high] = 1;
  };
  for_each_shared_side(mesh.points.size(), no_check, measure_side, mesh.quads, mesh.triangles);
  mark_shared_nodes(mesh, border);
  int interior = 0, irregular = 0;
  for (std::size_t i = 0; i < valence.size(); ++i) {
    if (valence[i] == 0) continue;
    ++summary.nodes;
    if (border[i]) continue;
    ++interior;
    irregular += valence[i] != 4;
    if (summary.valence_counts.size() <= static_cast<std::size_t>(valence[i]))
      summary.valence_counts.resize(valence[i] + 1, 0);
    ++summary.valence_counts[valence[i]];
  }
  if (interior > 0) summary.irregular_percent = 100.0 * irregular / interior;
  if (lengths.empty()) return;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  summary.edge_median = *middle;
  summary.edge_min = *std::min_element(lengths.begin(), lengths.end());
  summary.edge_max = *std::max_element(lengths.begin(), lengths.end());
}

}  // namespace

double quad_q(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return Frame({&a, &b, &c, &d}).q();
}

double quad_scaled_jacobian(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return Frame({&a, &b, &c, &d}).scaled_jacobian();
}

QualitySummary quality(const ShellMesh& mesh) {
  QualitySummary summary;
  summary.quads = static_cast<int>(mesh.quads.size());
  summary.triangles = static_cast<int>(mesh.triangles.size());
  if (!mesh.quads.empty()) measure_elements(mesh, summary);
  measure_sides(mesh, summary);
  return summary;
}

std::vector<double> quad_qualities(const ShellMesh& mesh) {
  std::vector<double> result;
  result.reserve(mesh.quads.size());
  for (const auto& quad : mesh.quads) result.push_back(quad_q(mesh.points, quad));
  return result;
}

}  // namespace quadrille
