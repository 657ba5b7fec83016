#pragma once
/// What the module libquadrille_vdb.so does: .vdb files. The sizing field itself needs OpenVDB's headers
/// alone; loading its library takes longer than meshing a small part.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "geometry/base/vector.hpp"

namespace quadrille {

/// What the k-th corner of a voxel counts at a place in it, by the bits of k; coordinates 0 to 1 within.
inline double corner_weight(const Vector3& within, int k) {
  const auto along = [&](int axis) { return (k >> axis & 1) != 0 ? within[axis] : 1 - within[axis]; };
  return along(0) * along(1) * along(2);
}

/// One level of a sizing field as plain values.
struct VdbLevel {
  std::string name;
  double voxel = 0;                             ///< edge length of a voxel
  std::vector<std::array<int, 3>> coordinates;  ///< of the active voxels
  std::vector<float> values;                    ///< as many
};

struct VdbField {
  std::vector<VdbLevel> levels;
  double size_max = 0;
  double growth = 0;
};

/// What the grids of a file of others ask for, in the file's own unit.
struct ExternalSizes {
  /// The least that a grid asks for, or where the file is one of ours what its cascade holds; infinite where
  /// all are silent.
  std::function<double(const Vector3&)> at;
  bool between_voxels = false;          ///< it is one of ours
  Vector3 low{0, 0, 0}, high{0, 0, 0};  ///< where they are not
  double voxel = 0;                     ///< shortest side of a voxel
};

/// Both return an empty string, or the sentence that says what went wrong.
/// \param bytes of the .vdb file.
using VdbFileFunction = std::string(const VdbField& field, std::string& bytes);
using VdbOpenFunction = std::string(const std::string& path, ExternalSizes& sizes);

}  // namespace quadrille
