#pragma once
/// The model that a run meshes, its sizing field, and the nodes on edges between which it meshes the faces.
/// Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/edges/simplified_model.hpp"
#include "mesher/options.hpp"

namespace quadrille {

struct SettledBoundary {
  SizingField field;
  BoundaryNodes nodes;
  FaceFlags meshed;  ///< 0 = the face is not to be meshed, or so small that it becomes an edge or node
};

/// 1 = the options ask for this face to be meshed.
FaceFlags faces_used(const CadModel& model, const MeshOptions& options);

/// The model that is meshed: with options.fill_holes small holes are filled, and without
/// options.keep_features coplanar faces are joined, unless options.faces names those to mesh.
/// \param joins faces may be joined
SimplifiedModel simplified(const CadModel& model, const MeshOptions& options, bool joins = true);

/// The sizing field that mesh() uses: suppressed features request no sizes. Call it within on_threads().
/// Throws Error as mesh() does for invalid options or sizes that exceed the budget.
SizingField wanted_sizes(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

/// The sizing field that mesh() would use, and the nodes on edges between which it would start to mesh the
/// faces: small features are suppressed, and there are more nodes where wires cross or come close. Call it
/// within on_threads(). Throws Error as mesh() does for invalid options or sizes that exceed the budget.
SettledBoundary settle_boundary(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

}  // namespace quadrille
