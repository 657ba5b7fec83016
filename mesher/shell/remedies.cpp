/// Rows of causes and remedies, in the order in which they are tried.

#include "mesher/shell/remedies.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include <fmt/format.h>

namespace quadrille {

namespace {

struct Case {
  const CadShape& shape;
  FaceId face;
  const FaceProblem& problem;
  FaceRecord& record;
  SamplingPlan& plan;
};

/// Changes the recipe or the plan. \return false if it would change nothing.
using Remedy = bool (*)(Case& job);

bool finer_there(Case& job) {
  const auto& parts = job.problem.stretches;
  if (parts.empty()) return false;
  auto& finer = job.plan.finer;
  finer.insert(finer.end(), parts.begin(), parts.end());
  job.record.recipe = {job.record.recipe.chart};
  return true;
}

/// Doubles the fineness of segments and points on the whole face, whose curvature is too much for its size.
/// Where another chart was tried and is none, in the face's own one.
bool twice_as_fine(Case& job) {
  SamplingPlan& plan = job.plan;
  const bool is_inverted = job.problem.cause() == Cause::inverted;
  if (!is_inverted && job.record.recipe.chart == ChartKind::own) return false;
  job.record.recipe = {.chart = is_inverted ? job.record.recipe.chart : ChartKind::own,
                       .fineness = 2 * job.record.recipe.fineness,
                       .leaves_surface = job.record.recipe.leaves_surface};
  for (const EdgeId edge : job.shape.faces[job.face].edges())
    plan.factor[edge] = std::max(plan.factor[edge], job.record.recipe.fineness);
  return true;
}

bool without_clean_up(Case& job) {
  if (!job.record.recipe.clean_up) return false;
  job.record.recipe.mapped = job.record.recipe.clean_up = false;
  return true;
}

bool denser_points(Case& job) {
  job.record.recipe = {.chart = job.record.recipe.chart, .refusal = 0.6};
  return true;
}

bool off_the_surface(Case& job) {
  job.record.recipe = {.chart = job.record.recipe.chart, .leaves_surface = true};
  return true;
}

bool along_chord(Case& job) {
  bool any = false;
  for (const EdgeId edge : job.problem.edges) {
    char& ignore = job.plan.ignore_curvature[edge];
    any |= ignore == 0;
    ignore = 1;
  }
  if (any) job.record.recipe.chart = ChartKind::own;
  return any;
}

template <ChartKind chart>
bool in_chart(Case& job) {
  job.record.recipe = {.chart = chart, .leaves_surface = job.record.recipe.leaves_surface};
  return true;
}

constexpr unsigned any_of(std::initializer_list<Cause> causes) {
  unsigned bits = 0;
  for (const Cause cause : causes) bits |= 1U << static_cast<unsigned>(cause);
  return bits;
}

/// For faces where meshing with quads of the final size failed (Strategy::direct).
bool by_subdivision(Case& job) {
  char& subdivided = job.plan.subdivided[job.face];
  if (subdivided != 0) return false;
  subdivided = 1;
  job.record.looks_at_gaps = 0;
  job.record.first_work = 0;
  return true;
}

struct Row {
  unsigned causes;
  const char* name;
  int times;
  Remedy apply;
};

/// The remedies for each cause, the least intrusive first.
constexpr std::array table{
    Row{any_of({Cause::inverted, Cause::odd_boundary, Cause::no_mesh}), "by subdivision", 1, by_subdivision},
    Row{any_of({Cause::narrow_gaps}), "finer segments there", FaceRecord::most_looks, finer_there},
    Row{any_of({Cause::coarse_segments}), "finer segments there", 4, finer_there},
    Row{any_of({Cause::looped_edge}), "nodes along the chord of that edge", 1, along_chord},
    Row{any_of({Cause::inverted}), "without clean-up", 1, without_clean_up},
    Row{any_of({Cause::inverted, Cause::no_mesh}), "denser points", 1, denser_points},
    Row{any_of({Cause::inverted}), "nodes of inverted quads off the surface", 1, off_the_surface},
    Row{any_of({Cause::stray_curves, Cause::crossing_curves, Cause::unusable_boundary, Cause::no_mesh}),
        "parametric curves recreated by projection", 1, in_chart<ChartKind::new_curves>},
    Row{any_of({Cause::stray_curves, Cause::crossing_curves, Cause::looped_edge, Cause::unusable_boundary,
                Cause::no_mesh, Cause::inverted}),
        "seen from above", 1, in_chart<ChartKind::view>},
    Row{any_of({Cause::stray_curves, Cause::crossing_curves, Cause::unusable_boundary, Cause::no_mesh,
                Cause::inverted}),
        "the whole face twice as fine", 3, twice_as_fine},
};

}  // namespace

double longest_edge(const CadShape& shape, FaceId face) {
  double longest = 0;
  for (const EdgeId edge : shape.faces[face].edges()) longest = std::max(longest, shape.edges[edge].length);
  return longest;
}

bool apply_remedy(const CadShape& shape, const FaceProblem& problem, FaceRecord& record, SamplingPlan& plan) {
  if (record.attempts >= FaceRecord::most_attempts) return false;
  record.tried.resize(table.size(), 0);
  Case job{shape, problem.face(), problem, record, plan};
  for (std::size_t row = 0; row < table.size(); ++row) {
    const bool fits = (table[row].causes >> static_cast<unsigned>(problem.cause()) & 1U) != 0;
    if (!fits || record.tried[row] == table[row].times || !table[row].apply(job)) continue;
    ++record.tried[row];
    record.history.push_back(fmt::format("{}: {}", problem.what(), table[row].name));
    return true;
  }
  return false;
}

}  // namespace quadrille
