/// Extrapolates the stresses in quads to their corners, and compares the largest ones by place.

#include "mesher/adapt/peak_stress.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

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

class PeakFinder {
 public:
  PeakFinder(const ShellMesh& mesh, const std::vector<std::array<ShellStress, 4>>& stresses)
      : mesh_(mesh),
        corners_(corners_by_node(mesh.points.size(), mesh.quads)),
        stress_(means_at_nodes(mesh, [&](Side corner) {
          return stress_at_corner(stresses[element_of(corner)], index_of(corner));
        })) {}

  std::vector<StressPeak> find() const {
    const std::vector<double> of_quads = sizes_of(mesh_);
    const std::vector<double> sizes =
        means_at_nodes(mesh_, [&](Side corner) { return of_quads[element_of(corner)]; });
    constexpr double least_share = 0.3, apart = 3;
    constexpr std::size_t max_peaks = 10;
    const double largest = *std::ranges::max_element(stress_);
    std::vector<std::size_t> order(stress_.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](std::size_t node) {
      return corners_[node].empty() || stress_[node] < least_share * largest || !is_highest(node);
    });
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t node) { return stress_[node]; });
    std::vector<StressPeak> peaks;
    for (const std::size_t node : order) {
      const Vector3& at = mesh_.points[node];
      const double size = sizes[node];
      const bool is_apart = std::ranges::none_of(peaks, [&](const StressPeak& other) {
        return (other.at - at).norm() < apart * std::max(size, other.size);
      });
      if (is_apart) peaks.push_back({at, stress_[node], size, is_sharp_corner(node)});
      if (peaks.size() == max_peaks) break;
    }
    return peaks;
  }

 private:
  bool is_highest(std::size_t node) const {
    for (const Side corner : corners_[node])
      for (const int other : mesh_.quads[element_of(corner)])
        if (stress_[other] > stress_[node]) return false;
    return true;
  }

  /// Whether the node lies on the rim, and the mesh fills more than 240 degrees around it. Rims of round
  /// holes with 7 segments or more are below that.
  bool is_sharp_corner(std::size_t node) const {
    constexpr double sharp = 4 * M_PI / 3;
    double angle = 0;
    std::map<int, int> sides;  // quads by the other end of their sides at the node
    for (const Side corner : corners_[node]) {
      const auto& quad = mesh_.quads[element_of(corner)];
      const int k = index_of(corner), next = quad[(k + 1) % 4], before = quad[(k + 3) % 4];
      angle +=
          angle_between(mesh_.points[next] - mesh_.points[node], mesh_.points[before] - mesh_.points[node]);
      ++sides[next];
      ++sides[before];
    }
    const bool on_rim = std::ranges::any_of(sides, [](const auto& side) { return side.second == 1; });
    return on_rim && angle > sharp;
  }

  const ShellMesh& mesh_;
  Rows<Side> corners_;
  std::vector<double> stress_;  // (points) 0 where no quad has a corner
};

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
  return mesh.quads.empty() ? std::vector<StressPeak>() : PeakFinder(mesh, stresses).find();
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
