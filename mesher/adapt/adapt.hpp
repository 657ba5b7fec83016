#pragma once
/// Sizes from results: elements become smaller where the stress error is large, and larger elsewhere.

#include <filesystem>
#include <vector>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "geometry/base/number_rule.hpp"
#include "mesher/adapt/peak_stress.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

struct AdaptOptions {
  /// What `error` and `poisson` may be.
  static constexpr NumberRule error_rule{.high = 1, .above_low = true, .below_high = true};
  static constexpr NumberRule poisson_rule{.high = 0.5, .below_high = true};

  double error = 0.05;   ///< wanted relative error in the energy norm of the whole mesh; unused if count > 0
  double count = 0;      ///< wanted number of elements; 0 = as many as the error needs
  double poisson = 0.3;  ///< Poisson's ratio
  double growth = 0.3;   ///< gradation of the sizes written: change of size per length
  double size_min = 0;   ///< smallest size allowed
  double size_max = 0;   ///< largest size allowed; 0 = any
  std::vector<StressPeak> before;  ///< peaks of the solution on the previous mesh, under the same load
};

struct AdaptResult {
  double error = 0;               ///< estimated relative error of the solved mesh in the energy norm
  bool is_met = false;            ///< the error is not above the wanted one: the sizes are those of the mesh
  int quads = 0;                  ///< number of quads in the solved mesh
  double quads_wanted = 0;        ///< expected number of quads in the next mesh
  double error_wanted = 0;        ///< expected error of the next mesh
  double least = 0, largest = 0;  ///< smallest and largest of the sizes written
  std::vector<StressPeak> peaks;  ///< the highest stresses, the highest first
  std::vector<PeakChange> changes;  ///< those of them that have changed since AdaptOptions::before
};

/// Estimates the error of a solution by patch recovery, and writes the sizes that distribute it evenly to a
/// .vdb file for `size_field`. Where the error is small enough already, and no number of elements is given,
/// the sizes are those of the mesh: nothing is coarsened. One material is assumed. \param mesh the mesh that
/// was solved. \param solution .frd file of CalculiX, or .vtu file. The displacements are used, on the bricks
/// into which CalculiX expands shells and plane elements. \param sizes the file to write. Throws Error:
/// failure for results that cannot be read or do not fit the mesh, usage for options out of range.
QUADRILLE_API AdaptResult adapt(const ShellMesh& mesh, const std::filesystem::path& solution,
                                const std::filesystem::path& sizes, const AdaptOptions& options,
                                ExecutionContext& context);

}  // namespace quadrille
