#pragma once
/// The last check of a face's mesh: it ends on the boundary of the face and nowhere else. Internal.

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/faces/face_boundary.hpp"

namespace quadrille {

/// Checks the sides whose ends are both boundary nodes. All other sides have two quads by construction, but
/// for those of crowded_side(). \param boundary the boundary with which the face was meshed. \param nodes (n)
/// FaceMesh::nodes, the boundary nodes of the first n points. \param quads indices into the points. \return
/// the two nodes (indices into BoundaryNodes::points) of a wrong side; nothing if there is none. Sides must
/// have one quad on an edge and two inside. On a seam or a crack they have two or none. No two quads may run
/// along a side in the same direction. O(n log n + quads).
std::optional<std::pair<int, int>> wrong_boundary_side(const FaceBoundary& boundary,
                                                       const std::vector<int>& nodes,
                                                       const std::vector<std::array<int, 4>>& quads);

/// A side with more than two quads, as its points: around a thin tube, two sides that start on either side of
/// a seam may end in one point. \param nodes, quads as above. O(quads).
std::optional<std::pair<int, int>> crowded_side(const std::vector<int>& nodes,
                                                const std::vector<std::array<int, 4>>& quads);

}  // namespace quadrille
