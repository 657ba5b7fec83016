/// Measures the share of quads outside the usual limits, the number of quads beside what the sizes request,
/// and their shapes.

#include "mesher/shell/face_judge.hpp"

#include <algorithm>

#include "mesher/faces/face_grid.hpp"
#include "mesher/mesh/criteria.hpp"
#include "mesher/quads/criteria_patch.hpp"

namespace quadrille {

namespace {

// Tuned on 57 parts as users have them, at sizes of a 20th, a 60th and a 150th of their diagonals.
/// A grid is kept without a look at other meshes up to this share of quads outside the limits.
constexpr double outside_of_grid = 0.02;
/// The share outside the limits in a grid must fall by this factor with another mesh.
constexpr double least_fall = 2;
/// Where a grid is wasteful (GridWaste), the share of quads outside the limits in another mesh.
constexpr double most_outside = 0.05;
/// Quads cut in four are replaced by quads of the final size if there are more than `few` and `too_many`
/// times those that the sizes request, or if their mean badness exceeds `poor` and falls by the factor
/// `better`.
constexpr std::size_t few = 200;
constexpr double too_many = 1.4, poor = 0.1, better = 0.6;

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
  for (const auto& quad : mesh.quads)
    sum += std::clamp(measure_objective(mesh.points, quad).value - fine, 0.0, worst_counted);
  return sum;
}

}  // namespace

bool FaceJudge::is_doubtful(const FaceMesh& grid, const FacePlan& plan) {
  outside_ = has_rows(grid) ? share_outside(grid) : 0;
  wasteful_ = !plan.has_divided_edge && wastes_quads(grid, GridWaste::wasteful);
  return wasteful_ || outside_ > outside_of_grid;
}

bool FaceJudge::replaces_grid(const FaceMesh& other, const FaceMesh& grid) const {
  const double left = share_outside(other);
  const double share = static_cast<double>(other.quads.size()) / static_cast<double>(grid.quads.size());
  if ((share < 1 ? 1 : least_fall) * left < outside_) return true;
  return wasteful_ && share < GridWaste::fewer && left <= std::max(outside_, most_outside / share);
}

bool FaceJudge::is_doubtful(const FaceMesh& cut) {
  cut_wastes_ = cut.quads.size() > few && wastes_quads(cut, too_many);
  return cut_wastes_ || badness(cut) >= poor * static_cast<double>(cut.quads.size());
}

bool FaceJudge::replaces_cut(const FaceMesh& direct, const FaceMesh& cut) const {
  return cut_wastes_ || badness(direct) < better * badness(cut);
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
