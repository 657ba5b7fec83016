/// Measures the share of quads outside the usual limits, the number of quads beside what the sizes request,
/// and their shapes.

#include "mesher/shell/face_judge.hpp"

#include <algorithm>

#include "mesher/faces/grid_waste.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/quads/criteria_patch.hpp"

namespace quadrille {

namespace {

/// The share of quads outside the usual limits for criteria other than warp. In large meshes a sample of
/// about a thousand quads is measured.
double share_outside(const FaceMesh& mesh) {
  constexpr std::size_t quads_measured = 1000;
  const std::size_t step = 1 + mesh.quads.size() / quads_measured;
  const CriteriaLimits limits;
  const auto& p = mesh.points;
  int outside = 0, measured = 0;
  for (std::size_t at = 0; at < mesh.quads.size(); at += step, ++measured) {
    const auto [a, b, c, d] = mesh.quads[at];
    const CriteriaValues values = measure_criteria(p[a], p[b], p[c], p[d]);
    for (std::size_t i = 0; i < criterion_count; ++i) {
      const auto criterion = static_cast<Criterion>(i);
      if (criterion == Criterion::warp || !limits.fails(criterion, values[i])) continue;
      ++outside;
      break;
    }
  }
  return static_cast<double>(outside) / std::max(1, measured);
}

/// Whether a grid has more than 1.5 quads per boundary node: over three rows if long, over six if square.
bool has_rows(const FaceMesh& grid) {
  return 2 * static_cast<double>(grid.quads.size()) > 3 * static_cast<double>(grid.nodes.size());
}

/// The sum over the quads of how far their objective exceeds `fine`. Each quad counts up to `worst_counted`.
double badness(const FaceMesh& mesh) {
  constexpr double fine = 0.5, worst_counted = 10;
  double sum = 0;
  const auto& p = mesh.points;
  for (const auto& [a, b, c, d] : mesh.quads)
    sum += std::clamp(measure_objective(p[a], p[b], p[c], p[d]).value - fine, 0.0, worst_counted);
  return sum;
}

}  // namespace

bool FaceJudge::is_doubtful(const FaceMesh& grid, const FacePlan& plan) {
  outside_ = has_rows(grid) ? share_outside(grid) : 0;
  wasteful_ = !plan.has_divided_edge && wastes_quads(grid, GridWaste::wasteful);
  return wasteful_ || outside_ > thresholds.outside_of_grid;
}

bool FaceJudge::replaces_grid(const FaceMesh& other, const FaceMesh& grid) const {
  const double left = share_outside(other);
  const double share = static_cast<double>(other.quads.size()) / static_cast<double>(grid.quads.size());
  if ((share < 1 ? 1 : thresholds.gain) * left < outside_) return true;
  return wasteful_ && share < GridWaste::fewer && left <= std::max(outside_, thresholds.most_outside / share);
}

bool FaceJudge::is_doubtful(const FaceMesh& cut) {
  cut_wastes_ = cut.quads.size() > thresholds.few && wastes_quads(cut, thresholds.too_many);
  return cut_wastes_ || badness(cut) >= thresholds.poor * static_cast<double>(cut.quads.size());
}

bool FaceJudge::replaces_cut(const FaceMesh& direct, const FaceMesh& cut) const {
  return cut_wastes_ || badness(direct) < thresholds.better * badness(cut);
}

bool FaceJudge::wastes_quads(const FaceMesh& mesh, double most) {
  double wanted = 0;
  SparseCheck check(context_);
  const auto& p = mesh.points;
  for (const auto& [a, b, c, d] : mesh.quads) {
    check();
    const Vector3 middle = 0.25 * (p[a] + p[b] + p[c] + p[d]);
    const double along = size_at_(middle), across = size_at_.across(along, surface_, mesh.uv[a]);
    wanted += 0.5 * (p[c] - p[a]).cross(p[d] - p[b]).norm() / (along * across);
  }
  return is_wasteful(static_cast<double>(mesh.quads.size()), wanted, static_cast<double>(mesh.nodes.size()),
                     most);
}

}  // namespace quadrille
