#pragma once
/// Third stage of a run: the quads of each face, with remedies for those that fail. Internal.

#include <vector>

#include "mesher/stages/boundary.hpp"

namespace quadrille {

/// Meshes the faces in rounds until no remedy is left, then those that still fail with nodes off their
/// surfaces and edges, and moves the nodes of all faces together. Throws the first problem of a face unless
/// options.partial. \return the edges that quads cross, ascending
std::vector<EdgeId> mesh_faces(const Run& run, Boundary& boundary, Faces& faces);

}  // namespace quadrille
