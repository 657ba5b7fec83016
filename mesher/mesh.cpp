/// The facade: model in, mesh out.

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "geometry/base/threads.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/sizing/element_count.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quadrille.hpp"
#include "mesher/settings.hpp"
#include "mesher/shell/assembly.hpp"
#include "mesher/shell/face_mesher.hpp"
#include "mesher/shell/node_sliding.hpp"

namespace quadrille {

namespace {

constexpr int max_rounds = 8;

std::vector<char> faces_used(const CadModel& model, const std::vector<int>& faces) {
  std::vector<char> used(model.face_count(), faces.empty());
  for (const int face : faces) used[face - 1] = 1;
  return used;
}

class Job {
 public:
  /// \param size the global target size.
  Job(const CadModel& model, const MeshOptions& options, double size, ExecutionContext& context)
      : shape_(model.shape()),
        options_(options),
        size_(size),
        context_(context),
        plan_(shape_),
        used_(faces_used(model, options.faces)),
        collapse_(shape_.edges.size(), Collapse::no),
        meshes_(shape_.faces.size()),
        errors_(shape_.faces.size()),
        rungs_(shape_.faces.size(), as_asked) {
    asked_ = used_;
  }

  ShellMesh run(const SizingField& field) {
    leave_out_tiny();
    sample(field);
    mesh_faces(field);
    for (int round = 1; round < max_rounds && climb(failed_faces()); ++round) {
      sample(field);
      mesh_faces(field);
    }
    advise_on_tiny_faces();
    if (!options_.partial) throw_first_error();
    slide_nodes(shape_, nodes_, meshes_, options_.improve, context_);
    return assemble(shape_, nodes_, meshes_, statuses(), options_, context_);
  }

 private:
  /// Other samplings of the edges of a face that fails, tried one after the other.
  enum Rung { as_asked, twice, four_times, eight_times, by_length, as_point, count };

  void leave_out_tiny() {
    plan_.tiny = find_tiny_features(shape_, asked_, collapse_, options_.merge_tiny);
    for (std::size_t face = 0; face < used_.size(); ++face)
      used_[face] = asked_[face] && !plan_.tiny.merged_faces[face];
  }

  void sample(const SizingField& field) {
    const StageTimer timer(context_, Stage::sample);
    BoundaryNodes nodes = sample_edges(shape_, field, stride(options_.strategy), used_, plan_, context_);
    keep_meshes(nodes);
    nodes_ = std::move(nodes);
  }

  /// Keeps the meshes of the faces whose boundary stays as it was, with the new numbers of its nodes.
  void keep_meshes(const BoundaryNodes& nodes) {
    if (nodes_.edges.empty()) return;
    std::vector<int> renumbered(nodes_.points.size(), -1);
    std::vector<char> same(nodes.edges.size());
    for (std::size_t i = 0; i < same.size(); ++i) {
      const auto &before = nodes_.edges[i], &now = nodes.edges[i];
      same[i] = before.parameters == now.parameters;
      if (!same[i]) continue;
      for (std::size_t k = 0; k < now.nodes.size(); ++k) renumbered[before.nodes[k]] = now.nodes[k];
    }
    for (std::size_t i = 0; i < nodes.vertex_nodes.size(); ++i) {
      if (nodes_.vertex_nodes[i] >= 0) renumbered[nodes_.vertex_nodes[i]] = nodes.vertex_nodes[i];
    }
    for (std::size_t face = 0; face < meshes_.size(); ++face) {
      if (!meshes_[face]) continue;
      bool keep = used_[face];
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) keep = keep && same[coedge.edge - 1];
      }
      for (int& node : meshes_[face]->nodes) {
        node = renumbered[node];
        keep = keep && node >= 0 && node < static_cast<int>(nodes.points.size());
      }
      if (!keep) meshes_[face].reset();
    }
  }

  void mesh_faces(const SizingField& field) {
    const int n = static_cast<int>(shape_.faces.size());
    errors_.assign(n, std::nullopt);
    const std::vector<int> order = longest_first();
    std::atomic<int> started{0}, done{0};
    const auto mesh_one = [&](int face) {
      if (!used_[face] || meshes_[face]) return;
      try {
        const int fineness = 1 << std::min<int>(rungs_[face], eight_times);
        meshes_[face] = mesh_face(shape_, face, nodes_, field, options_, fineness, context_);
      } catch (const Error& error) {
        if (error.kind() == Error::Kind::cancelled) throw;
        errors_[face] = error;
      } catch (const std::bad_alloc&) {
        throw;  // not the face's fault
      } catch (const std::exception& problem) {
        const std::string name = fmt::format("Face{}", face + 1);
        errors_[face] = failure(name, fmt::format("{} cannot be meshed ({})", name, problem.what()));
      } catch (const Standard_Failure& problem) {
        const std::string name = fmt::format("Face{}", face + 1);
        errors_[face] =
            failure(name, fmt::format("{} cannot be evaluated ({})", name, problem.GetMessageString()));
      }
      context_.report(Stage::mesh, static_cast<double>(done.fetch_add(1, std::memory_order_relaxed) + 1) / n);
    };
    const auto next = [&] { return started.fetch_add(1, std::memory_order_relaxed); };
    // Each thread takes the largest face that is left: at the end none waits long for another.
    oneapi::tbb::parallel_for(0, oneapi::tbb::this_task_arena::max_concurrency(), [&](int) {
      for (int i = next(); i < n; i = next()) mesh_one(order[i]);
    });
  }

  /// The faces, those first that have most segments on their boundary.
  std::vector<int> longest_first() const {
    std::vector<int> segments(shape_.faces.size(), 0), order(shape_.faces.size());
    for (std::size_t face = 0; face < segments.size(); ++face) {
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) segments[face] += nodes_.edges[coedge.edge - 1].segments();
      }
    }
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return segments[a] > segments[b]; });
    return order;
  }

  std::vector<int> failed_faces() const {
    std::vector<int> failed;
    for (std::size_t face = 0; face < errors_.size(); ++face) {
      if (errors_[face]) failed.push_back(static_cast<int>(face));
    }
    return failed;
  }

  /// Takes each of the faces one rung higher; false if none can climb.
  bool climb(const std::vector<int>& failed) {
    bool any = false;
    for (const int face : failed) {
      if (rungs_[face] + 1 == as_point && !far_below_size(face)) continue;
      if (rungs_[face] + 1 == count) continue;
      ++rungs_[face];
      any = true;
      change_edges(face, static_cast<Rung>(rungs_[face]));
    }
    if (any) leave_out_tiny();
    return any;
  }

  void change_edges(int face, Rung rung) {
    // Edges that a neighbour has refined already draw the others along: all round the face alike.
    int refine = 1 << rung;
    for (const CadWire& wire : shape_.faces[face].wires) {
      for (const Coedge& coedge : wire.coedges) refine = std::max(refine, plan_.refine[coedge.edge - 1]);
    }
    for (const CadWire& wire : shape_.faces[face].wires) {
      for (const Coedge& coedge : wire.coedges) {
        const int edge = coedge.edge - 1;
        collapse_[edge] =
            std::max(collapse_[edge], rung == as_point ? Collapse::always : Collapse::below_tolerance);
        plan_.bare[edge] = rung >= by_length;
        plan_.refine[edge] = plan_.bare[edge] ? 1 : refine;
      }
    }
  }

  std::string rung_note(int face) const {
    constexpr std::array<const char*, count> notes{"",
                                                   "edges sampled twice as fine",
                                                   "edges sampled four times as fine",
                                                   "edges sampled eight times as fine",
                                                   "edges sampled by length alone",
                                                   ""};
    return notes[rungs_[face]];
  }

  double longest_edge(int face) const {
    double longest = 0;
    for (const CadWire& wire : shape_.faces[face].wires) {
      for (const Coedge& coedge : wire.coedges)
        longest = std::max(longest, shape_.edges[coedge.edge - 1].length);
    }
    return longest;
  }

  /// Whether a face is so small beside the elements that one node can stand for it.
  bool far_below_size(int face) const {
    constexpr double share = 0.2;  // of the least size that the options allow by default
    return longest_edge(face) < share * size_ / 8;
  }

  /// Faces that fail and are far smaller than the elements can be left out.
  void advise_on_tiny_faces() {
    constexpr double tiny = 0.5;
    for (const int face : failed_faces()) {
      const double longest = longest_edge(face);
      if (longest > tiny * size_) continue;
      const std::string name = fmt::format("Face{}", face + 1);
      errors_[face] =
          failure(name, fmt::format("{}; its longest edge is {:.3g}: `merge_tiny` {:.3g} leaves it out",
                                    errors_[face]->what(), longest, 1.1 * longest));
    }
  }

  void throw_first_error() const {
    for (const auto& error : errors_) {
      if (error) throw *error;
    }
  }

  std::vector<ShellMesh::Face> statuses() const {
    std::vector<ShellMesh::Face> result(shape_.faces.size());
    for (std::size_t face = 0; face < result.size(); ++face) {
      auto& status = result[face];
      status.face = static_cast<int>(face) + 1;
      status.status = meshes_[face]   ? FaceStatus::meshed
                      : errors_[face] ? FaceStatus::failed
                                      : FaceStatus::skipped;
      if (plan_.tiny.merged_faces[face]) {
        status.status = FaceStatus::merged;
        status.note = "tiny: its place is taken by an edge or a node of its neighbours";
      }
      if (errors_[face]) status.note = errors_[face]->what();
      if (!meshes_[face]) continue;
      status.note = rung_note(static_cast<int>(face));
      if (!status.note.empty() && !meshes_[face]->note.empty()) status.note += ", ";
      status.note += meshes_[face]->note;
      status.quads = static_cast<int>(meshes_[face]->quads.size());
      status.q_min = meshes_[face]->q_min;
      status.seconds = meshes_[face]->seconds;
    }
    return result;
  }

  const CadShape& shape_;
  const MeshOptions& options_;
  double size_;
  ExecutionContext& context_;
  SamplingPlan plan_;
  std::vector<char> asked_, used_;
  std::vector<Collapse> collapse_;  ///< (edges) of faces that failed
  BoundaryNodes nodes_;
  std::vector<std::optional<FaceMesh>> meshes_;
  std::vector<std::optional<Error>> errors_;
  std::vector<int> rungs_;  ///< (faces) Rung that the face is on
};

}  // namespace

ShellMesh mesh(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  check({options, {}}, model);
  const double size = size_limits(model, options.sizing).largest;
  SizingOptions sizing = options.sizing;
  if (options.force) sizing.budget = Budget::unlimited();
  Job job(model, options, size, context);
  return on_threads(context.threads(), [&] {
    std::optional<SizingField> field;
    {
      const StageTimer timer(context, Stage::size);
      const ElementBudget budget(model, sizing, faces_used(model, options.faces), context);
      field = SizingField::build(model, sizing, context);
      budget.check(*field);
    }
    if (!options.write_size_field.empty()) field->write(options.write_size_field);
    return job.run(*field);
  });
}

ShellMesh mesh(const MidSurface& middle, const MeshOptions& options, ExecutionContext& context) {
  ShellMesh result = mesh(middle.model, options, context);
  for (const MiddleFace& face : middle.faces) result.thicknesses.push_back(face.thickness);
  return result;
}

std::string version() {
  return QUADRILLE_VERSION;
}

}  // namespace quadrille
