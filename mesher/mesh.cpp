/// The facade: model in, mesh out.

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "geometry/cad_shape.hpp"
#include "geometry/sizing_field.hpp"
#include "mesher/assembly.hpp"
#include "mesher/edge_sampling.hpp"
#include "mesher/face_mesher.hpp"
#include "mesher/quadrille.hpp"

namespace quadrille {

namespace {

constexpr double element_limit = 50e6;
constexpr int max_rounds = 4;

std::vector<char> faces_used(const CadModel& model, const std::vector<int>& faces) {
  std::vector<char> used(model.face_count(), faces.empty());
  for (const int face : faces) {
    if (face < 1 || face > model.face_count()) {
      const std::string name = fmt::format("Face{}", face);
      throw usage_error(
          name, fmt::format("{} does not exist: the model has Face1 to Face{}", name, model.face_count()));
    }
    used[face - 1] = 1;
  }
  return used;
}

void check_options(const CadModel& model, const MeshOptions& options, double size) {
  if (options.order != 1 && options.order != 2) {
    throw usage_error("--order", fmt::format("the order must be 1 or 2, not {}", options.order));
  }
  // The exact area takes long to compute: only where the bounding box says that it may matter.
  const double box = model.diagonal() / size;
  const double estimate =
      options.force || box * box * model.face_count() < element_limit ? 0 : model.area() / (size * size);
  if (estimate > element_limit) {
    throw usage_error("--size",
                      fmt::format("the size {:.6g} would give about {:.3g} million elements: use --force "
                                  "to mesh all the same",
                                  size, estimate / 1e6));
  }
}

class Job {
 public:
  Job(const CadModel& model, const MeshOptions& options, ExecutionContext& context)
      : shape_(model.shape()),
        options_(options),
        context_(context),
        used_(faces_used(model, options.faces)) {}

  ShellMesh run(const SizingField& field) {
    std::vector<int> refine(shape_.edges.size(), 1);
    for (int round = 0;; ++round) {
      sample(field, refine);
      mesh_faces(field);
      if (round + 1 == max_rounds || !refine_failed(refine)) break;
    }
    if (!options_.partial) throw_first_error();
    return assemble(shape_, nodes_, meshes_, statuses(), options_, context_);
  }

 private:
  void sample(const SizingField& field, const std::vector<int>& refine) {
    const StageTimer timer(context_, "sample");
    nodes_ = sample_edges(shape_, field, options_, used_, refine, context_);
  }

  void mesh_faces(const SizingField& field) {
    const int n = static_cast<int>(shape_.faces.size());
    meshes_.assign(n, std::nullopt);
    errors_.assign(n, std::nullopt);
    std::atomic<int> done{0};
    oneapi::tbb::parallel_for(0, n, [&](int face) {
      if (!used_[face]) return;
      try {
        meshes_[face] = mesh_face(shape_, face, nodes_, field, options_, context_);
      } catch (const Error& error) {
        if (error.kind() == Error::Kind::cancelled) throw;
        errors_[face] = error;
      } catch (const std::exception& problem) {
        const std::string name = fmt::format("Face{}", face + 1);
        errors_[face] = failure(name, fmt::format("{} cannot be meshed ({})", name, problem.what()));
      } catch (const Standard_Failure& problem) {
        const std::string name = fmt::format("Face{}", face + 1);
        errors_[face] =
            failure(name, fmt::format("{} cannot be evaluated ({})", name, problem.GetMessageString()));
      }
      context_.report("mesh", static_cast<double>(++done) / n);
    });
  }

  /// Doubles the segments on the edges of the faces that failed.
  bool refine_failed(std::vector<int>& refine) const {
    bool any = false;
    for (std::size_t face = 0; face < errors_.size(); ++face) {
      if (!errors_[face]) continue;
      any = true;
      for (const CadWire& wire : shape_.faces[face].wires) {
        for (const Coedge& coedge : wire.coedges) refine[coedge.edge - 1] = 2 * refine[coedge.edge - 1];
      }
    }
    return any;
  }

  void throw_first_error() const {
    for (const auto& error : errors_) {
      if (error) throw *error;
    }
  }

  std::vector<ShellMesh::FaceStatus> statuses() const {
    std::vector<ShellMesh::FaceStatus> result(shape_.faces.size());
    for (std::size_t face = 0; face < result.size(); ++face) {
      auto& status = result[face];
      status.face = static_cast<int>(face) + 1;
      status.status = meshes_[face] ? "meshed" : errors_[face] ? "failed" : "skipped";
      if (errors_[face]) status.note = errors_[face]->what();
      if (!meshes_[face]) continue;
      status.note = meshes_[face]->note;
      status.quads = static_cast<int>(meshes_[face]->quads.size());
      status.q_min = meshes_[face]->q_min;
      status.seconds = meshes_[face]->seconds;
    }
    return result;
  }

  const CadShape& shape_;
  const MeshOptions& options_;
  ExecutionContext& context_;
  std::vector<char> used_;
  BoundaryNodes nodes_;
  std::vector<std::optional<FaceMesh>> meshes_;
  std::vector<std::optional<Error>> errors_;
};

}  // namespace

ShellMesh mesh(const CadModel& model, const MeshOptions& options, ExecutionContext& context) {
  const double size =
      options.sizing.size > 0 ? options.sizing.size : model.diagonal() / options.sizing.elements_per_diagonal;
  check_options(model, options, size);
  Job job(model, options, context);
  std::optional<SizingField> field;
  {
    const StageTimer timer(context, "size");
    field = SizingField::build(model, options.sizing, context);
  }
  if (!options.write_size_field.empty()) field->write(options.write_size_field);
  const int threads =
      context.threads() > 0 ? context.threads() : static_cast<int>(std::thread::hardware_concurrency());
  // Without it oneTBB warns when more threads are asked for than there are cores.
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  oneapi::tbb::task_arena arena(threads);
  return arena.execute([&] { return job.run(*field); });
}

double suggested_size(const CadModel& model, int quads) {
  return std::sqrt(model.area() / std::max(quads, 1));
}

std::string version() {
  return QUADRILLE_VERSION;
}

}  // namespace quadrille
