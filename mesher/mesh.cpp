/// The facade: model in, mesh out.

#include <Standard_Failure.hxx>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/place_text.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/parallel_ids.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "geometry/surfaces/stray_edges.hpp"
#include "mesher/boundary.hpp"
#include "mesher/edges/coplanar_faces.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/grid_rows.hpp"
#include "mesher/edges/hole_filling.hpp"
#include "mesher/edges/matching.hpp"
#include "mesher/edges/placed_nodes.hpp"
#include "mesher/edges/row_lines.hpp"
#include "mesher/edges/suppressed_features.hpp"
#include "mesher/faces/boundary_crossings.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/settings.hpp"
#include "mesher/shell/area_check.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "mesher/shell/last_resort.hpp"
#include "mesher/shell/matched_faces.hpp"
#include "mesher/shell/node_sliding.hpp"
#include "mesher/shell/poor_quads.hpp"
#include "mesher/shell/remedies.hpp"
#include "mesher/shell/shell_check.hpp"
#include "mesher/shell/size_fidelity.hpp"

namespace quadrille {

FaceFlags faces_used(const CadModel& model, const MeshOptions& options) {
  FaceFlags used(model.face_count(), options.faces.empty());
  for (const int face : options.faces) used[FaceId::from_number(face)] = 1;
  return used;
}

SimplifiedModel simplified(const CadModel& model, const MeshOptions& options, bool joins) {
  const FaceFlags used = faces_used(model, options);
  SimplifiedModel result = fill_holes(model, used, options.sizing, options.fill_holes);
  if (joins && !options.keep_features && options.faces.empty())
    join_coplanar_faces(result, used, options.sizing, size_limits(model, options.sizing));
  return result;
}

namespace {

class Job {
 public:
  /// \param divides divide edges at slivers: edges and vertices then differ from the model's
  /// \param joins coplanar faces may be joined
  Job(const CadModel& model, const MeshOptions& options, ExecutionContext& context, bool divides = true,
      bool joins = true)
      : options_(with_matches_kept(options)),
        vertices_(model.vertex_count()),
        simplified_(simplified(model, options_, joins)),
        used_(simplified_.left(faces_used(model, options))),
        limits_(size_limits(model, options.sizing)),
        placed_(divides ? place_nodes(simplified_.model.shape(), used_, options.sizing, limits_.largest)
                        : PlacedNodes()),
        model_(divides ? divided(placed_.shape ? CadModel(placed_.shape) : simplified_.model, used_, options)
                       : simplified_.model),
        shape_(model_.shape()),
        matches_(find_matches(shape_, options.sizing.matches, used_)),
        context_(context),
        plan_(shape_),
        to_tips_(shape_.faces.size()),
        meshes_(shape_.faces.size()),
        problems_(shape_.faces.size()),
        problems_before_(shape_.faces.size()),
        records_(shape_.faces.size()),
        asked_(used_),
        suppressed_(shape_, asked_, suppression_reach(limits_, options), edges_that_stay(), held_vertices()) {
    constexpr double far_below = 0.02;
    plan_.shortest_segment = far_below * limits_.size_min;
    if (options_.strategy == Strategy::subdivide) plan_.subdivided.assign(shape_.faces.size(), 1);
    plan_.matched = matches_.edges;
    plan_.prescribed = prescribed_edges(shape_, options.sizing, limits_.largest);
    leave_out_tiny();
    find_rows();
  }

  /// Suppressed features request no sizes. Throws Error (usage) if the sizes exceed the budget.
  SizingField build_field() {
    const StageTimer timer(context_, Stage::size);
    SizingOptions sizing = options_.sizing;
    sizing.budget.bytes_an_element = Budget::bytes_an_element_of_order(options_.order);
    if (options_.force) sizing.budget = Budget::unlimited();
    for (const auto& [vertex, layers] : plan_.rows.steps)
      sizing.layers.vertices.emplace(vertex.number(), layers);
    const ElementBudget budget(model_, sizing, asked_, context_);
    SizingField field =
        SizingField::build(model_, sizing, context_,
                           {suppressed_.edges(), plan_.tiny.merged_faces, rows_.divided, rows_.layered});
    budget.check(field);
    return field;
  }

  /// Samples the edges until no remedy is left for a face boundary that crosses itself or is crowded.
  SettledBoundary boundary(SizingField field) {
    settle(field, false);
    return {std::move(field), std::move(nodes_), used_};
  }

  ShellMesh run(const SizingField& field) {
    mesh_in_rounds(field);
    if (!options_.strict && leave_surfaces(field) && undo_remedies()) {
      in_time([&] {
        sample(field);
        find_charts();
        mesh_faces(field);
        leave_surfaces(field);
      });
    }
    if (!options_.strict) in_time([&] { leave_edges(field); });
    advise_on_tiny_faces();
    note_failed_partners();
    const bool none =
        std::none_of(meshes_.begin(), meshes_.end(), [](const auto& m) { return m.has_value(); });
    if (!options_.partial || none) throw_first_problem();
    if (none)
      throw failure("size_min",
                    "all faces are far smaller than the minimum size: reduce it, or use `keep_features`");
    slide();
    copy_faces(shape_, matches_, nodes_, meshes_);
    // The faces meshed so far are delivered, even past the time limit.
    if (options_.partial) context_.lift_time_limit();
    ShellNumbering numbering;
    ShellMesh result = assemble(CadGeometry(shape_), nodes_, meshes_, options_.order, context_, &numbering);
    list_matches(matches_, nodes_, numbering, result);
    result.faces = statuses();
    result.suppressed_features = list_suppressed();
    result.kept = list_kept();
    for (const auto& [edge, why] : plan_.rows.without)
      result.warnings.push_back(fmt::format("`layers` on Edge{} give sizes but no rows: {}", edge, why));
    result.filled_holes = simplified_.holes;
    result.crossed_edges = simplified_.inner;
    for (const EdgeId id : crossed_) {
      constexpr int pieces = 32;
      const CadEdge& edge = shape_.edges[id];
      result.crossed_edges.push_back({edge.number,
                                      {edge.faces.front().number(), edge.faces.back().number()},
                                      points_along(edge, pieces)});
    }
    std::sort(result.crossed_edges.begin(), result.crossed_edges.end());
    result.crossed_edges.erase(std::unique(result.crossed_edges.begin(), result.crossed_edges.end()),
                               result.crossed_edges.end());
    name_placed_nodes(result);
    result.size_min = limits_.size_min;
    if (limits_.least < limits_.size_min) result.finer_quads = finer_quads(result, field);
    result.poor_quads = poor_quads(shape_, result);
    return result;
  }

  SmallFeatures small_features() const {
    SmallFeatures result{list_suppressed(), {}, list_kept(), simplified_.holes};
    for (const FaceId face : asked_.ids())
      if (asked_[face] && plan_.tiny.merged_faces[face]) result.faces.push_back(face.number());
    return result;
  }

  std::set<int> uncrossed;  ///< numbers of edges that no quad may cross

 private:
  /// Options by which matched faces and edges keep nodes of their own.
  static MeshOptions with_matches_kept(MeshOptions options) {
    SizingOptions& sizing = options.sizing;
    for (const MatchedPair& pair : sizing.matches)
      (pair.dimension == 2 ? sizing.kept_faces : sizing.kept_edges).insert({pair.first, pair.second});
    return options;
  }

  /// The model with edges divided at slivers, except around edges whose nodes users prescribe or match.
  static CadModel divided(const CadModel& model, FaceFlags used, const MeshOptions& options) {
    const SizingOptions& sizing = options.sizing;
    const CadShape& source = model.shape();
    const auto leave = [&](EdgeId edge) {
      for (const FaceId face : source.edges[edge].faces) used[face] = 0;
    };
    for (const EdgeId id : source.edges.ids()) {
      const int number = source.edges[id].number;
      if (sizing.spacings.contains(number) || sizing.layers.edges.contains(number)) leave(id);
    }
    for (const MatchedPair& pair : sizing.matches)
      for (const int number : {pair.first, pair.second}) {
        if (pair.dimension == 1) leave(EdgeId::from_number(number));
        if (pair.dimension == 1) continue;
        for (const CadWire& wire : source.faces[FaceId::from_number(number)].wires)
          for (const Coedge& coedge : wire.coedges) leave(coedge.edge);
      }
    const double reach = suppression_reach(size_limits(model, options.sizing), options);
    const auto shape = divided_at_slivers(source, used, reach);
    return shape ? CadModel(shape) : model;
  }

  static constexpr int most_chart_rounds = 12;

  bool is_limited() const { return options_.partial && context_.has_time_limit(); }

  /// \return false if the time limit ended the work and, with options.partial, what was done before counts.
  template <class Work>
  bool in_time(Work&& work) const {
    try {
      work();
      return true;
    } catch (const Error& error) {
      if (!options_.partial || error.subject() != ExecutionContext::time_subject) throw;
      return false;
    }
  }

  /// 1 = users name the edge, or a face at it: it keeps nodes of its own.
  EdgeFlags named_edges() const {
    const SizingOptions& sizing = options_.sizing;
    EdgeFlags result(shape_.edges.size(), options_.keep_features ? 1 : 0);
    for (const EdgeId id : result.ids()) {
      const CadEdge& edge = shape_.edges[id];
      result[id] |= is_kept(edge) || ends_at_placed(edge) || sizing.names_edge(edge.number) ||
                    uncrossed.contains(edge.number);
    }
    return result;
  }

  bool ends_at_placed(const CadEdge& edge) const {
    return std::any_of(placed_.nodes.begin(), placed_.nodes.end(), [&](const PlacedNode& node) {
      return node.vertex == edge.first_vertex || node.vertex == edge.last_vertex;
    });
  }

  /// Whether an edge of the face has the same nodes as another one.
  bool touches_match(FaceId face) const {
    for (const CadWire& wire : shape_.faces[face].wires)
      for (const Coedge& coedge : wire.coedges)
        if (matches_.matched_edges[coedge.edge]) return true;
    return false;
  }

  /// The vertices that share their nodes with no other.
  std::vector<VertexId> held_vertices() const {
    std::vector<VertexId> result = matches_.vertices(shape_);
    for (const PlacedNode& node : placed_.nodes) result.push_back(node.vertex);
    return result;
  }

  /// Lists the nodes at the places that users chose, and drops the corners at other vertices that are not the
  /// model's. Throws Error (failure) for a place where the mesh has no node, unless its faces are left out.
  void name_placed_nodes(ShellMesh& mesh) const {
    std::map<int, int> nodes;  // by vertex number
    for (const ShellMesh::Corner& corner : mesh.corners) nodes[corner.vertex] = corner.node;
    std::set<int> added;
    for (const auto& [name, vertex] : placed_.nodes) {
      const auto found = nodes.find(vertex.number());
      const bool is_there = found != nodes.end() && mesh.points[found->second] == shape_.vertices[vertex];
      if (!is_there && !options_.partial)
        throw failure("nodes_at",
                      fmt::format("`nodes_at` {} at {} got no node, because small features around it are "
                                  "suppressed: use `keep_features`, or a smaller size there",
                                  name, place_text(shape_.vertices[vertex])));
      const bool is_added = vertex.number() > vertices_;
      mesh.placed_nodes.push_back({name, is_there ? vertex.number() : 0, is_added});
      if (is_there && is_added) added.insert(vertex.number());
    }
    std::erase_if(mesh.corners, [&](const auto& corner) {
      return corner.vertex > vertices_ && !added.contains(corner.vertex);
    });
  }

  /// 1 = the edge must not become a point.
  EdgeFlags edges_that_stay() const {
    EdgeFlags result = edges_below_size_min(model_, options_.sizing, limits_);
    for (const EdgeId id : result.ids()) result[id] |= is_kept(shape_.edges[id]);
    return result;
  }

  /// Whether `keep` names the edge or a face at it.
  bool is_kept(const CadEdge& edge) const {
    return options_.sizing.kept_edges.contains(edge.number) ||
           std::any_of(edge.faces.begin(), edge.faces.end(),
                       [&](FaceId face) { return options_.sizing.kept_faces.contains(face.number()); });
  }

  /// With options.partial and a time limit, undoes the sliding if there is no time for all of it.
  void slide() {
    const EdgeFlags kept = named_edges();
    const auto move = [&] {
      crossed_ = slide_nodes(shape_, nodes_, meshes_, kept, options_.improve, context_);
    };
    if (!is_limited()) return move();
    const BoundaryNodes nodes = nodes_;
    const FaceMeshes meshes = meshes_;
    const bool done = in_time([&] {
      context_.check();
      move();
    });
    if (done) return;
    nodes_ = nodes;
    meshes_ = meshes;
  }

  /// \param again whether faces were meshed before. \return false if no time is left for another round.
  bool settle(const SizingField& field, bool again) {
    do {
      if (again && !may_go_on()) return false;
      if (!again)
        sample(field);
      else if (!in_time([&] { sample(field); }))
        return false;
      find_charts();
    } while (chart_rounds_++ < most_chart_rounds && treat());
    return true;
  }

  void mesh_in_rounds(const SizingField& field) {
    int meshed = 0;
    for (bool changed = true; changed && meshed < FaceRecord::most_attempts; ++meshed) {
      if (!settle(field, meshed > 0)) return;
      mesh_faces(field);
      changed = treat();
    }
  }

  /// Meshes the faces for which no remedy is left with nodes off their surfaces. \return whether some still
  /// have no mesh.
  bool leave_surfaces(const SizingField& field) {
    bool any = false;
    for (const FaceId face : problems_.ids()) {
      const auto problem = problems_[face];
      if (!problem || meshes_[face] || problem->cause() == Cause::out_of_time) continue;
      try {
        const bool done = in_time([&] {
          meshes_[face] =
              mesh_off_surface(shape_, *problem, nodes_, field, reach_of(face), false, options_, context_);
        });
        if (!done) return false;
      } catch (const FaceProblem&) {
        any = true;
        continue;  // the first problem is the one to report
      }
      problems_[face].reset();
      records_[face].history.push_back(fmt::format("{}: nodes off its surface", problem->what()));
    }
    return any && may_go_on();
  }

  /// How far nodes may leave a face that has no mesh with them on it: the least size, or the tolerance of the
  /// file there.
  double reach_of(FaceId face) const {
    double reach = std::max(limits_.size_min, shape_.faces[face].tolerance);
    for (const CadWire& wire : shape_.faces[face].wires)
      for (const Coedge& coedge : wire.coedges) reach = std::max(reach, shape_.edges[coedge.edge].tolerance);
    return reach;
  }

  /// Meshes the faces that still have no mesh with nodes off their edges.
  void leave_edges(const SizingField& field) {
    for (const FaceId face : problems_.ids()) {
      const auto problem = problems_[face];
      if (!problem || meshes_[face] || problem->cause() == Cause::out_of_time) continue;
      try {
        meshes_[face] =
            mesh_off_surface(shape_, *problem, nodes_, field, reach_of(face), true, options_, context_);
      } catch (const FaceProblem&) {
        continue;  // the first problem is the one to report
      }
      if (!unfold_with_edges(shape_, face, reach_of(face), nodes_, meshes_, context_)) {
        meshes_[face].reset();
        continue;
      }
      problems_[face].reset();
      records_[face].history.push_back(fmt::format("{}: nodes off its edges", problem->what()));
    }
  }

  /// Takes back the finer segments that did not help the faces that have no mesh. \return whether there were
  /// any.
  bool undo_remedies() {
    bool any = false;
    EdgeFlags of_failed(shape_.edges.size());
    for (const FaceId face : problems_.ids()) {
      if (!problems_[face] || meshes_[face]) continue;
      any |= !records_[face].history.empty();
      records_[face].recipe = {};
      records_[face].given_up = false;
      problems_before_[face].reset();
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) of_failed[coedge.edge] = 1;
      }
    }
    for (const EdgeId edge : of_failed.ids()) {
      if (of_failed[edge]) plan_.factor[edge] = 1;
    }
    std::erase_if(plan_.finer, [&](const EdgeStretch& part) { return of_failed[part.edge] != 0; });
    return any;
  }

  /// Whether there is time for another round. With options.partial the last tenth of the time limit is kept
  /// for the sampling of a round to finish.
  bool may_go_on() const {
    return !options_.partial || context_.seconds_left() > 0.1 * context_.time_limit();
  }

  /// Finds the rows for prescribed divisions and layers: in grids if possible, else along lines of edges.
  void find_rows() {
    const SizingOptions& sizing = options_.sizing;
    if (sizing.spacings.empty() && sizing.layers.edges.empty()) return;
    IdVector<EdgeId, double> wanted;
    for (const CadEdge& edge : shape_.edges)
      wanted.push_back(edge.length / (limits_.largest * stride(options_.strategy)));
    const auto sides = find_face_sides(shape_, used_, plan_.tiny, wanted);
    rows_ = find_grid_rows(shape_, sides, std::move(plan_.prescribed), sizing, limits_.largest);
    plan_.prescribed = rows_.prescribed;
    plan_.rows = find_row_lines(shape_, sides, used_, plan_.tiny, plan_.prescribed, sizing.layers);
    for (const EdgeId edge : shape_.edges.ids()) rows_.layered[edge] |= plan_.rows.along[edge];
  }

  void leave_out_tiny() {
    TinyFeatures& tiny = plan_.tiny;
    tiny = suppressed_.find(options_.merge_tiny);
    for (const FaceId face : simplified_.gone.ids()) tiny.merged_faces[face] |= simplified_.gone[face];
    for (const FaceId face : used_.ids()) {
      used_[face] = asked_[face] && !tiny.merged_faces[face];
      if (!used_[face]) problems_[face].reset();
    }
    FaceFlags may_end = used_;
    for (const FaceId face : may_end.ids())
      may_end[face] = used_[face] && !to_tips_[face] && !touches_match(face);
    plan_.tips = find_tips(shape_, may_end, tiny, suppression_reach(limits_, options_));
  }

  static double suppression_reach(const SizeLimits& limits, const MeshOptions& options) {
    constexpr double far_below = 0.5;
    if (options.keep_features) return 0;
    return options.reach > 0 ? options.reach : far_below * limits.size_min;
  }

  void sample(const SizingField& field) {
    const StageTimer timer(context_, Stage::sample);
    BoundaryNodes nodes =
        sample_edges(shape_, field, stride(options_.strategy), used_, plan_, context_, &tables_);
    keep_meshes(nodes);
    nodes_ = std::move(nodes);
  }

  /// Keeps the meshes of faces whose boundary is unchanged, and renumbers their boundary nodes.
  void keep_meshes(const BoundaryNodes& nodes) {
    if (nodes_.edges.empty()) return;
    constexpr int none = -1, several = -2;
    std::vector<int> renumbered(nodes_.points.size(), none);
    // One node may have become several: the ends of an edge that was suppressed before and is kept now.
    const auto renumber = [&](int before, int now) {
      if (before < 0 || now < 0) return;
      int& number = renumbered[before];
      number = number == none || number == now ? now : several;
    };
    EdgeFlags same(nodes.edges.size());
    for (const EdgeId i : same.ids()) {
      const auto &before = nodes_.edges[i], &now = nodes.edges[i];
      same[i] = before.parameters == now.parameters;
      if (!same[i]) continue;
      for (std::size_t k = 0; k < now.nodes.size(); ++k) renumber(before.nodes[k], now.nodes[k]);
    }
    for (const VertexId i : nodes.vertex_nodes.ids()) renumber(nodes_.vertex_nodes[i], nodes.vertex_nodes[i]);
    for (const FaceId face : meshes_.ids()) {
      if (!meshes_[face]) continue;
      bool keep = used_[face];
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) keep = keep && same[coedge.edge];
      }
      for (int& node : meshes_[face]->nodes) {
        node = renumbered[node];
        keep = keep && node >= 0 && node < static_cast<int>(nodes.points.size());
      }
      if (keep) continue;
      meshes_[face].reset();
      records_[face].given_up = false;  // its boundary is another one now: it is to be meshed again
    }
  }

  void find_charts() {
    const StageTimer timer(context_, Stage::sample);
    charts_.assign(shape_.faces.size(), std::nullopt);
    for_each_face_left(Stage::sample, 0.5, [&](FaceId face) {
      FaceChart chart = make_chart(shape_, face, nodes_, records_[face].recipe.chart);
      if (auto problem = crossing_problem(face, shape_, chart.boundary, *chart.surface))
        throw FaceProblem(std::move(*problem));
      widen_gaps(face, chart);
      charts_[face] = std::move(chart);
    });
  }

  /// Throws FaceProblem if sides of the face are too close. Grids need no room between their sides.
  void widen_gaps(FaceId face, const FaceChart& chart) {
    int& looks = records_[face].looks_at_gaps;
    if (looks == FaceRecord::most_looks || nodes_.plans[face].is_filled) return;
    auto problem = crowding_problem(face, chart.boundary, *chart.surface);
    looks = problem ? looks + 1 : FaceRecord::most_looks;
    if (problem) throw FaceProblem(std::move(*problem));
  }

  void mesh_faces(const SizingField& field) {
    for_each_face_left(Stage::mesh, 0, [&](FaceId face) {
      if (!charts_[face]) throw FaceProblem(*problems_[face]);  // no remedy within the rounds
      FaceRecord& record = records_[face];
      const FaceChart chart = std::move(*charts_[face]);
      ExecutionContext share(context_);
      // The limit does not apply to a face that is meshed again only because of its neighbors' remedies.
      if (record.first_work > 0 && problems_before_[face])
        share.limit_work(std::max<std::int64_t>(1, record.share() - record.work));
      // Leave time for the other faces.
      if (is_limited()) share.limit_time(0.5 * context_.seconds_left());
      const auto start = std::chrono::steady_clock::now();
      const auto count = [&] {
        record.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        record.work += share.work();
        ++record.attempts;
        if (record.first_work == 0) record.first_work = share.work();
      };
      try {
        record.recipe.leaves_surface = record.recipe.leaves_surface && !options_.strict;
        record.recipe.reach = reach_of(face);
        meshes_[face] = mesh_face(shape_, face, chart, nodes_, field, options_, record.recipe, share);
      } catch (...) {
        count();
        throw;
      }
      count();
    });
  }

  /// \return the problem of a face whose share of work or time is used up. Rethrows what ends the whole run.
  FaceProblem share_problem(FaceId face, const Error& error) const {
    if (error.subject() == ExecutionContext::work_subject) {
      return {Cause::out_of_work, face,
              fmt::format("{}; it still fails after {} times the effort of the first attempt",
                          problems_before_[face]->what(), FaceRecord::most_work)};
    }
    if (!options_.partial) throw Error(error);
    return {Cause::out_of_time, face,
            fmt::format("Face{} was not finished within its share of the time limit of {:g} s", face.number(),
                        context_.time_limit())};
  }

  /// Runs `work` on each face that has no mesh yet, on all threads, and records failures as problems of the
  /// face. \param done_before fraction of the stage that was done before.
  template <class Work>
  void for_each_face_left(Stage stage, double done_before, Work&& work) {
    const int n = static_cast<int>(shape_.faces.size());
    std::vector<FaceId> order = longest_first();
    // Small faces first, so that most faces are done when the time is over.
    if (is_limited()) std::reverse(order.begin(), order.end());
    std::atomic<int> done{0};
    const auto work_on = [&](FaceId face) {
      if (!used_[face] || meshes_[face] || records_[face].given_up || matches_.copied_faces[face]) return;
      try {
        work(face);
        problems_[face].reset();
      } catch (const FaceProblem& problem) {
        problems_[face] = problem;
      } catch (const Error& error) {
        if (error.kind() != Error::Kind::failure) throw;
        if (error.subject() == ExecutionContext::time_subject ||
            error.subject() == ExecutionContext::work_subject)
          problems_[face] = share_problem(face, error);
        else
          problems_[face].emplace(Cause::no_mesh, face,
                                  error.subject().empty()
                                      ? fmt::format("Face{}: {}", face.number(), error.what())
                                      : error.what());
      } catch (const std::bad_alloc&) {
        throw;  // not the face's fault
      } catch (const std::exception& problem) {
        problems_[face].emplace(Cause::no_mesh, face,
                                fmt::format("Face{} cannot be meshed ({})", face.number(), problem.what()));
      } catch (const Standard_Failure& problem) {
        problems_[face].emplace(
            Cause::no_mesh, face,
            fmt::format("Face{} cannot be evaluated ({})", face.number(), problem.GetMessageString()));
      }
      const double share = static_cast<double>(done.fetch_add(1, std::memory_order_relaxed) + 1) / n;
      in_time([&] { context_.report(stage, done_before + (1 - done_before) * share); });
    };
    in_time([&] { context_.report(stage, done_before); });
    for_each_in_order(order, work_on);
  }

  /// The faces, sorted by decreasing number of segments on their boundary.
  std::vector<FaceId> longest_first() const {
    IdVector<FaceId, int> segments(shape_.faces.size());
    std::vector<FaceId> order;
    for (const FaceId face : segments.ids()) {
      order.push_back(face);
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) segments[face] += nodes_.edges[coedge.edge].segments();
      }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](FaceId a, FaceId b) { return segments[a] > segments[b]; });
    return order;
  }

  /// For each face with a problem, restores the suppressed features around it, or else applies a remedy.
  /// \return false if nothing could be done for any face.
  bool treat() {
    bool any = false;
    for (const FaceId face : problems_.ids()) {
      FaceRecord& record = records_[face];
      if (!problems_[face] || record.given_up) continue;
      // If not even a substitute chart can be made, the earlier problem is the one to report.
      const bool stands_in = record.recipe.chart != ChartKind::own;
      if (stands_in && problems_[face]->cause() == Cause::unusable_boundary && problems_before_[face])
        problems_[face].emplace(Cause::unusable_boundary, face, problems_before_[face]->what());
      problems_before_[face] = problems_[face];
      const bool is_failure = problems_[face]->cause() != Cause::narrow_gaps;
      if (is_failure && mesh_to_tips(face)) {
        record.history.push_back("faces no longer end before their tips");
        any = true;
        continue;
      }
      if (is_failure && suppressed_.keep_around(face, problems_[face]->edges, plan_.tiny)) {
        record.history.push_back("suppressed features restored");
        any = true;
        continue;
      }
      record.given_up = !apply_remedy(shape_, *problems_[face], record, plan_);
      any |= !record.given_up;
    }
    if (any) leave_out_tiny();
    return any;
  }

  /// Meshes the tips of a face, and of those beside it, that ended early. \return whether there are any.
  bool mesh_to_tips(FaceId face) {
    const auto is_beside = [&](const Tip::Flank& side) {
      const auto& faces = shape_.edges[side.edge].faces;
      return std::find(faces.begin(), faces.end(), face) != faces.end();
    };
    bool any = false;
    for (const Tip& tip : plan_.tips) {
      if (!is_beside(tip.before) && !is_beside(tip.after)) continue;
      to_tips_[tip.face] = 1;
      any = true;
    }
    return any;
  }

  /// Adds a hint to the problem of each face that is far smaller than the elements: it can be left out.
  void advise_on_tiny_faces() {
    constexpr double tiny = 0.5;
    for (const FaceId face : problems_.ids()) {
      if (!problems_[face]) continue;
      const double longest = longest_edge(shape_, face);
      if (longest > tiny * limits_.largest) continue;
      const FaceProblem& problem = *problems_[face];
      problems_[face].emplace(problem.cause(), face,
                              fmt::format("{}; its longest edge is {}: `merge_tiny` {} leaves it out",
                                          problem.what(), number_text(longest), number_text(1.1 * longest)));
    }
  }

  /// A matched face has no mesh if the face whose mesh it copies has none.
  void note_failed_partners() {
    for (const MatchedFace& face : matches_.faces)
      if (problems_[face.from])
        problems_[face.to].emplace(problems_[face.from]->cause(), face.to,
                                   fmt::format("Face{} copies the mesh of another face, which failed: {}",
                                               face.to.number(), problems_[face.from]->what()));
  }

  void throw_first_problem() const {
    for (const auto& problem : problems_) {
      if (problem) throw *problem;
    }
  }

  std::vector<ShellMesh::SuppressedFeature> list_suppressed() const {
    using Kind = ShellMesh::SuppressedFeature::Kind;
    const TinyFeatures& tiny = plan_.tiny;
    std::vector<ShellMesh::SuppressedFeature> result;
    for (const EdgeId id : tiny.edges.ids()) {
      const CadEdge& edge = shape_.edges[id];
      const VertexId end = tiny.end(edge.first_vertex);
      if (tiny.collapsed_edges[id] && end.number() <= vertices_)
        result.push_back({Kind::edge, edge.number, Kind::vertex, end.number(), distance_from(end, edge)});
      else if (tiny.edges[id] != id && shape_.edges[tiny.edges[id]].number != edge.number)
        result.push_back({Kind::edge, edge.number, Kind::edge, shape_.edges[tiny.edges[id]].number,
                          distance_between(edge, shape_.edges[tiny.edges[id]])});
    }
    for (const VertexId vertex : tiny.vertices.ids()) {
      const VertexId end = tiny.end(vertex);
      if (end != vertex && std::max(vertex.number(), end.number()) <= vertices_)
        result.push_back({Kind::vertex, vertex.number(), Kind::vertex, end.number(),
                          (shape_.vertices[vertex] - shape_.vertices[end]).norm()});
    }
    // The pieces of a divided edge come last, and may be suppressed in the same way.
    const auto place = [](const ShellMesh::SuppressedFeature& a) {
      return std::tuple(a.kind, a.number, a.to_kind, a.to);
    };
    std::sort(result.begin(), result.end(),
              [&](const auto& a, const auto& b) { return place(a) < place(b); });
    result.erase(std::unique(result.begin(), result.end(),
                             [&](const auto& a, const auto& b) { return place(a) == place(b); }),
                 result.end());
    return result;
  }

  double distance_from(VertexId vertex, const CadEdge& edge) const {
    constexpr int pieces = 16;
    double result = 0;
    for (const Vector3& point : points_along(edge, pieces))
      result = std::max(result, (point - shape_.vertices[vertex]).norm());
    return result;
  }

  std::vector<ShellMesh::Kept> list_kept() const {
    std::vector<ShellMesh::Kept> result;
    for (const auto& [face, why] : suppressed_.kept_faces()) result.push_back({2, face.number(), why});
    std::map<int, std::string> edges;  // by number, which the pieces of a divided edge share
    for (const auto& [edge, why] : suppressed_.kept_edges())
      edges.try_emplace(shape_.edges[edge].number, why);
    for (const auto& [number, why] : edges) result.push_back({1, number, why});
    return result;
  }

  std::string why_merged(FaceId face) const {
    if (!simplified_.gone[face]) return "tiny: replaced by an edge or a node of its neighbors";
    const FaceId other = simplified_.taken_by[face];
    return other.exists() ? fmt::format("joined with Face{}: coplanar", other.number()) : "in a filled hole";
  }

  std::vector<ShellMesh::Face> statuses() const {
    std::vector<ShellMesh::Face> result(shape_.faces.size());
    for (const FaceId face : shape_.faces.ids()) {
      auto& status = result[face.index()];
      const FaceRecord& record = records_[face];
      status.face = face.number();
      status.attempts = record.attempts;
      status.seconds = record.seconds;
      status.work = record.work;
      status.share = record.share();
      status.status = meshes_[face]  ? FaceStatus::meshed
                      : asked_[face] ? FaceStatus::failed
                                     : FaceStatus::skipped;
      status.note = fmt::format("{}", fmt::join(record.history, "; "));
      if (meshes_[face] && meshes_[face]->grid) status.note += status.note.empty() ? "grid" : "; grid";
      const auto end = nodes_.unused.lower_bound({face, EdgeId()});
      if (end != nodes_.unused.end() && end->first.first == face)
        status.note += fmt::format("{}ends before a tip that is narrower than the reach",
                                   status.note.empty() ? "" : "; ");
      if (plan_.tiny.merged_faces[face]) {
        status.status = FaceStatus::merged;
        status.note = why_merged(face);
      }
      status.filled_area = simplified_.areas[face];
      if (meshes_[face] && meshes_[face]->quads.empty()) {
        status.status = FaceStatus::merged;
        status.note = "crossed: covered by quads whose centers lie on its neighbors";
      }
      if (problems_[face]) status.note = problems_[face]->what();
      if (!meshes_[face]) continue;
      status.quads = static_cast<int>(meshes_[face]->quads.size());
      status.q_min = meshes_[face]->q_min;
    }
    return result;
  }

  const MeshOptions options_;
  int vertices_;  // of the model; the others divide edges or are placed inside faces
  SimplifiedModel simplified_;
  FaceFlags used_;
  SizeLimits limits_;
  PlacedNodes placed_;
  const CadModel model_;
  const CadShape& shape_;
  Matches matches_;
  ExecutionContext& context_;
  SamplingPlan plan_;
  std::vector<EdgeId> crossed_;
  EdgeTables tables_;
  FaceFlags to_tips_;  ///< 1 = does not end before its tips
  GridRows rows_;
  int chart_rounds_ = 0;
  BoundaryNodes nodes_;
  IdVector<FaceId, std::optional<FaceChart>> charts_;  ///< of the faces to be meshed next
  FaceMeshes meshes_;
  IdVector<FaceId, std::optional<FaceProblem>> problems_, problems_before_;
  IdVector<FaceId, FaceRecord> records_;
  FaceFlags asked_;
  SuppressedFeatures suppressed_;
};

/// Edges between faces of unlike thickness, and at steps. No quad may belong to both sides.
std::set<int> edges_where_thickness_changes(const MidSurface& middle) {
  std::set<int> result;
  const auto differ = [&](const MiddleFace& a, const MiddleFace& b) {
    constexpr double same = 1e-6;
    return a.step != b.step || varies(a) || varies(b) ||
           std::abs(a.thickness - b.thickness) > same * std::max(a.thickness, b.thickness);
  };
  for (const CadEdge& edge : middle.model.shape().edges) {
    for (const FaceId face : edge.faces)
      if (differ(middle.faces[edge.faces.front().index()], middle.faces[face.index()]))
        result.insert(edge.number);
  }
  return result;
}

/// \param middle what the model is the middle surface of, if any: its faces belong to faces of a solid, and
/// are not joined
ShellMesh mesh_whole(const CadModel& model, const MeshOptions& options, const MidSurface* middle,
                     ExecutionContext& context) {
  Job job(model, options, context, true, middle == nullptr);
  if (middle != nullptr) job.uncrossed = edges_where_thickness_changes(*middle);
  const SizingField field = job.build_field();
  if (!options.write_size_field.empty()) field.write(options.write_size_field);
  ShellMesh result = job.run(field);
  note_off_geometry(result);
  std::vector<std::string> defects = shell_defects(model.shape(), faces_used(model, options), result);
  for (const AreaDifference& found : area_differences(model, result))
    (found.is_certain ? defects : result.warnings).push_back(found.sentence);
  if (!defects.empty() && !options.partial)
    throw failure("", fmt::format("{}; `partial` writes the mesh all the same", fmt::join(defects, "; ")));
  result.warnings.insert(result.warnings.end(), defects.begin(), defects.end());
  if (options.inspect) options.inspect(result, field);
  return result;
}

/// Throws Error: usage for invalid options, failure for edges far outside the model.
void check_input(const CadModel& model, const MeshOptions& options) {
  check({options, {}}, model);
  for (const StrayEdge& stray : stray_edges(model.shape(), faces_used(model, options)))
    throw failure(fmt::format("Edge{}", stray.edge), stray.sentence() + "; `faces` can leave its faces out");
}

}  // namespace

ShellMesh mesh(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  check_input(model, options);
  return on_threads(context.threads(), [&] { return mesh_whole(model, options, nullptr, context); });
}

SmallFeatures small_features(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  check_input(model, options);
  return Job(model, options, context).small_features();
}

SizingField wanted_sizes(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  check_input(model, options);
  return Job(model, options, context, false).build_field();
}

SettledBoundary settle_boundary(const CadModel& model, const MeshOptions& options,
                                ExecutionContext& context) {
  Job job(model, options, context, false);
  return job.boundary(job.build_field());
}

namespace {

std::vector<int> nodes_of_face(const ShellMesh& mesh, int face) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    if (mesh.quad_faces[i] != face) continue;
    nodes.insert(nodes.end(), mesh.quads[i].begin(), mesh.quads[i].end());
    if (mesh.order == 2) nodes.insert(nodes.end(), mesh.midsides[i].begin(), mesh.midsides[i].end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Groups of the middle faces and rims that belong to each face of the solid, for loads and supports that
/// were meant for that face.
std::vector<ShellMesh::Group> groups_of_solid_faces(const MidSurface& middle) {
  std::map<int, std::vector<int>> faces, rims;
  for (std::size_t i = 0; i < middle.faces.size(); ++i) {
    if (middle.faces[i].step) continue;  // lies across, between two middle surfaces
    for (const int face : middle.faces[i].solid_faces) faces[face].push_back(static_cast<int>(i) + 1);
  }
  for (const MiddleRim& rim : middle.rims) {
    for (const int face : rim.solid_faces) rims[face].push_back(rim.edge);
  }
  std::vector<ShellMesh::Group> result;
  result.reserve(faces.size() + rims.size());
  for (auto& [face, numbers] : faces)
    result.push_back({fmt::format("SolidFace{}", face), 2, 0, std::move(numbers)});
  for (auto& [face, numbers] : rims)
    result.push_back({fmt::format("SolidFace{}Rim", face), 1, 0, std::move(numbers)});
  return result;
}

}  // namespace

ShellMesh mesh(const MidSurface& middle, const MeshOptions& options, ExecutionContext& context) {
  check_input(middle.model, options);
  ShellMesh result =
      on_threads(context.threads(), [&] { return mesh_whole(middle.model, options, &middle, context); });
  result.solid_faces = groups_of_solid_faces(middle);
  for (const MiddleFace& face : middle.faces) {
    result.thicknesses.push_back(face.thickness);
    if (!varies(face) || !middle.thickness_at) continue;
    const int number = static_cast<int>(result.thicknesses.size());
    ShellMesh::VaryingThickness varying{
        number, face.thinnest, face.thickest, nodes_of_face(result, number), {}};
    for (const int node : varying.nodes)
      varying.thicknesses.push_back(middle.thickness_at(number, result.points[node]));
    if (!varying.nodes.empty()) result.varying_thicknesses.push_back(std::move(varying));
  }
  return result;
}

std::string version() {
  return QUADRILLE_VERSION;
}

}  // namespace quadrille
