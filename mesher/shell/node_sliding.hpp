#pragma once
/// The last optimization: all nodes over all faces together, those on CAD edges too. Internal.

#include <optional>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quads/improve_options.hpp"
#include "mesher/shell/face_mesher.hpp"

namespace quadrille {

/// Moves nodes to where the quads round them are further inside the criteria of industry
/// (measure_objective()): nodes on CAD edges along their curves, between their neighbors, for the sake of the
/// quads of all faces there; others on their surfaces. Nodes of CAD vertices stay, and so do those of edges
/// that share theirs (TinyFeatures). No quad becomes concave, and none gets a scaled Jacobian below both 0.5
/// and the worst of the quads round the same node. Intervals along edges keep between 0.5 and 1.5 of what
/// they were, on curved ones 1.15. Parameters and points of `nodes`, and points, uv and q_min of the faces
/// follow. With ImproveOptions::clean_up, patches round quads that are still outside the criteria are then
/// filled by other quads (mend_quads()), but for grids, and nodes move once more; points inside the faces
/// change their number. Faces run in parallel between passes over the edges: the result does not depend on
/// the number of threads. Complexity: linear in the quads, and some 2 us a node and sweep where they are
/// poor.
void slide_nodes(const CadShape& shape, BoundaryNodes& nodes, std::vector<std::optional<FaceMesh>>& faces,
                 const ImproveOptions& options, ExecutionContext& context);

}  // namespace quadrille
