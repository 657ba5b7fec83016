#pragma once
/// Sizes from results: where the error of the stresses is large, elements become smaller, elsewhere larger.

#include <filesystem>

#include "geometry/base/api.hpp"
#include "geometry/base/execution_context.hpp"
#include "mesher/mesh/mesh_types.hpp"

namespace quadrille {

struct AdaptOptions {
  double error = 0.05;  ///< wanted, in the energy norm, of the whole; unused where a count is wanted
  double count = 0;     ///< elements wanted; 0 = what the error takes
  double poisson = 0.3;
  double growth = 0.3;  ///< of the sizes written
  double size_min = 0;  ///< no size below this
  double size_max = 0;  ///< and none above; 0 = any
};

struct AdaptResult {
  double error = 0;  ///< estimated for the mesh that was solved, in the energy norm, of the whole
  int quads = 0;
  double quads_wanted = 0;        ///< that the sizes give, about
  double error_wanted = 0;        ///< that they give, about
  double least = 0, largest = 0;  ///< sizes
};

/// Estimates the error of a solution by patch recovery, and writes the sizes that spread it evenly as a .vdb
/// file for `size_field`. \param mesh that was solved \param solution .frd of CalculiX, or .vtu: its
/// displacements, in the bricks that it makes of shells and plane elements. One material is assumed. Throws
/// Error: failure for results that cannot be read or do not fit the mesh, usage for options out of their
/// limits.
QUADRILLE_API AdaptResult adapt(const ShellMesh& mesh, const std::filesystem::path& solution,
                                const std::filesystem::path& sizes, const AdaptOptions& options,
                                ExecutionContext& context);

}  // namespace quadrille
