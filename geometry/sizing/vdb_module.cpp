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
      double size = 0;
      int active = 0;
      visit_corners(*grid, p, [&](double weight, float value, bool is_active) {
        active += is_active ? 1 : 0;
        size += weight * value;
      });
      const bool coarsest = &grid == &grids.back().grid;
      if (active > 0 && (coarsest || (active == 8 && size <= limit))) return unit * size;
    }
    return std::numeric_limits<double>::infinity();
  }

  /// The least active corner of all grids: never larger than requested, and free of background values.
  double least(const Vector3& p) const {
    double result = std::numeric_limits<double>::infinity();
    for (const auto& [grid, unit, limit] : grids) {
      visit_corners(*grid, p, [&, own = unit](double, float value, bool is_active) {
        if (is_active) result = std::min(result, own * value);
      });
    }
    return result;
  }

  /// Calls visit(weight, value, whether it is active) for the corners of the voxel that contains a point.
  /// There are none outside the range of voxel indices, where damaged transforms may lead.
  template <class Visit>
  static void visit_corners(const FloatGrid& grid, const Vector3& p, const Visit& visit) {
    const openvdb::Vec3d index = grid.worldToIndex(openvdb::Vec3d(p.x(), p.y(), p.z()));
    constexpr double farthest = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(index[i]) < farthest)) return;
    }
    const Coord base = Coord::floor(index);
    const Vector3 within = Vector3(index[0], index[1], index[2]) - Vector3(base.x(), base.y(), base.z());
    for (int k = 0; k < 8; ++k) {
      float value = 0;
      const bool is_active = grid.tree().probeValue(base.offsetBy(k & 1, k >> 1 & 1, k >> 2), value);
      visit(corner_weight(within, k), value, is_active);
    }
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
      openvdb::CoordBBox voxels = grid->evalActiveVoxelBoundingBox();
      if (voxels.empty()) continue;
      voxels.expand(1);
      const openvdb::BBoxd box = grid->transform().indexToWorld(voxels);
      sizes.low = sizes.low.cwiseMin(Vector3(box.min().x(), box.min().y(), box.min().z()));
      sizes.high = sizes.high.cwiseMax(Vector3(box.max().x(), box.max().y(), box.max().z()));
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
