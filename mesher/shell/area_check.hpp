#pragma once
/// Whether the mesh has the area of the CAD faces.

#include <string>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// One sentence for each meshed face whose quads have another area than OpenCASCADE integrates over the CAD
/// face, by more than 3 % and twice what flat elements with straight sides lose: the size is too coarse for
/// its shape, the file contradicts itself, or the integral is wrong. Takes about a tenth of a millisecond a
/// face and more on splines.
std::vector<std::string> area_differences(const CadModel& model, const ShellMesh& mesh);

}  // namespace quadrille
