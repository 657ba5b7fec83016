#pragma once
/// The error of stresses by patch recovery, and sizes that spread it evenly. Internal.
///
/// Zienkiewicz and Zhu, The superconvergent patch recovery and a posteriori error estimates (1992); Li and
/// Bettess, Notes on mesh optimal criteria in adaptive finite element computations (1995).

#include <array>
#include <vector>

#include "mesher/adapt/shell_stress.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

struct ErrorEstimate {
  std::vector<double> squares;  ///< (quads) of the error, as energy() has it
  double all = 0;               ///< the square of what stresses have by themselves

  double sum() const;
  /// In the energy norm, of the whole: 0.05 = 5 %.
  double relative() const;
};

/// Around each corner of the mesh polynomials of second degree are fitted to the stresses, membrane and
/// bending apart; in a quad those of its four corners are blended. Patches end at folds of 30 degrees. \param
/// stresses (quads)
ErrorEstimate estimate_error(const ShellMesh& mesh, const std::vector<std::array<ShellStress, 4>>& stresses,
                             double poisson);

/// Order of a mesh's elements: the error of their stresses goes with that power of their size.
int order_of(const ShellMesh& mesh);

/// (quads) The square root of their area.
std::vector<double> sizes_of(const ShellMesh& mesh);

/// (points) With such sizes at its corners, times any factor, all elements have the same error; 0 at points
/// that are no corners. What a single quad says is noise: each corner goes by all quads about it.
std::vector<double> even_sizes(const ShellMesh& mesh, const ErrorEstimate& estimate);

/// (points) 1 = stresses seem to have no end there: the quads about it have far more of the error than those
/// round them.
std::vector<char> singular_corners(const ShellMesh& mesh, const ErrorEstimate& estimate);

}  // namespace quadrille
