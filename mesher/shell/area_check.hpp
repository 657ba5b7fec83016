#pragma once
/// Checks areas and volumes of the mesh against those of the CAD model.

#include <optional>
#include <string>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// One sentence for each meshed face, or for faces that share quads, whose quads differ in area from the
/// integral over the CAD face. The tolerance is 3 % plus twice the area that flat elements with straight
/// sides lose. If it is exceeded, the size is too coarse for the shape, the file contradicts itself, or the
/// integral is wrong. Takes about a tenth of a millisecond per face, and more on splines.
std::vector<std::string> area_differences(const CadModel& model, const ShellMesh& mesh);

/// Volumes of solids, model units cubed.
struct Volumes {
  double cad = 0;   ///< by OpenCASCADE's adaptive integration
  double mesh = 0;  ///< within its flat quads
};

/// The volumes of a model of solids and of its mesh. Nothing if the mesh is open, if faces have no mesh, if
/// solids share faces, or if OpenCASCADE cannot integrate. Takes milliseconds a face.
std::optional<Volumes> volumes(const CadModel& model, const ShellMesh& mesh);

}  // namespace quadrille
