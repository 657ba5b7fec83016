#include "mesher/shell/remedies.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>

#include <fmt/format.h>

namespace quadrille {

namespace {

struct Case {
  const CadShape& shape;
  FaceId face;
  const FaceProblem& problem;
  double size;
  FaceRecord& record;
  EdgeTreatment& edges;
};

/// Changes the recipe or the plan. \return false if it would change nothing.
using Remedy = bool (*)(Case& patient);

bool finer_there(Case& patient) {
  const auto& parts = patient.problem.stretches;
  auto& finer = patient.edges.plan.finer;
  finer.insert(finer.end(), parts.begin(), parts.end());
  patient.record.recipe = {patient.record.recipe.chart};
  return !parts.empty();
}

/// Doubles the fineness of segments and points on the whole face: near poles and in narrow faces, more than
/// one place may be too coarse.
bool twice_as_fine(Case& patient) {
  SamplingPlan& plan = patient.edges.plan;
  std::set<EdgeId> edges;
  for (const CadWire& wire : patient.shape.faces[patient.face].wires) {
    for (const Coedge& coedge : wire.coedges) edges.insert(coedge.edge);
  }
  std::erase_if(plan.finer, [&](const EdgeStretch& part) { return edges.contains(part.edge); });
  patient.record.recipe = {.chart = patient.record.recipe.chart,
                           .fineness = 2 * patient.record.recipe.fineness};
  for (const EdgeId edge : edges)
    plan.factor[edge] = std::max(plan.factor[edge], patient.record.recipe.fineness);
  return true;
}

bool along_chord(Case& patient) {
  bool any = false;
  for (const EdgeId edge : patient.problem.edges) {
    char& bare = patient.edges.plan.bare[edge];
    any |= bare == 0;
    bare = 1;
  }
  patient.record.recipe.chart = ChartKind::own;
  return any;
}

/// For faces so small compared with the elements that one node can stand for them.
bool as_point(Case& patient) {
  constexpr double share = 0.2;  // of the default least size, an eighth of the size
  if (!(longest_edge(patient.shape, patient.face) < share * patient.size / 8)) return false;
  bool any = false;
  for (const CadWire& wire : patient.shape.faces[patient.face].wires) {
    for (const Coedge& coedge : wire.coedges) {
      char& collapse = patient.edges.collapse[coedge.edge];
      any |= collapse == 0;
      collapse = 1;
    }
  }
  return any;
}

bool with_curves_made_anew(Case& patient) {
  patient.record.recipe = {ChartKind::new_curves};
  return true;
}

bool seen_from_above(Case& patient) {
  patient.record.recipe = {ChartKind::view};
  return true;
}

bool denser_points(Case& patient) {
  patient.record.recipe = {
      .chart = patient.record.recipe.chart, .refusal = 0.6, .fineness = patient.record.recipe.fineness};
  return true;
}

bool without_clean_up(Case& patient) {
  if (!patient.record.recipe.clean_up) return false;
  patient.record.recipe.mapped = patient.record.recipe.clean_up = false;
  return true;
}

constexpr unsigned any_of(std::initializer_list<Cause> causes) {
  unsigned bits = 0;
  for (const Cause cause : causes) bits |= 1U << static_cast<unsigned>(cause);
  return bits;
}

/// For faces where meshing with quads of the final size failed (Strategy::direct).
bool by_subdivision(Case& patient) {
  char& subdivided = patient.edges.plan.subdivided[patient.face];
  if (subdivided != 0) return false;
  subdivided = 1;
  patient.record.looks_at_gaps = 0;
  patient.record.first_work = 0;
  return true;
}

struct Row {
  unsigned causes;
  const char* name;
  int times;
  Remedy apply;
};

bool nodes_where_they_were(Case& patient) {
  char& unaligned = patient.edges.plan.unaligned[patient.face];
  if (unaligned != 0) return false;
  unaligned = 1;
  return true;
}

/// The remedies for each cause, the least intrusive first.
constexpr std::array table{
    Row{any_of({Cause::inverted_inside, Cause::inverted_at_boundary, Cause::odd_boundary, Cause::no_mesh}),
        "by subdivision", 1, by_subdivision},
    Row{any_of({Cause::coarse_segments, Cause::looped_edge, Cause::crossing_curves}),
        "nodes not moved to face each other", 1, nodes_where_they_were},
    Row{any_of({Cause::narrow_gaps}), "finer segments there", FaceRecord::most_looks, finer_there},
    Row{any_of({Cause::coarse_segments}), "finer segments there", 4, finer_there},
    Row{any_of({Cause::looped_edge}), "nodes along the chord of that edge", 1, along_chord},
    Row{any_of({Cause::inverted_inside, Cause::inverted_at_boundary}), "without clean-up", 1,
        without_clean_up},
    Row{any_of({Cause::inverted_inside, Cause::no_mesh}), "denser points", 1, denser_points},
    Row{any_of({Cause::stray_curves, Cause::crossing_curves, Cause::unusable_boundary, Cause::no_mesh}),
        "parametric curves made anew", 1, with_curves_made_anew},
    Row{any_of({Cause::inverted_inside, Cause::inverted_at_boundary}), "finer segments there", 2,
        finer_there},
    Row{any_of({Cause::inverted_inside, Cause::inverted_at_boundary}), "the whole face twice as fine", 3,
        twice_as_fine},
    Row{any_of({Cause::stray_curves, Cause::crossing_curves, Cause::looped_edge, Cause::unusable_boundary,
                Cause::no_mesh, Cause::inverted_inside, Cause::inverted_at_boundary}),
        "seen from above", 1, seen_from_above},
    Row{any_of({Cause::coarse_segments, Cause::stray_curves, Cause::crossing_curves, Cause::looped_edge,
                Cause::unusable_boundary, Cause::no_mesh, Cause::inverted_inside,
                Cause::inverted_at_boundary}),
        "taken as a point", 1, as_point},
};

}  // namespace

double longest_edge(const CadShape& shape, FaceId face) {
  double longest = 0;
  for (const CadWire& wire : shape.faces[face].wires) {
    for (const Coedge& coedge : wire.coedges) longest = std::max(longest, shape.edges[coedge.edge].length);
  }
  return longest;
}

bool apply_remedy(const CadShape& shape, const FaceProblem& problem, double size, FaceRecord& record,
                  EdgeTreatment& edges) {
  if (record.attempts >= FaceRecord::most_attempts) return false;
  record.tried.resize(table.size(), 0);
  Case patient{shape, problem.face(), problem, size, record, edges};
  for (std::size_t row = 0; row < table.size(); ++row) {
    const bool fits = (table[row].causes >> static_cast<unsigned>(problem.cause()) & 1U) != 0;
    if (!fits || record.tried[row] == table[row].times || !table[row].apply(patient)) continue;
    ++record.tried[row];
    record.history.push_back(fmt::format("{}: {}", problem.what(), table[row].name));
    return true;
  }
  return false;
}

}  // namespace quadrille
