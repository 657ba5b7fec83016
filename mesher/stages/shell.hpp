#pragma once
/// Last stage of a run: one mesh of all faces, and what it says of them. Internal.

#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/stages/boundary.hpp"

namespace quadrille {

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
