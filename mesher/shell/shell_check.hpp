#pragma once
/// The last look at a mesh before it is handed out: is everything there that was asked for? Internal.

#include <string>
#include <vector>

#include "geometry/cad/cad_shape.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// Compares a finished mesh with the CAD model alone, whatever way it was made: each requested face has quads
/// or is listed as merged, each quad is convex, each side of one quad, or of three and more, lies on a CAD
/// edge with as many faces, and the segments of each CAD edge form one chain. Faces whose status says that
/// they failed are left out, and the edges round them count as free.
/// \param requested 1 = the face was to be meshed
/// \return one sentence with entity and place for each kind of defect; empty if all is well. Linear in the
/// quads.
std::vector<std::string> shell_defects(const CadShape& shape, const FaceFlags& requested,
                                       const ShellMesh& mesh);

}  // namespace quadrille
