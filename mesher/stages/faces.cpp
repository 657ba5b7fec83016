/// Rounds of meshing, last resorts, and sliding.

#include "mesher/stages/stages.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/place_text.hpp"
#include "mesher/shell/last_resort.hpp"
#include "mesher/shell/node_sliding.hpp"

namespace quadrille {

namespace {

/// How far nodes may leave a face that has no mesh with them on it: the least size, or the tolerance of the
/// file there.
double reach_of(const Prepared& prepared, FaceId face) {
  const CadFace& source = prepared.shape.faces[face];
  double reach = std::max(prepared.limits.size_min, source.tolerance);
  for (const EdgeId edge : source.edges()) reach = std::max(reach, prepared.shape.edges[edge].tolerance);
  return reach;
}

void mesh_faces_left(const Run& run, Boundary& boundary, Faces& faces) {
  const MeshOptions& options = run.prepared.options;
  for_each_face_left(run, boundary, faces, Stage::mesh, 0, [&](FaceId face) {
    FaceRecord& record = faces.records[face];
    if (!boundary.charts[face]) throw FaceProblem(*record.problem);  // no remedy within the rounds
    ExecutionContext share(run.context);
    // The limit does not apply to a face that is meshed again only because of its neighbors' remedies.
    if (record.first_work > 0 && record.before)
      share.limit_work(std::max<std::int64_t>(1, record.share() - record.work));
    // Leave time for the other faces.
    if (run.is_limited()) share.limit_time(0.5 * run.context.seconds_left());
    const auto start = std::chrono::steady_clock::now();
    const auto count = [&] {
      record.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      record.work += share.work();
      ++record.attempts;
      if (record.first_work == 0) record.first_work = share.work();
    };
    try {
      record.recipe.leaves_surface = record.recipe.leaves_surface && !options.strict;
      record.recipe.reach = reach_of(run.prepared, face);
      faces.meshes[face] = mesh_face(run.prepared.shape, face, *boundary.charts[face], boundary.nodes,
                                     run.field, options, record.recipe, share);
    } catch (...) {
      count();
      throw;
    }
    boundary.charts[face].reset();
    count();
  });
}

/// Meshes the faces for which no remedy is left with nodes off their surfaces. \param edges_too their edges
/// too \return whether some still have no mesh, and there is time
bool leave_surfaces(const Run& run, Boundary& boundary, Faces& faces, bool edges_too) {
  const CadShape& shape = run.prepared.shape;
  bool any = false;
  for (const FaceId face : faces.records.ids()) {
    FaceRecord& record = faces.records[face];
    auto& mesh = faces.meshes[face];
    if (!record.problem || mesh || record.problem->cause() == Cause::out_of_time) continue;
    const double reach = reach_of(run.prepared, face);
    bool left = false;
    const auto leave = [&] {
      mesh = mesh_off_surface(shape, *record.problem, boundary.nodes, run.field, reach, edges_too,
                              run.prepared.options, run.context);
      left = !edges_too || unfold_with_edges(shape, face, reach, boundary.nodes, faces.meshes, run.context);
    };
    bool done = true;
    try {
      done = run.in_time(leave);
    } catch (const FaceProblem&) {
      any = true;  // the first problem is the one to report
      continue;
    }
    if (!left) mesh.reset();
    if (!done) return false;
    any |= !left;
    if (!left) continue;
    record.history.push_back(
        fmt::format("{}: nodes off its {}", record.problem->what(), edges_too ? "edges" : "surface"));
    record.problem.reset();
  }
  return any && run.may_go_on();
}

void mesh_in_rounds(const Run& run, Boundary& boundary, Faces& faces) {
  for (int meshed = 0; meshed < FaceRecord::most_attempts; ++meshed) {
    if (!settle(run, boundary, faces, meshed > 0)) return;
    mesh_faces_left(run, boundary, faces);
    if (!treat(run.prepared, boundary, faces)) return;
  }
}

/// Adds a hint to the problem of each face that is far smaller than the elements: it can be left out.
void explain_problems(const Prepared& prepared, Faces& faces) {
  constexpr double tiny = 0.5;
  for (const FaceId face : faces.records.ids()) {
    auto& problem = faces.records[face].problem;
    const double longest = longest_edge(prepared.shape, face);
    if (!problem || longest > tiny * prepared.limits.largest) continue;
    problem.emplace(problem->cause(), face,
                    fmt::format("{}; its longest edge is {}: `merge_tiny` {} leaves it out", problem->what(),
                                number_text(longest), number_text(1.1 * longest)));
  }
}

/// With options.partial and a time limit, undoes the sliding if there is no time for all of it. \return the
/// edges that quads cross
std::vector<EdgeId> slide(const Run& run, BoundaryNodes& nodes, FaceMeshes& meshes) {
  const auto before = run.is_limited() ? std::optional(std::pair(nodes, meshes)) : std::nullopt;
  std::vector<EdgeId> crossed;
  const bool done = run.in_time([&] {
    if (before) run.context.check();
    crossed = slide_nodes(run.prepared.shape, nodes, meshes, run.prepared.protection.own_nodes,
                          run.prepared.options.improve, run.context);
  });
  if (!done && before) std::tie(nodes, meshes) = *before;
  return crossed;
}

}  // namespace

std::vector<EdgeId> mesh_faces(const Run& run, Boundary& boundary, Faces& faces) {
  const MeshOptions& options = run.prepared.options;
  mesh_in_rounds(run, boundary, faces);
  if (!options.strict) {
    const CadShape& shape = run.prepared.shape;
    if (leave_surfaces(run, boundary, faces, false) && undo_remedies(shape, boundary, faces))
      run.in_time([&] {
        sample(run, boundary, faces);
        mesh_faces_left(run, boundary, faces);
        leave_surfaces(run, boundary, faces, false);
      });
    leave_surfaces(run, boundary, faces, true);
  }
  explain_problems(run.prepared, faces);
  const bool none =
      std::none_of(faces.meshes.begin(), faces.meshes.end(), [](const auto& m) { return m.has_value(); });
  for (const FaceRecord& record : faces.records)
    if (record.problem && (none || !options.partial)) throw FaceProblem(*record.problem);
  if (none)
    throw failure("size_min",
                  "all faces are far smaller than the minimum size: reduce it, or use `keep_features`");
  return slide(run, boundary.nodes, faces.meshes);
}

}  // namespace quadrille
