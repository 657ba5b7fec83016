#pragma once
/// Finds what forces quads outside the usual limits. Internal.

#include <map>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Names, for each quad of the mesh that fails limits_of(mesh), what forces it: an edge shorter than the
/// least size that has a side of the quad, else its face, with the corner of less than 40 degrees that the
/// quad lies in, or the edges that come close there. One entry for each edge, and for each face and reason,
/// those with the most quads first. The quads that only warp are left out: the curvature of the part does
/// that. Linear in the mesh. \param cut_corners by node: the vertex of the corner that a face ends before
/// (slivers.hpp)
std::vector<ShellMesh::PoorQuads> poor_quads(const CadShape& shape, const ShellMesh& mesh,
                                             const std::map<int, int>& cut_corners = {});

}  // namespace quadrille
