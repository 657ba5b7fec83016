/// Criteria of shell quads. Based on: the element checks of HyperMesh as Altair documents them (warpage,
/// skew, Jacobian at Gauss points, taper, angles, aspect by sides).

#include "mesher/mesh/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace quadrille {
namespace {

constexpr double tiny = std::numeric_limits<double>::min();
constexpr double degrees = 180 / std::numbers::pi;

/// Four corners, the sides between them, and the cross products of the sides.
struct Quad {
  std::array<Vector3, 4> p;
  std::array<Vector3, 4> sides;    ///< from corner j to j + 1
  std::array<Vector3, 4> crosses;  ///< at corner j: twice the area vector of the corner's triangle

  Quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) : p{a, b, c, d} {
    for (int j = 0; j < 4; ++j) sides[j] = p[(j + 1) & 3] - p[j];
    for (int j = 0; j < 4; ++j) crosses[j] = sides[(j + 3) & 3].cross(sides[j]);
  }

  /// Shortest and longest.
  std::array<double, 2> lengths() const {
    std::array<double, 2> result{std::numeric_limits<double>::max(), 0};
    for (const Vector3& side : sides)
      result = {std::min(result[0], side.norm()), std::max(result[1], side.norm())};
    return result;
  }

  double warp() const {
    return degrees * std::max(angle_between(crosses[1], crosses[3]), angle_between(crosses[0], crosses[2]));
  }

  double skew() const {
    const Vector3 u = p[2] + p[3] - p[0] - p[1], v = p[3] + p[0] - p[1] - p[2];
    const double angle = degrees * angle_between(u, v);
    return 90 - std::min(angle, 180 - angle);
  }

  /// Smallest and largest angle, degrees. Corners that are reflex about the mean normal have more than 180.
  std::array<double, 2> corner_angles() const {
    const Vector3 mean = crosses[0] + crosses[1] + crosses[2] + crosses[3];
    const Vector3 normal = mean / std::max(mean.norm(), tiny);
    std::array<double, 2> result{360, 0};
    for (int j = 0; j < 4; ++j) {
      double angle = degrees * std::atan2(crosses[j].dot(normal), -sides[(j + 3) & 3].dot(sides[j]));
      if (angle < 0) angle += 360;
      result = {std::min(result[0], angle), std::max(result[1], angle)};
    }
    return result;
  }

  double jacobian_ratio() const {
    const Vector3 mean = crosses[1] + crosses[3];
    const Vector3 normal = mean / std::max(mean.norm(), tiny);
    const double gauss = 1 / std::sqrt(3.0);
    double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
    for (const double x : {-gauss, gauss}) {
      for (const double y : {-gauss, gauss}) {
        const Vector3 dx = (1 - y) * sides[0] - (1 + y) * sides[2];
        const Vector3 dy = (1 + x) * sides[1] - (1 - x) * sides[3];
        const double jacobian = dx.cross(dy).dot(normal) / 16;
        least = std::min(least, jacobian);
        most = std::max(most, jacobian);
      }
    }
    return least / std::max(most, tiny);
  }

  double taper() const {
    double least = std::numeric_limits<double>::max(), sum = 0;
    for (const Vector3& cross : crosses) {
      least = std::min(least, cross.norm());
      sum += cross.norm();
    }
    return 1 - least / std::max(sum / 4, tiny);
  }
};

/// The criterion that a quad violates most, and how severely.
std::pair<double, Criterion> worst_of(const CriteriaValues& values, const CriteriaLimits& limits) {
  std::pair<double, Criterion> worst{0, Criterion::aspect};
  for (std::size_t i = 0; i < criterion_count; ++i) {
    const auto criterion = static_cast<Criterion>(i);
    const double severity = limits.severity(criterion, values[i]);
    if (severity > worst.first) worst = {severity, criterion};
  }
  return worst;
}

}  // namespace

double CriteriaLimits::severity(Criterion criterion, double value) const {
  const auto i = static_cast<std::size_t>(criterion);
  if (std::isnan(values[i])) return 0;
  if (criterion == Criterion::min_length) return values[i] / std::max(value, tiny);
  return (value - criteria_info[i].ideal) / (values[i] - criteria_info[i].ideal);
}

bool CriteriaLimits::fails(Criterion criterion, double value) const {
  const auto i = static_cast<std::size_t>(criterion);
  // Comparisons with NaN are false: an unchecked criterion never fails.
  return criteria_info[i].has_most() ? value > values[i] : value < values[i];
}

CriteriaLimits limits_of(const ShellMesh& mesh) {
  CriteriaLimits result;
  if (mesh.size_min > 0) result.values[static_cast<std::size_t>(Criterion::min_length)] = 0.5 * mesh.size_min;
  return result;
}

CriteriaValues measure_criteria(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Quad quad(a, b, c, d);
  const auto [angle_min, angle_max] = quad.corner_angles();
  const auto [shortest, longest] = quad.lengths();
  return {longest / std::max(shortest, tiny),
          quad.warp(),
          quad.skew(),
          angle_min,
          angle_max,
          quad.jacobian_ratio(),
          quad.taper(),
          shortest};
}

CriteriaSummary check_criteria(const ShellMesh& mesh, const CriteriaLimits& limits, int worst_count) {
  CriteriaSummary summary;
  summary.quads = static_cast<int>(mesh.quads.size());
  std::map<int, CriteriaSummary::Face> faces;
  std::vector<std::pair<double, CriteriaSummary::Quad>> failing;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    const auto& [a, b, c, d] = mesh.quads[i];
    const auto &pa = mesh.points[a], &pb = mesh.points[b], &pc = mesh.points[c], &pd = mesh.points[d];
    const CriteriaValues values = measure_criteria(pa, pb, pc, pd);
    const int number = mesh.quad_faces.empty() ? 0 : mesh.quad_faces[i];
    auto& face = faces[number];
    ++face.quads;
    const bool is_finer =
        std::binary_search(mesh.finer_quads.begin(), mesh.finer_quads.end(), static_cast<int>(i));
    bool any = false, outside = false;
    for (std::size_t k = 0; k < criterion_count; ++k) {
      const auto criterion = static_cast<Criterion>(k);
      if (!limits.fails(criterion, values[k]) || (is_finer && criterion == Criterion::min_length)) continue;
      ++summary.failing_by[k];
      any = true;
      outside = outside || is_of_shape(criterion);
    }
    if (!any) continue;
    ++face.failing;
    ++summary.failing;
    summary.outside += outside;
    const auto [severity, worst] = worst_of(values, limits);
    failing.push_back({severity,
                       {static_cast<int>(i), number, (pa + pb + pc + pd) / 4, worst,
                        values[static_cast<std::size_t>(worst)]}});
  }
  for (auto& [number, face] : faces) {
    face.face = number;
    if (face.failing > 0) summary.faces.push_back(face);
  }
  std::stable_sort(failing.begin(), failing.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  failing.resize(std::min(failing.size(), static_cast<std::size_t>(std::max(worst_count, 0))));
  for (const auto& [severity, quad] : failing) summary.worst.push_back(quad);
  return summary;
}

}  // namespace quadrille
