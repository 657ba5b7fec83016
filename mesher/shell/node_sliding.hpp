#pragma once
/// The last optimization: moves the nodes of all faces together, including those on CAD edges. Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quads/improve_options.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// Moves nodes so that the quads around them lie further inside the industry criteria (measure_objective()).
/// Nodes on CAD edges move along their curves, between their neighbors, for the quads of all faces there.
/// Other nodes move on their surfaces. Nodes of CAD vertices stay, and so do nodes shared by several edges
/// (TinyFeatures) and nodes of edges with a prescribed spacing. No quad becomes concave, and none gets a
/// scaled Jacobian below both 0.5 and that of the worst quad around the same node. Segments on edges stay
/// between 0.5 and 1.5 times their original length in the curve's parameter (at most 1.15 times on curved
/// edges). Updates the parameters and points of `nodes`, and the points and uv of the faces. With
/// ImproveOptions::clean_up, faces are then taken as one along smooth edges beside quads that are still
/// outside the criteria (join_smooth_faces()), patches around these quads are refilled with other quads
/// (mend_quads()), except in grids, and nodes move once more. This renumbers points inside faces. Faces run
/// in parallel between passes over the edges, so the result does not depend on the number of threads.
/// Complexity: linear in the quads, plus about 2 us per sweep for each node of a poor quad. \param kept 1 =
/// no quad may cross the edge, see join_smooth_faces() \return the edges that quads cross, ascending: they
/// have no nodes of their own any more
std::vector<EdgeId> slide_nodes(const CadShape& shape, BoundaryNodes& nodes, FaceMeshes& faces,
                                const EdgeFlags& kept, const ImproveOptions& options,
                                ExecutionContext& context);

}  // namespace quadrille
