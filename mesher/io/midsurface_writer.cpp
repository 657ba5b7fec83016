/// Writes .brep and .step with OpenCASCADE, and the data of each face as .json.

#include "mesher/io/midsurface_writer.hpp"

#include <BRepTools.hxx>
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/cad/cad_shape.hpp"
#include "geometry/cad/readers/exchange_module.hpp"

namespace quadrille {

namespace {

constexpr std::array<std::string_view, 5> endings{".brep", ".brp", ".step", ".stp", ".json"};

/// The shape as STEP or as .brep. \param name of the file, for messages
std::string shape_text(const TopoDS_Shape& shape, bool step, const std::string& name) {
  std::ostringstream text;
  text.exceptions(std::ios::badbit);  // a stream that finds no memory would be silent
  if (!step) {
    BRepTools::Write(shape, text);
    return text.str();
  }
  const std::string problem = Module("quadrille_step").function<ExchangeWriteFunction>("_write")(shape, text);
  if (!problem.empty()) throw failure(name, fmt::format("{}: cannot be written as STEP: {}", name, problem));
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

void check_midsurface_format(const std::filesystem::path& path) {
  if (std::find(endings.begin(), endings.end(), lower_ending(path)) == endings.end())
    throw usage_error(path.string(),
                      fmt::format("{}: a middle surface is written as .brep, .step or .json", path.string()));
}

void write_midsurface(const MidSurface& middle, const std::filesystem::path& path) {
  const std::string ending = lower_ending(path);
  check_midsurface_format(path);
  if (ending == ".json")
    write_file(path, midsurface_json(middle).dump(2) + "\n");
  else
    write_file(path, shape_text(middle.model.shape().shape, ending.starts_with(".st"), path.string()));
}

}  // namespace quadrille
