/// Extrapolates the stresses in quads to their corners, and compares the largest ones by place.

#include "mesher/adapt/peak_stress.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "mesher/adapt/error_estimate.hpp"
#include "mesher/adapt/shell_stress.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

namespace {

double von_mises(const Tensor& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * s.tail<3>().squaredNorm());
}

/// The larger von Mises stress of a quad's two surfaces at a corner, from its four points.
double stress_at_corner(const std::array<ShellStress, 4>& points, int corner) {
  const double near = 1 + 0.5 * std::sqrt(3.0), beside = -0.5, far = 1 - 0.5 * std::sqrt(3.0);
  const auto extrapolated = [&](Tensor ShellStress::*part) -> Tensor {
    return near * points[corner].*part +
           beside * (points[(corner + 1) % 4].*part + points[(corner + 3) % 4].*part) +
           far * points[(corner + 2) % 4].*part;
  };
  const Tensor membrane = extrapolated(&ShellStress::membrane), bending = extrapolated(&ShellStress::bending);
  return std::max(von_mises(membrane + bending), von_mises(membrane - bending));
}

/// Whether a node lies on the rim, and the mesh fills more than 240 degrees around it. Rims of round holes
/// with 7 segments or more are below that. \param corners of the quads at the node
bool is_sharp_corner(const ShellMesh& mesh, std::size_t node, std::span<const Side> corners) {
  constexpr double sharp = 4 * M_PI / 3;
  double angle = 0;
  std::map<int, int> sides;  // quads by the other end of their sides at the node
  for (const Side corner : corners) {
    const auto& quad = mesh.quads[element_of(corner)];
    const int k = index_of(corner), next = quad[(k + 1) % 4], before = quad[(k + 3) % 4];
    angle += angle_between(mesh.points[next] - mesh.points[node], mesh.points[before] - mesh.points[node]);
    ++sides[next];
    ++sides[before];
  }
  const bool on_rim = std::ranges::any_of(sides, [](const auto& side) { return side.second == 1; });
  return on_rim && angle > sharp;
}

}  // namespace

std::string PeakChange::sentence() const {
  const std::string place = place_text(peak.at);
  const std::string percent = fmt::format("{:.3g} %", 100 * std::abs(change));
  if (is_singular())
    return fmt::format(
        "the peak stress at {}, a sharp re-entrant corner, has grown by {} since the previous mesh: it is "
        "singular and grows with every refinement, so that no mesh gives its value; round off the corner, or "
        "use the stress beside it",
        place, percent);
  return fmt::format(
      "the peak stress at {} is {} {} than on the previous mesh: it has not converged, although the global "
      "error is small; use a smaller size there, unless a point load or the end of a support "
      "makes it singular",
      place, percent, change > 0 ? "higher" : "lower");
}

std::vector<StressPeak> stress_peaks(const ShellMesh& mesh,
                                     const std::vector<std::array<ShellStress, 4>>& stresses) {
  constexpr double least_share = 0.3, apart = 3;
  constexpr std::size_t max_peaks = 10;
  std::vector<StressPeak> peaks;
  if (mesh.quads.empty()) return peaks;
  const Rows<Side> corners = corners_by_node(mesh.points.size(), mesh.quads);
  const std::vector<double> of_quads = sizes_of(mesh);
  const std::vector<double> sizes =
      means_at_nodes(corners, [&](Side corner) { return of_quads[element_of(corner)]; });
  const std::vector<double> stress = means_at_nodes(
      corners, [&](Side corner) { return stress_at_corner(stresses[element_of(corner)], index_of(corner)); });
  const double largest = *std::ranges::max_element(stress);
  const auto is_highest = [&](std::size_t node) {
    for (const Side corner : corners[node])
      for (const int other : mesh.quads[element_of(corner)])
        if (stress[other] > stress[node]) return false;
    return true;
  };
  std::vector<std::size_t> order;
  for (std::size_t node = 0; node < stress.size(); ++node)
    if (!corners[node].empty() && !(stress[node] < least_share * largest) && is_highest(node))
      order.push_back(node);
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t node) { return stress[node]; });
  for (const std::size_t node : order) {
    const Vector3& at = mesh.points[node];
    const bool is_apart = std::ranges::none_of(peaks, [&](const StressPeak& other) {
      return (other.at - at).norm() < apart * std::max(sizes[node], other.size);
    });
    if (is_apart)
      peaks.push_back({at, stress[node], sizes[node], is_sharp_corner(mesh, node, corners[node])});
    if (peaks.size() == max_peaks) break;
  }
  return peaks;
}

std::vector<PeakChange> changes_of_peaks(const std::vector<StressPeak>& before,
                                         const std::vector<StressPeak>& now) {
  constexpr double same_place = 2, settled = 0.05;
  std::vector<PeakChange> changes;
  for (const StressPeak& peak : now) {
    const auto distance = [&](const StressPeak& other) { return (other.at - peak.at).norm(); };
    const auto nearest = std::ranges::min_element(before, {}, distance);
    if (nearest == before.end() || !(nearest->stress > 0) ||
        distance(*nearest) > same_place * std::max(peak.size, nearest->size))
      continue;
    const double change = peak.stress / nearest->stress - 1;
    if (std::abs(change) > settled) changes.push_back({peak, change});
  }
  return changes;
}

}  // namespace quadrille
