#pragma once
/// The stages of a run after the first: nodes on edges, quads of each face, one mesh of all. Internal.

#include <functional>
#include <optional>
#include <vector>

#include "mesher/faces/face_chart.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/shell/face_mesh.hpp"
#include "mesher/shell/remedies.hpp"
#include "mesher/stages/prepared.hpp"

namespace quadrille {

/// What the stages have in common.
struct Run {
  const Prepared& prepared;
  const SizingField& field;
  ExecutionContext& context;

  bool is_limited() const { return prepared.options.partial && context.has_time_limit(); }
  /// Whether there is time for another round. With options.partial the last tenth of the time limit is kept
  /// for the sampling of a round to finish.
  bool may_go_on() const {
    return !prepared.options.partial || context.seconds_left() > 0.1 * context.time_limit();
  }
  /// \return false if the time limit ended the work and, with options.partial, what was done before counts.
  bool in_time(const std::function<void()>& work) const;
};

/// The faces as far as they are meshed.
struct Faces {
  explicit Faces(const Prepared& prepared)
      : meshes(prepared.shape.faces.size()), records(prepared.shape.faces.size()) {}
  FaceMeshes meshes;
  IdVector<FaceId, FaceRecord> records;
};

/// How edges are sampled, changed from round to round where faces fail, and the nodes.
struct Boundary {
  explicit Boundary(const Prepared& prepared)
      : plan(prepared.plan),
        suppressed(prepared.suppressed),
        meshed(prepared.meshed),
        charts(prepared.shape.faces.size()) {}
  SamplingPlan plan;
  SuppressedFeatures suppressed;
  FaceFlags meshed;  ///< 0 = the face is not to be meshed, or so small that it becomes an edge or node
  EdgeTables tables;
  int rounds = 0;  ///< of sampling
  BoundaryNodes nodes;
  IdVector<FaceId, std::optional<FaceChart>> charts;  ///< of faces without a mesh; their sides keep apart
};

/// Runs `work` on each face that has no mesh yet, on all threads, and records failures as problems of the
/// face. \param done_before fraction of the stage that was done before.
void for_each_face_left(const Run& run, const Boundary& boundary, Faces& faces, Stage stage,
                        double done_before, const std::function<void(FaceId)>& work);

/// Samples the edges, keeps the meshes and charts of faces whose boundary stays, and finds the charts of the
/// others.
void sample(const Run& run, Boundary& boundary, Faces& faces);

/// Samples until no remedy is left for a face boundary that crosses itself or is crowded.
/// \param again whether faces were meshed before. \return false if no time is left for another round.
bool settle(const Run& run, Boundary& boundary, Faces& faces, bool again);

/// For each face with a problem, restores the suppressed features around it, or else applies a remedy.
/// \return false if nothing could be done for any face.
bool treat(const Prepared& prepared, Boundary& boundary, Faces& faces);

/// Takes back the finer segments that did not help the faces that have no mesh. \return whether there were
/// any.
bool undo_remedies(const CadShape& shape, Boundary& boundary, Faces& faces);

struct SettledBoundary {
  CadModel model;          ///< with faces joined and edges divided: its faces are those of the source
  SimplifiedModel simple;  ///< before edges were divided
  SizingField field;
  BoundaryNodes nodes;
  FaceFlags meshed;  ///< see Boundary
};

/// The sizing field that mesh() would use, and the nodes on edges between which it would start to mesh the
/// faces: small features are suppressed, and there are more nodes where wires cross or come close. Call it
/// within on_threads(). Throws Error as mesh() does for invalid options or sizes that exceed the budget.
SettledBoundary settle_boundary(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

/// Meshes the faces in rounds until no remedy is left, then those that still fail with nodes off their
/// surfaces and edges, and moves the nodes of all faces together. Throws the first problem of a face unless
/// options.partial. \return the edges that quads cross, ascending
std::vector<EdgeId> mesh_faces(const Run& run, Boundary& boundary, Faces& faces);

/// Edges, then vertices, ascending.
std::vector<ShellMesh::SuppressedFeature> suppressed_features(const Prepared& prepared,
                                                              const TinyFeatures& tiny);

/// Small faces, then edges, that are kept nevertheless.
std::vector<ShellMesh::Kept> kept_features(const CadShape& shape, const SuppressedFeatures& suppressed);

/// The faces meshed so far, even past the time limit with options.partial. Throws Error (failure) for a place
/// of options.sizing.nodes_at where the mesh has no node, unless options.partial.
/// \param crossed the edges that quads cross
ShellMesh assemble(const Run& run, const Boundary& boundary, const Faces& faces,
                   const std::vector<EdgeId>& crossed);

}  // namespace quadrille
