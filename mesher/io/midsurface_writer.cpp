/// Writes .brep and .step with OpenCASCADE, and the data of each face as .json.

#include "mesher/io/midsurface_writer.hpp"

#include <BRepTools.hxx>
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_ending.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/readers/exchange_module.hpp"

namespace quadrille {

namespace {

constexpr std::array<std::string_view, 5> endings{".brep", ".brp", ".step", ".stp", ".json"};

std::string brep_text(const TopoDS_Shape& shape) {
  std::ostringstream text;
  BRepTools::Write(shape, text);
  return text.str();
}

/// A new folder for temporary files, which others may not read.
std::filesystem::path temporary_folder() {
  std::random_device random;
  std::filesystem::path name =
      std::filesystem::temp_directory_path() /
      fmt::format("quadrille-{:08x}{:08x}", std::uint32_t{random()}, std::uint32_t{random()});
  std::error_code problem;
  if (!std::filesystem::create_directory(name, problem))
    throw failure(name.string(), fmt::format("{}: cannot be made", name.string()));
  std::filesystem::permissions(name, std::filesystem::perms::owner_all, problem);
  return name;
}

/// OpenCASCADE writes STEP only to a named file, so this uses a temporary folder.
std::string step_text(const TopoDS_Shape& shape) {
  const std::filesystem::path folder = temporary_folder(), file = folder / "middle.step";
  const std::string problem =
      Module("quadrille_step").function<ExchangeWriteFunction>("_write")(file.string(), shape);
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  std::filesystem::remove(folder, ignored);
  if (!problem.empty()) throw failure(file.string(), problem);
  return text.str();
}

}  // namespace

nlohmann::json midsurface_json(const MidSurface& middle) {
  nlohmann::json faces = nlohmann::json::array();
  for (std::size_t i = 0; i < middle.faces.size(); ++i) {
    const MiddleFace& face = middle.faces[i];
    faces.push_back({{"name", fmt::format("Face{}", i + 1)},
                     {"solid", face.solid},
                     {"solid_faces", face.solid_faces},
                     {"area", face.area},
                     {"thickness", face.thickness},
                     {"thickness_min", face.thinnest},
                     {"thickness_max", face.thickest},
                     {"step", face.step},
                     {"fitted", face.fitted},
                     {"off", face.off}});
  }
  nlohmann::json rims = nlohmann::json::array();
  for (const MiddleRim& rim : middle.rims)
    rims.push_back({{"name", fmt::format("Edge{}", rim.edge)}, {"solid_faces", rim.solid_faces}});
  return {{"faces", faces},
          {"rims", rims},
          {"volume", middle.volume},
          {"area_times_thickness", middle.shell_volume},
          {"solids", middle.solids},
          {"parts", middle.parts},
          {"free_edges", middle.free_edges},
          {"edges_inside_the_material", middle.stray_edges},
          {"solid_faces_at_edges_inside", middle.stray_faces},
          {"unpaired_solid_faces", middle.unpaired},
          {"counted_twice", middle.counted_twice},
          {"faces_of_another_thickness", middle.uneven},
          {"warnings", middle.warnings},
          {"problems", middle.problems}};
}

bool is_midsurface_format(const std::filesystem::path& path) {
  return std::find(endings.begin(), endings.end(), lower_ending(path)) != endings.end();
}

void write_midsurface(const MidSurface& middle, const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  const TopoDS_Shape& shape = middle.model.shape().shape;
  if (!is_midsurface_format(path))
    throw usage_error(path.string(),
                      fmt::format("{}: a middle surface is written as .brep, .step or .json", path.string()));
  if (ending == ".json")
    write_file(path, midsurface_json(middle).dump(2) + "\n");
  else if (ending == ".step" || ending == ".stp")
    write_file(path, step_text(shape));
  else
    write_file(path, brep_text(shape));
}

}  // namespace quadrille
