#pragma once
/// Lets quads cross smooth CAD edges where these force quads outside the limits ("virtual topology").
/// Internal.

#include <memory>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "mesher/edges/edge_sampling.hpp"
#include "mesher/shell/composite_surface.hpp"
#include "mesher/shell/face_mesh.hpp"

namespace quadrille {

/// Faces that are meshed as one.
struct CompositeFace {
  std::vector<FaceId> members;                                   ///< ascending; the first has the mesh
  std::vector<EdgeId> edges;                                     ///< between them, or seams
  std::vector<std::shared_ptr<const MeshSurface>> surfaces;      ///< (members)
  std::vector<std::shared_ptr<const MeshSurface>> own_surfaces;  ///< (members) see FaceMesh::surface
  std::shared_ptr<const CompositeSurface> surface;               ///< of all
};

/// Treats faces as one where they meet smoothly, within 10 degrees all along an edge, and a quad at the edge
/// is outside the industry criteria: nodes may then move over both faces, on their surfaces, and patches may
/// be refilled across the edge. The first member gets the mesh of all; the meshes of the others become empty.
/// \param kept 1 = the edge stays. So do edges with a prescribed spacing, free and non-manifold edges, and
/// edges that share nodes with others. Linear in the quads.
std::vector<CompositeFace> join_smooth_faces(const CadShape& shape, const EdgeFlags& kept,
                                             const BoundaryNodes& nodes, FaceMeshes& faces,
                                             const ExecutionContext& context);

/// Gives each face its mesh again. A quad belongs to the face that its center lies on. Nodes that quads of
/// several faces share become boundary nodes. An edge along which the mesh has no chain of sides any more
/// loses its nodes. \return these edges, ascending
std::vector<EdgeId> split_faces(const std::vector<CompositeFace>& composites, BoundaryNodes& nodes,
                                FaceMeshes& faces, const ExecutionContext& context);

}  // namespace quadrille
