#pragma once
/// Midside nodes on a triangulated surface. Internal.

#include <string>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/patch_quads.hpp"

namespace quadrille {

/// What a segment of the mesh stands for.
struct CurveStretch {
  Vector3 middle;  ///< of it, on the curve
};

/// Makes the mesh one of second order: midside nodes lie on the curves and on the surface. Where an element
/// would fold its sides are straight; those nodes are listed in `mesh.off_geometry`, and `notes` tells.
/// \param patches whose quads are those of the mesh, in order; nodes are the mesh's. \param stretches
/// (segments).
void add_surface_midsides(ShellMesh& mesh, const std::vector<PatchQuads>& patches,
                          const std::vector<CurveStretch>& stretches, const PatchSurface& on,
                          std::vector<std::string>& notes);

}  // namespace quadrille
