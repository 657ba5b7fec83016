/// The module libquadrille_vdb.so: reads and writes sizing fields as .vdb files.

#include "geometry/sizing/vdb_module.hpp"

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "geometry/base/module_loader.hpp"

namespace quadrille {

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

/// The grids of a file, each with its own transform, multiplied by the metadata `unit` (default 1).
struct ExternalField {
  struct Grid {
    FloatGrid::Ptr grid;
    double unit;
  };
  std::vector<Grid> grids;

  double at(const Vector3& p) const {
    double result = std::numeric_limits<double>::infinity();
    for (const auto& [grid, unit] : grids) {
      const openvdb::Vec3d index = grid->worldToIndex(openvdb::Vec3d(p.x(), p.y(), p.z()));
      // Beyond where voxels are numbered there are none; damaged transforms lead there.
      constexpr double farthest = 1e9;
      const auto within = [](double i) { return std::abs(i) < farthest; };
      if (!within(index.x()) || !within(index.y()) || !within(index.z())) continue;
      // The least active corner: never larger than asked for, and the background cannot leak in.
      const Coord base = Coord::floor(index);
      for (int k = 0; k < 8; ++k) {
        float value = 0;
        if (grid->tree().probeValue(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), value))
          result = std::min(result, unit * value);
      }
    }
    return result;
  }

  /// \return the sentence that says what is wrong with the sizes; empty = nothing.
  std::string measure(ExternalSizes& sizes) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    sizes.low.setConstant(infinity);
    sizes.high.setConstant(-infinity);
    sizes.voxel = infinity;
    for (const auto& [grid, unit] : grids) {
      for (auto it = grid->cbeginValueOn(); it; ++it) {
        if (*it > 0 && std::isfinite(*it) && unit > 0 && std::isfinite(unit)) continue;
        const openvdb::Vec3d p = grid->indexToWorld(it.getCoord());
        return fmt::format("the size {:g} at ({:.4g}, {:.4g}, {:.4g}), and sizes are positive numbers",
                           unit * *it, p.x(), p.y(), p.z());
      }
      const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
      if (box.empty()) continue;
      for (int k = 0; k < 8; ++k) {
        const openvdb::Vec3d corner =
            grid->indexToWorld(openvdb::Vec3d((k & 1) ? box.max().x() + 1 : box.min().x() - 1,
                                              (k >> 1 & 1) ? box.max().y() + 1 : box.min().y() - 1,
                                              (k >> 2) ? box.max().z() + 1 : box.min().z() - 1));
        const Vector3 p(corner.x(), corner.y(), corner.z());
        sizes.low = sizes.low.cwiseMin(p);
        sizes.high = sizes.high.cwiseMax(p);
      }
      const openvdb::Vec3d voxel = grid->voxelSize();
      sizes.voxel = std::min({sizes.voxel, voxel.x(), voxel.y(), voxel.z()});
    }
    return sizes.voxel < infinity ? std::string() : "no active voxel";
  }
};

/// What openvdb::io::File puts into a file. That class writes the file itself and does not look whether the
/// disk took it; openvdb::io::Stream leaves out the offsets that readers seek by.
class SeekableArchive : public openvdb::io::Archive {
 public:
  void write(std::ostream& out, const openvdb::GridPtrVec& grids) const {
    constexpr bool seekable = true;
    Archive::write(out, grids, seekable);
  }
};

FloatGrid::Ptr to_grid(const VdbLevel& level, const VdbField& field) {
  FloatGrid::Ptr grid = FloatGrid::create(static_cast<float>(field.size_max));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(level.voxel));
  auto accessor = grid->getAccessor();
  for (std::size_t i = 0; i < level.values.size(); ++i) {
    const auto& [x, y, z] = level.coordinates[i];
    accessor.setValue(Coord(x, y, z), level.values[i]);
  }
  grid->setName(level.name);
  grid->insertMeta("unit", openvdb::DoubleMetadata(1.0));
  grid->insertMeta("growth", openvdb::DoubleMetadata(field.growth));
  grid->insertMeta("size_max", openvdb::DoubleMetadata(field.size_max));
  grid->insertMeta("version", openvdb::StringMetadata(QUADRILLE_VERSION));
  return grid;
}

}  // namespace

QUADRILLE_EXPORT const char* quadrille_vdb_version() {
  return QUADRILLE_VERSION;
}

QUADRILLE_EXPORT std::string quadrille_vdb_file(const VdbField& field, std::string& bytes) {
  try {
    openvdb::initialize();
    openvdb::GridPtrVec grids;
    for (const VdbLevel& level : field.levels) grids.push_back(to_grid(level, field));
    std::ostringstream out;
    SeekableArchive().write(out, grids);
    bytes = std::move(out).str();
    return {};
  } catch (const std::exception& problem) {
    return fmt::format("OpenVDB could not write the size field ({})", problem.what());
  }
}

QUADRILLE_EXPORT std::string quadrille_vdb_open(const std::string& path, ExternalSizes& sizes) {
  try {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open(false);  // all of it at once: damage shows here, not at some look-up later
    const auto field = std::make_shared<ExternalField>();
    const auto grids = file.getGrids();
    for (const auto& grid : *grids) {
      const auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
      if (!floats) continue;
      const auto unit = grid->getMetadata<openvdb::DoubleMetadata>("unit");
      field->grids.push_back({floats, unit ? unit->value() : 1.0});
    }
    file.close();
    if (field->grids.empty()) return fmt::format("{} holds no float grid to use as a size field", path);
    if (const std::string problem = field->measure(sizes); !problem.empty())
      return fmt::format("{} holds {}", path, problem);
    sizes.at = [field](const Vector3& p) { return field->at(p); };
    return {};
  } catch (const std::exception&) {
    return fmt::format("{} is not a readable .vdb file", path);
  }
}

}  // namespace quadrille
