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

/// What is wanted: one of both is 0.
struct AdaptGoal {
  double error = 0;  ///< relative
  double count = 0;  ///< quads
};

/// (quads) sizes with which each new element has the same error, together what is wanted. Errors of
/// second-order elements go with the square of the size, those of first order with the size; no size changes
/// by more than a factor of four at once.
std::vector<double> sizes_for(const ShellMesh& mesh, const ErrorEstimate& estimate, const AdaptGoal& goal);

/// About how many elements sizes give.
double count_for(const ShellMesh& mesh, const std::vector<double>& sizes);

}  // namespace quadrille
