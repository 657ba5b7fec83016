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

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/place_text.hpp"

namespace quadrille {

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

/// The grids of a file, each with its own transform, multiplied by the metadata `unit` (default 1).
struct ExternalField {
  struct Grid {
    FloatGrid::Ptr grid;
    double unit;
    double limit = 0;  // larger sizes are left to coarser grids
  };
  std::vector<Grid> grids;
  bool cascade = false;  // one of our files, grids finest first: sizes are interpolated between voxels

  double at(const Vector3& p) const { return cascade ? between(p) : least(p); }

  /// The interpolated size, as in SizeCascade::Lookup.
  double between(const Vector3& p) const {
    for (const auto& [grid, unit, limit] : grids) {
      Coord base;
      Vector3 within;
      if (!enter(*grid, p, base, within)) continue;
      double size = 0;
      int active = 0;
      for (int k = 0; k < 8; ++k) {
        float value = 0;
        active += grid->tree().probeValue(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), value);
        size += corner_weight(within, k) * value;
      }
      const bool coarsest = &grid == &grids.back().grid;
      if (active > 0 && (coarsest || (active == 8 && size <= limit))) return unit * size;
    }
    return std::numeric_limits<double>::infinity();
  }

  /// The least active corner of all grids: never larger than requested, and free of background values.
  double least(const Vector3& p) const {
    double result = std::numeric_limits<double>::infinity();
    for (const auto& [grid, unit, limit] : grids) {
      Coord base;
      Vector3 within;
      if (!enter(*grid, p, base, within)) continue;
      for (int k = 0; k < 8; ++k) {
        float value = 0;
        if (grid->tree().probeValue(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), value))
          result = std::min(result, unit * value);
      }
    }
    return result;
  }

  /// Gets the voxel that contains a point, and the position in it. \return false outside the range of voxel
  /// indices, where damaged transforms may lead.
  static bool enter(const FloatGrid& grid, const Vector3& p, Coord& base, Vector3& within) {
    const openvdb::Vec3d index = grid.worldToIndex(openvdb::Vec3d(p.x(), p.y(), p.z()));
    constexpr double farthest = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(index[i]) < farthest)) return false;
    }
    base = Coord::floor(index);
    within = Vector3(index[0], index[1], index[2]) - Vector3(base.x(), base.y(), base.z());
    return true;
  }

  /// Detects grids made by to_grid(), and sorts them finest first.
  void recognize() {
    for (Grid& own : grids) {
      const auto largest = own.grid->getMetadata<openvdb::DoubleMetadata>("size_max");
      if (!largest || own.grid->getName().rfind("size", 0) != 0) return;
      own.limit = largest->value();
    }
    std::sort(grids.begin(), grids.end(),
              [](const Grid& a, const Grid& b) { return a.grid->voxelSize()[0] < b.grid->voxelSize()[0]; });
    const double widest = grids.back().grid->voxelSize()[0];
    for (Grid& own : grids) own.limit *= own.grid->voxelSize()[0] / widest;
    cascade = true;
  }

  /// Checks the sizes and measures their box. \return a sentence that says what is wrong; empty = nothing.
  std::string measure(ExternalSizes& sizes) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    sizes.low.setConstant(infinity);
    sizes.high.setConstant(-infinity);
    sizes.voxel = infinity;
    for (const auto& [grid, unit, limit] : grids) {
      for (auto it = grid->cbeginValueOn(); it; ++it) {
        if (*it > 0 && std::isfinite(*it) && unit > 0 && std::isfinite(unit)) continue;
        const openvdb::Vec3d p = grid->indexToWorld(it.getCoord());
        return fmt::format("the size {:g} at {}, and sizes are positive numbers", unit * *it,
                           place_text(Vector3(p.x(), p.y(), p.z())));
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
    if (sizes.voxel < infinity) return {};
    if (!cascade) return "no active voxel";
    // One of our files, with the largest size everywhere: it limits nothing.
    sizes.low.setConstant(-infinity);
    sizes.high.setConstant(infinity);
    sizes.voxel = grids.back().grid->voxelSize()[0];
    return {};
  }
};

/// The content of a file as openvdb::io::File writes it. That class writes the file itself and does not check
/// whether the disk accepted it. openvdb::io::Stream leaves out the offsets that readers seek by.
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
    out.exceptions(std::ios::badbit);  // a stream that finds no memory swallows the exception otherwise
    SeekableArchive().write(out, grids);
    bytes = std::move(out).str();
    return {};
  } catch (const std::exception& problem) {
    return fmt::format("OpenVDB could not write the size field: {}", sentence_of(problem));
  }
}

QUADRILLE_EXPORT std::string quadrille_vdb_open(const std::string& path, ExternalSizes& sizes) {
  try {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open(false);  // read everything now: damage shows here, not at a later look-up
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
    field->recognize();
    if (const std::string problem = field->measure(sizes); !problem.empty())
      return fmt::format("{} holds {}", path, problem);
    sizes.between_voxels = field->cascade;
    sizes.at = [field](const Vector3& p) { return field->at(p); };
    return {};
  } catch (const std::exception&) {
    return fmt::format("{} is not a readable .vdb file", path);
  }
}

}  // namespace quadrille
