#pragma once
/// The interface of the module libquadrille_vdb.so, which reads and writes .vdb files. The sizing field
/// itself needs only OpenVDB's headers; loading OpenVDB's library takes longer than meshing a small part.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// Trilinear weight of the k-th corner of a voxel at a position in it; the bits of k give the corner's x, y,
/// z. \param within coordinates in the voxel, 0 to 1.
inline double corner_weight(const Vector3& within, int k) {
  const auto along = [&](int axis) { return (k >> axis & 1) != 0 ? within[axis] : 1 - within[axis]; };
  return along(0) * along(1) * along(2);
}

/// One level of a sizing field as plain values.
struct VdbLevel {
  std::string name;
  double voxel = 0;                             ///< edge length of a voxel
  std::vector<std::array<int, 3>> coordinates;  ///< (n) indices of the active voxels
  std::vector<float> values;                    ///< (n) sizes
};

struct VdbField {
  std::vector<VdbLevel> levels;
  double size_max = 0;
  double growth = 0;
};

/// The sizes that an external file requests, in the file's own unit.
struct ExternalSizes {
  /// The least size of all grids at a point; for one of our own files the interpolated size of its cascade.
  /// Infinite where no grid has a value.
  std::function<double(const Vector3&)> at;
  bool between_voxels = false;          ///< the file is one of ours: sizes are interpolated
  Vector3 low{0, 0, 0}, high{0, 0, 0};  ///< box of the active voxels, one voxel wider
  double voxel = 0;                     ///< shortest voxel side
};

/// Both return an empty string, or a sentence that says what went wrong. \param bytes of the .vdb file.
using VdbFileFunction = std::string(const VdbField& field, std::string& bytes);
using VdbOpenFunction = std::string(const std::string& path, ExternalSizes& sizes);

}  // namespace quadrille
