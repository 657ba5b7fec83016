/// Reads and writes sizes through the module that alone is linked with OpenVDB.

#include "geometry/sizing/size_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/threads.hpp"
#include "geometry/sizing/size_cascade.hpp"
#include "geometry/sizing/sizing_options.hpp"
#include "geometry/sizing/vdb_module.hpp"

namespace quadrille {

namespace {

/// The bytes of the .vdb file of a field. \param name of the file, for messages.
std::string file_of(const VdbField& field, const std::string& name) {
  IsolatedWork options;
  options.subject = name;
  options.crashed = options.too_long =
      fmt::format("{}: OpenVDB crashed while writing the sizes, probably out of memory or threads", name);
  options.time_limit = longest_with_vdb;
  return run_isolated(options, [&](std::ostream& out) {
    std::string bytes;
    const std::string problem = vdb_module().function<VdbFileFunction>("_file")(field, bytes);
    if (!problem.empty()) throw failure(name, fmt::format("{}: {}", name, problem));
    out << bytes;
  });
}

}  // namespace

const Module& vdb_module() {
  static const Module module = [] {
    constexpr int threads = 6;  // OpenVDB starts four
    if (makeable_threads(threads) < threads)
      throw failure("OpenVDB",
                    "OpenVDB, which reads and writes sizes, needs threads, and this process may not create "
                    "them or has no memory for them");
    return Module("quadrille_vdb");
  }();
  return module;
}

ExternalSizes opened_size_field(const std::string& path) {
  ExternalSizes sizes;
  const std::string problem = vdb_module().function<VdbOpenFunction>("_open")(path, sizes);
  if (!problem.empty()) throw failure(path, problem);
  return sizes;
}

void write_cascade(const SizeCascade& cascade, const std::filesystem::path& path) {
  const CascadeFrame& frame = cascade.frame();
  VdbField field{{}, frame.size_max, frame.growth};
  std::vector<std::size_t> places(max_size_levels + 1, 0);
  for (int k = 0; k < std::max(cascade.levels(), 1); ++k) {
    if (k > 0 && cascade.tree(k) == nullptr) continue;
    places[k] = field.levels.size();
    VdbLevel& level = field.levels.emplace_back();
    level.name = k == 0 ? "size" : fmt::format("size_{}", k);
    level.voxel = frame.voxel(k);
  }
  cascade.for_each([&](int k, const Coord& c, float value) {
    VdbLevel& level = field.levels[places[k]];
    level.coordinates.push_back({c.x(), c.y(), c.z()});
    level.values.push_back(value);
  });
  write_file(path, file_of(field, path.string()));
}

SizeCascade mean_sizes(const std::vector<SizePoint>& points, double growth, const ExecutionContext& context) {
  // Values at size_max would not be stored, so it is a little larger than the largest size.
  constexpr double above = 1.0001;
  CascadeFrame frame{0, growth, max_size_levels - 1};
  double reach = 0;
  for (const SizePoint& at : points) {
    frame.size_max = std::max(frame.size_max, above * at.size);
    reach = std::max(reach, at.point.cwiseAbs().maxCoeff());
  }
  frame.finest = std::clamp(30 - std::ilogb(reach / frame.voxel(0) + 1), 0, frame.finest);
  SizeCascade cascade(frame);
  BlockCount blocks(Budget().blocks);
  cascade.add_means(points, blocks);
  cascade.grade(growth, {}, blocks, context);
  return cascade;
}

}  // namespace quadrille
