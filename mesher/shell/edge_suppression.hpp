#pragma once
/// Lets quads cross smooth CAD edges where these force quads outside the limits ("virtual topology"). Internal.

#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/quads/improve_options.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// Takes faces as one where they meet smoothly, within 10 degrees all along an edge, and quads at the edge are
/// outside the industry criteria. Nodes then move over both faces, on their surfaces, and patches around these
/// quads are refilled. A quad belongs to the face that its center lies on. Where nothing is gained, nothing
/// changes.
/// \param kept 1 = the edge stays, as do edges with a prescribed spacing, free and non-manifold edges, and
/// edges that share nodes with others
/// \return the suppressed edges, ascending: they have no nodes of their own any more.
/// Time: about 30 us for each quad of the faces concerned.
std::vector<EdgeId> suppress_smooth_edges(const CadShape& shape, const EdgeFlags& kept, BoundaryNodes& nodes,
                                          FaceMeshes& faces, const ImproveOptions& options,
                                          ExecutionContext& context);

}  // namespace quadrille
