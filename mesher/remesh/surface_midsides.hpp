#pragma once
/// Midside nodes on a triangulated surface. Internal.

#include <string>
#include <vector>

#include "mesher/mesh/mesh_types.hpp"
#include "mesher/remesh/patch_quads.hpp"

namespace quadrille {

/// The part of a curve that a segment of the mesh stands for.
struct CurveStretch {
  Vector3 middle;  ///< its midpoint, on the curve
};

/// Makes the mesh second order, with midside nodes on the curves and on the surface. The sides of an element
/// that would fold are made straight; their nodes are listed in `mesh.off_geometry` and reported in `notes`.
/// \param patches their quads are the quads of the mesh, in order; `nodes` are nodes of the mesh.
/// \param stretches (segments) the part of a curve for each segment.
void add_surface_midsides(ShellMesh& mesh, const std::vector<PatchQuads>& patches,
                          const std::vector<CurveStretch>& stretches, const PatchSurface& on,
                          std::vector<std::string>& notes);

}  // namespace quadrille
