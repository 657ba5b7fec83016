#pragma once
/// Sizes in .vdb files. Internal.

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/base/execution_context.hpp"
#include "geometry/base/vector.hpp"

namespace quadrille {

class Module;
class SizeCascade;
struct ExternalSizes;

/// A point that requests a size.
struct SizePoint {
  Vector3 point;
  double size;
};

/// The OpenVDB module. Use it in a child process first: OpenVDB starts threads while it is loaded, and if it
/// cannot, it ends the program or hangs. Throws Error (failure) if the threads cannot be created.
const Module& vdb_module();

/// The sizes of a .vdb file. Throws Error (failure) if it cannot be read; OpenVDB may crash on a damaged
/// file.
ExternalSizes opened_size_field(const std::string& path);

/// Time limit of a child process that uses OpenVDB, seconds.
inline constexpr double longest_with_vdb = 300;

/// Writes the voxels as grids `size` (coarsest), `size_1`, ... with metadata unit, growth, size_max, version.
/// Throws Error (failure) if the file cannot be written.
void write_cascade(const SizeCascade& cascade, const std::filesystem::path& path);

/// A field from sizes at points, growing away from them by at most `growth` per unit of length, up to the
/// largest size. Voxels hold the mean of the points around them. The least would be smaller than requested
/// wherever sizes change.
SizeCascade mean_sizes(const std::vector<SizePoint>& points, double growth, const ExecutionContext& context);

}  // namespace quadrille
