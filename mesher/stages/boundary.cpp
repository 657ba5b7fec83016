/// Samples edges in rounds: faces whose boundary crosses itself or is crowded change the plan.

#include "mesher/stages/stages.hpp"

#include <Standard_Failure.hxx>

#include <algorithm>
#include <atomic>
#include <utility>

#include <fmt/format.h>

#include "geometry/cad/parallel_ids.hpp"
#include "mesher/faces/boundary_crossings.hpp"

namespace quadrille {

bool Run::in_time(const std::function<void()>& work) const {
  try {
    work();
    return true;
  } catch (const Error& error) {
    if (!prepared.options.partial || error.subject() != ExecutionContext::time_subject) throw;
    return false;
  }
}

namespace {

/// The faces, sorted by decreasing number of segments on their boundary.
std::vector<FaceId> longest_first(const CadShape& shape, const BoundaryNodes& nodes) {
  IdVector<FaceId, int> segments(shape.faces.size());
  std::vector<FaceId> order;
  for (const FaceId face : segments.ids()) {
    order.push_back(face);
    for (const EdgeId edge : shape.faces[face].edges()) segments[face] += nodes.edges[edge].segments();
  }
  std::stable_sort(order.begin(), order.end(), [&](FaceId a, FaceId b) { return segments[a] > segments[b]; });
  return order;
}

/// \return the problem of a face that ended with this error: its share of work or time may be used up.
/// Throws the error on if it ends the whole run.
FaceProblem problem_of(const Run& run, FaceId face, const FaceRecord& record, const Error& error) {
  if (error.subject() == ExecutionContext::work_subject)
    return {Cause::out_of_work, face,
            fmt::format("{}; it still fails after {} times the effort of the first attempt",
                        record.before->what(), FaceRecord::most_work)};
  if (error.subject() == ExecutionContext::time_subject) {
    if (!run.prepared.options.partial) throw Error(error);
    return {Cause::out_of_time, face,
            fmt::format("Face{} was not finished within its share of the time limit of {:g} s", face.number(),
                        run.context.time_limit())};
  }
  const bool is_named = !error.subject().empty();
  return {Cause::no_mesh, face,
          is_named ? error.what() : fmt::format("Face{}: {}", face.number(), error.what())};
}

/// What nodes of the last sampling became in a new one.
class Renumbering {
 public:
  Renumbering(const BoundaryNodes& before, const BoundaryNodes& now)
      : before_(before), now_(now), numbers_(before.points.size(), none), same_(now.edges.size()) {
    for (const EdgeId i : same_.ids()) {
      const auto &old = before.edges[i], &edge = now.edges[i];
      same_[i] = old.parameters == edge.parameters && old.borrows == edge.borrows;
      if (!same_[i]) continue;
      for (std::size_t k = 0; k < edge.nodes.size(); ++k) add(old.nodes[k], edge.nodes[k]);
    }
    for (const VertexId i : now.vertex_nodes.ids()) add(before.vertex_nodes[i], now.vertex_nodes[i]);
  }

  /// Whether the edges of a face have their nodes at the same parameters, and the face uses them in the same
  /// way.
  bool keeps(const CadShape& shape, FaceId face) const {
    const FacePlan &old = before_.plans[face], &plan = now_.plans[face];
    const std::vector<EdgeId> edges = shape.faces[face].edges();
    return old.stride == plan.stride && old.is_filled() == plan.is_filled() &&
           std::all_of(edges.begin(), edges.end(), [&](EdgeId edge) {
             return same_[edge] != 0 &&
                    before_.left_out.contains({face, edge}) == now_.left_out.contains({face, edge});
           });
  }

  /// \return whether the node is where it was.
  bool apply(int& node) const {
    node = numbers_[node];
    return node >= 0;
  }

 private:
  static constexpr int none = -1, several = -2;

  /// One node may have become several: the ends of an edge that was suppressed before and is kept now.
  void add(int before, int now) {
    if (before < 0 || now < 0) return;
    int& number = numbers_[before];
    const bool is_one = (number == none || number == now) && before_.points[before] == now_.points[now];
    number = is_one ? now : several;
  }

  const BoundaryNodes &before_, &now_;
  std::vector<int> numbers_;
  EdgeFlags same_;
};

/// Keeps the meshes and charts of faces whose boundary is unchanged, with the new numbers of its nodes.
void keep_unchanged(const CadShape& shape, const BoundaryNodes& nodes, Boundary& boundary, Faces& faces) {
  if (boundary.nodes.edges.empty()) return;
  const Renumbering renumbering(boundary.nodes, nodes);
  for (const FaceId face : faces.meshes.ids()) {
    FaceRecord& record = faces.records[face];
    auto& mesh = faces.meshes[face];
    auto& chart = boundary.charts[face];
    bool keep = boundary.meshed[face] && renumbering.keeps(shape, face);
    const auto renumber = [&](int& node) { keep = keep && renumbering.apply(node); };
    if (mesh) std::for_each(mesh->nodes.begin(), mesh->nodes.end(), renumber);
    if (chart) for_each_node(chart->boundary, renumber);
    if (!keep || (chart && chart->kind != record.recipe.chart)) chart.reset();
    if (keep || !mesh) continue;
    mesh.reset();
    record.given_up = false;  // its boundary is another one now: it is to be meshed again
  }
}

/// Throws FaceProblem if sides of the face cross or are too close. Grids need no room between their sides.
void check_sides(const CadShape& shape, FaceId face, const BoundaryNodes& nodes, const FaceChart& chart,
                 int& looks) {
  if (auto problem = crossing_problem(face, shape, chart.boundary, *chart.surface))
    throw FaceProblem(std::move(*problem));
  if (looks == FaceRecord::most_looks || nodes.plans[face].is_filled()) return;
  auto problem = crowding_problem(face, chart.boundary, *chart.surface);
  looks = problem ? looks + 1 : FaceRecord::most_looks;
  if (problem) throw FaceProblem(std::move(*problem));
}

/// \return false if nothing could be done for the face.
bool treat_face(const CadShape& shape, FaceId face, FaceRecord& record, Boundary& boundary) {
  // If not even a substitute chart can be made, the earlier problem is the one to report.
  if (record.recipe.chart != ChartKind::own && record.problem->cause() == Cause::unusable_boundary &&
      record.before)
    record.problem.emplace(Cause::unusable_boundary, face, record.before->what());
  record.before = record.problem;
  const FaceProblem& problem = *record.problem;
  if (problem.cause() != Cause::narrow_gaps) {
    if (boundary.suppressed.keep_around(face, problem.edges, boundary.plan.tiny)) {
      record.history.emplace_back("suppressed features restored");
      return true;
    }
  }
  record.given_up = !apply_remedy(shape, problem, record, boundary.plan);
  return !record.given_up;
}

}  // namespace

void for_each_face_left(const Run& run, const Boundary& boundary, Faces& faces, Stage stage,
                        double done_before, const std::function<void(FaceId)>& work) {
  const CadShape& shape = run.prepared.shape;
  std::vector<FaceId> order = longest_first(shape, boundary.nodes);
  // Small faces first, so that most faces are done when the time is over.
  if (run.is_limited()) std::reverse(order.begin(), order.end());
  std::atomic<int> done{0};
  const auto work_on = [&](FaceId face) {
    FaceRecord& record = faces.records[face];
    if (!boundary.meshed[face] || faces.meshes[face] || record.given_up) return;
    const auto fails = [&](const char* how, const char* why) {
      record.problem.emplace(Cause::no_mesh, face,
                             fmt::format("Face{} cannot be {} ({})", face.number(), how, why));
    };
    try {
      work(face);
      record.problem.reset();
    } catch (const FaceProblem& problem) {
      record.problem = problem;
    } catch (const Error& error) {
      if (error.kind() != Error::Kind::failure) throw;
      record.problem = problem_of(run, face, record, error);
    } catch (const std::bad_alloc&) {
      throw;  // not the face's fault
    } catch (const std::exception& problem) {
      fails("meshed", problem.what());
    } catch (const Standard_Failure& problem) {
      fails("evaluated", problem.GetMessageString());
    }
    const double share =
        (done.fetch_add(1, std::memory_order_relaxed) + 1) / static_cast<double>(shape.faces.size());
    run.in_time([&] { run.context.report(stage, done_before + (1 - done_before) * share); });
  };
  run.in_time([&] { run.context.report(stage, done_before); });
  for_each_in_order(order, work_on);
}

void sample(const Run& run, Boundary& boundary, Faces& faces) {
  const StageTimer timer(run.context, Stage::sample);
  const CadShape& shape = run.prepared.shape;
  BoundaryNodes nodes = sample_edges(shape, run.field, stride(run.prepared.options.strategy), boundary.meshed,
                                     boundary.plan, run.context, &boundary.tables);
  keep_unchanged(shape, nodes, boundary, faces);
  boundary.nodes = std::move(nodes);
  for_each_face_left(run, boundary, faces, Stage::sample, 0.5, [&](FaceId face) {
    if (boundary.charts[face]) return;
    FaceRecord& record = faces.records[face];
    ++record.charts;
    FaceChart chart = make_chart(shape, face, boundary.nodes, record.recipe.chart);
    check_sides(shape, face, boundary.nodes, chart, record.looks_at_gaps);
    boundary.charts[face] = std::move(chart);
  });
}

bool settle(const Run& run, Boundary& boundary, Faces& faces, bool again) {
  constexpr int most_rounds = 12;
  const auto go_on = [&] { sample(run, boundary, faces); };
  do {
    if (!again)
      go_on();
    else if (!run.may_go_on() || !run.in_time(go_on))
      return false;
  } while (boundary.rounds++ < most_rounds && treat(run.prepared, boundary, faces));
  return true;
}

bool treat(const Prepared& prepared, Boundary& boundary, Faces& faces) {
  bool any = false;
  for (const FaceId face : faces.records.ids()) {
    FaceRecord& record = faces.records[face];
    if (record.problem && !record.given_up) any |= treat_face(prepared.shape, face, record, boundary);
  }
  if (!any) return false;
  boundary.meshed = prepared.leave_out_tiny(boundary.suppressed, boundary.plan);
  for (const FaceId face : faces.records.ids())
    if (!boundary.meshed[face]) faces.records[face].problem.reset();
  return true;
}

bool undo_remedies(const CadShape& shape, Boundary& boundary, Faces& faces) {
  bool any = false;
  EdgeFlags of_failed(shape.edges.size());
  for (const FaceId face : faces.records.ids()) {
    FaceRecord& record = faces.records[face];
    if (!record.problem || faces.meshes[face]) continue;
    any |= !record.history.empty();
    record.recipe = {};
    record.given_up = false;
    record.before.reset();
    for (const EdgeId edge : shape.faces[face].edges()) of_failed[edge] = 1;
  }
  for (const EdgeId edge : of_failed.ids())
    if (of_failed[edge]) boundary.plan.factor[edge] = 1;
  std::erase_if(boundary.plan.finer, [&](const EdgeStretch& part) { return of_failed[part.edge] != 0; });
  return any;
}

SettledBoundary settle_boundary(const CadModel& model, const MeshOptions& options,
                                ExecutionContext& context) {
  const Prepared prepared(model, options);
  SizingField field = sizes_for(prepared, context);
  Boundary boundary(prepared);
  Faces faces(prepared);
  settle({prepared, field, context}, boundary, faces, false);
  return {prepared.model, prepared.simple, std::move(field), std::move(boundary.nodes), boundary.meshed};
}

}  // namespace quadrille
