#pragma once
/// The error of stresses by patch recovery, and sizes that distribute it evenly. Internal.
///
/// Zienkiewicz and Zhu, The superconvergent patch recovery and a posteriori error estimates (1992); Li and
/// Bettess, Notes on mesh optimal criteria in adaptive finite element computations (1995).

#include <array>
#include <vector>

#include "mesher/adapt/shell_stress.hpp"
#include "mesher/mesh/mesh_types.hpp"
#include "mesher/mesh/sides.hpp"

namespace quadrille {

struct ErrorEstimate {
  std::vector<double> squares;  ///< (quads) square of the error, in the units of energy()
  double all = 0;               ///< square of the energy norm of the stresses, in the same units

  double sum() const;
  /// The relative error in the energy norm: 0.05 = 5 %.
  double relative() const;
};

/// Fits polynomials of second degree to the stresses around each corner node, separately for membrane and
/// bending; of lower degree if there are few samples. In a quad the fits of its four corners are blended.
/// Patches end at folds of 30 degrees. \param stresses (quads) at four points each
ErrorEstimate estimate_error(const ShellMesh& mesh, const std::vector<std::array<ShellStress, 4>>& stresses,
                             double poisson);

/// (quads) The square root of each quad's area.
std::vector<double> sizes_of(const ShellMesh& mesh);

/// (points) The mean over the quads at each corner node; 0 at other points. \param corners see
/// corners_by_node() \param value (Side) of a quad at one of its corners
template <class Value>
std::vector<double> means_at_nodes(const Rows<Side>& corners, Value&& value) {
  std::vector<double> means(corners.size(), 0);
  for (std::size_t node = 0; node < means.size(); ++node) {
    for (const Side corner : corners[node]) means[node] += value(corner);
    if (!corners[node].empty()) means[node] /= static_cast<double>(corners[node].size());
  }
  return means;
}

/// (points) Sizes at the corner nodes with which all elements have the same error, up to a common factor; 0
/// at other points. The error of a single quad is noisy, so each corner takes all quads around it.
std::vector<double> even_sizes(const ShellMesh& mesh, const ErrorEstimate& estimate);

/// (points) 1 = the stresses seem singular there: the quads at the node have far more error each than the
/// quads around those.
std::vector<char> singular_corners(const ShellMesh& mesh, const ErrorEstimate& estimate);

}  // namespace quadrille
