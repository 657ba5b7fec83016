#pragma once
/// Sizes as .vdb files. Internal.

#include <filesystem>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

class Module;
class SizeCascade;

/// A point that asks for a size.
struct SizePoint {
  Vector3 point;
  double size;
};

/// OpenVDB, to be asked for in a child process first: as it is loaded it starts threads, and ends the program
/// or never ends itself where it cannot. Throws Error (failure) where there is no room for them.
const Module& vdb_module();

/// Seconds that a child process may take with OpenVDB.
inline constexpr double longest_with_vdb = 300;

/// Writes the voxels: `size` (coarsest), `size_1`, ... with metadata unit, growth, size_max, version. Throws
/// Error (failure) where the file cannot be written.
void write_cascade(const SizeCascade& cascade, const std::filesystem::path& path);

/// Sizes between those at points, from where they grow by at most `growth` per length, up to the largest of
/// them. Voxels hold the mean of the points about them, not the least, which would be smaller sizes than were
/// asked for wherever they change.
SizeCascade mean_sizes(const std::vector<SizePoint>& points, double growth, const ExecutionContext& context);

}  // namespace quadrille
