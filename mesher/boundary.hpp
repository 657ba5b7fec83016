#pragma once
/// What a run meshes its faces between. Internal.

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_model.hpp"
#include "geometry/sizing/sizing_field.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/options.hpp"

namespace quadrille {

struct SettledBoundary {
  SizingField field;
  BoundaryNodes nodes;
};

/// The sizes that mesh() works with: features that it lets go ask for none. To be called within on_threads().
/// Throws Error as mesh() for sizes that make no sense or are too many.
SizingField wanted_sizes(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

/// The sizes that mesh() would work with, and the nodes on the edges that it would begin to mesh faces
/// between: with features let go, and more nodes where wires cross or come close. To be called within
/// on_threads(). Throws Error as mesh() for sizes that make no sense or are too many.
SettledBoundary settle_boundary(const CadModel& model, const MeshOptions& options, ExecutionContext& context);

}  // namespace quadrille
