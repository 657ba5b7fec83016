#pragma once
/// The last check of a face's mesh: it ends on the face's boundary, and nowhere else. Internal.

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// Looks at the sides whose ends are both nodes of edges; the others have two quads by construction.
/// \param boundary as the face was meshed. \param nodes (n) as FaceMesh::nodes: of the first n points.
/// \param quads indices of points.
/// \return two nodes (BoundaryNodes::points) of a side that not as many quads meet as the boundary says (one
/// on an edge, two on a seam, a crack or inside), or that two quads run in one direction; none if all is
/// right. O(n log n + quads).
std::optional<std::pair<int, int>> wrong_boundary_side(const FaceBoundary& boundary,
                                                       const std::vector<int>& nodes,
                                                       const std::vector<std::array<int, 4>>& quads);

}  // namespace quadrille
