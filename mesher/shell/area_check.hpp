#pragma once
/// Checks areas of the mesh against those of the CAD model.

#include <string>
#include <vector>

#include "geometry/cad/cad_model.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

/// A face whose quads differ in area from the CAD face by more than they may.
struct AreaDifference {
  std::string sentence;  ///< names the face, or faces that share quads, and tells both areas
  /// A plane face differs by over 1 % of the whole model's area: the mesh is wrong. On other surfaces
  /// OpenCASCADE's integral may be, by a factor in some files.
  bool is_certain = false;
};

/// Which faces are compared. Differences on all but plane faces that share no quads are never certain.
enum class AreasChecked { all, planes };

/// Compares the quads of each meshed face, or of faces that share quads, with the CAD face. They may differ
/// by 3 %, by twice the area that flat elements with straight sides lose, and by a strip as wide as what is
/// suppressed along all its edges. Beyond that the size is too coarse for the shape, the file contradicts
/// itself, or the integral is wrong. Takes about a tenth of a millisecond per face, and more on splines.
/// \param checked the differences that are certain are found either way
std::vector<AreaDifference> area_differences(const CadModel& model, const ShellMesh& mesh,
                                             AreasChecked checked = AreasChecked::all);

}  // namespace quadrille
