/// The table of mesh formats. Modules are opened only for formats that need them.

#include "mesher/io/io.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/threads.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/writers.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

/// Writes a file by a function that writes text, with the threads of the options.
template <void (*write)(const Writing&, TextWriter&)>
void as_text(const Writing& writing, AtomicFile& file) {
  TextWriter out(file);
  on_threads(writing.options.threads, [&] { write(writing, out); });
  out.flush();
}

void write_med(const Writing& writing, AtomicFile& file) {
  const double scale = writing.options.scale;
  const char* unit = scale == 1 ? "mm" : scale == 0.001 ? "m" : "";
  file.write(
      med_file(writing.output, printable(writing.path.stem().string(), "?"), writing.options.title, unit));
}

void write_vtu(const Writing& writing, AtomicFile& file) {
  file.write(vtu_file(writing.output, quad_qualities(writing.mesh)));
}

/// Reads a file by a function that takes its bytes.
template <ShellMesh (*read)(std::string_view, const std::string&, std::vector<std::string>*)>
ShellMesh from_bytes(const std::filesystem::path& path, std::vector<std::string>* notes) {
  return read(whole_file(path), path.string(), notes);
}

/// One format: whatever tells formats apart is here.
struct Format {
  std::string_view ending;
  std::string_view name;  ///< for people; the programs that use it, if the name is not one of those
  ShellMesh (*read)(const std::filesystem::path& path, std::vector<std::string>* notes);  ///< null: not read
  void (*write)(const Writing& writing, AtomicFile& file);  ///< null: not written
  bool for_solvers = false;  ///< whether solvers read it: the mesh is then of second order by default
  int quad_nodes = 4;        ///< the most nodes of a quad that it holds: 4, 8 or 9
  Library writer_needs = Library::none;
  std::size_t longest_name = 0;  ///< bytes that a file name may have without its ending; 0 = any number
};

constexpr Format formats[] = {
    {".msh", "Gmsh", from_bytes<read_msh>, as_text<write_msh>, false, 9},
    {".inp", "CalculiX, Abaqus", from_bytes<read_inp>, as_text<write_inp>, true, 8},
    {".unv", "I-DEAS universal", nullptr, as_text<write_unv>, true, 8},
    {".bdf", "Nastran", nullptr, as_text<write_bdf>, true, 8},
    {".med", "MED (Salome, Code_Aster)", nullptr, write_med, true, 9, Library::med, 64},
    {".stl", "STL", read_by_vtk, nullptr},
    {".obj", "Wavefront", read_by_vtk, nullptr},
    {".ply", "PLY", read_by_vtk, nullptr},
    {".vtk", "VTK legacy", read_by_vtk, as_text<write_vtk>, false, 9},
    {".vtu", "VTK XML (ParaView)", read_by_vtk, write_vtu, false, 9, Library::vtk},
    {".vtp", "VTK XML surfaces", read_by_vtk, nullptr},
    {".xdmf", "XDMF (dolfinx, ParaView)", nullptr, as_text<write_xdmf>, false, 9},
    {".su2", "SU2", nullptr, as_text<write_su2>},
};

/// The row of the file's ending; null if there is none.
const Format* format_of(const std::filesystem::path& path) {
  const auto found = std::find_if(std::begin(formats), std::end(formats),
                                  [&](const Format& format) { return format.ending == lower_ending(path); });
  return found == std::end(formats) ? nullptr : found;
}

/// The endings of the formats that have a property: ".msh, .med or .vtu".
template <class Property>
std::string endings(std::string_view last_word, Property&& property) {
  std::vector<std::string_view> found;
  for (const Format& format : formats)
    if (std::invoke(property, format)) found.push_back(format.ending);
  return fmt::format("{} {} {}", fmt::join(found.begin(), found.end() - 1, ", "), last_word, found.back());
}

/// The format of a file to write. Throws Error (usage) if there is no writer for it.
const Format& written_format(const std::filesystem::path& path) {
  const Format* format = format_of(path);
  if (format == nullptr || format->write == nullptr)
    throw usage_error(path.string(), fmt::format("{}: unknown mesh format (known are {})", path.string(),
                                                 written_endings("and")));
  return *format;
}

/// The mesh with all lengths that files contain multiplied by a factor.
ShellMesh scaled(ShellMesh mesh, double factor) {
  for (Vector3& point : mesh.points) point *= factor;
  for (double& thickness : mesh.thicknesses) thickness *= factor;
  for (ShellMesh::VaryingThickness& varying : mesh.varying_thicknesses) {
    varying.thinnest *= factor;
    varying.thickest *= factor;
    for (double& thickness : varying.thicknesses) thickness *= factor;
  }
  return mesh;
}

}  // namespace

std::string whole_file(const std::filesystem::path& path) {
  require_readable(path);
  std::ifstream file(path, std::ios::binary);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (file.read(block.data(), block.size()) || file.gcount() > 0)
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
  if (!file.eof()) throw failure(path.string(), fmt::format("{}: cannot be read", path.string()));
  return bytes;
}

std::string written_endings(std::string_view last_word) {
  return endings(last_word, [](const Format& format) { return format.write != nullptr; });
}

std::string read_endings(std::string_view last_word) {
  return endings(last_word, [](const Format& format) { return format.read != nullptr; });
}

bool is_solver_format(const std::filesystem::path& path) {
  const Format* format = format_of(path);
  return format != nullptr && format->for_solvers;
}

std::string tables_json() {
  using json = nlohmann::ordered_json;
  json known = json::array(), criteria = json::array();
  for (const Format& format : formats)
    known.push_back({{"ending", format.ending},
                     {"name", format.name},
                     {"read", format.read != nullptr},
                     {"written", format.write != nullptr},
                     {"for_solvers", format.for_solvers},
                     {"quad_nodes", format.quad_nodes}});
  for (const CriterionInfo& info : criteria_info)
    criteria.push_back({{"name", info.name},
                        {"unit", info.unit},
                        {"ideal", info.ideal},
                        {"limit", std::isnan(info.usual_limit) ? json() : json(info.usual_limit)}});
  return json{{"formats", known}, {"criteria", criteria}}.dump(1);
}

void check_format(const std::filesystem::path& path, int quad_nodes) {
  const Format& format = written_format(path);
  require_library(format.writer_needs, format.ending);
  if (quad_nodes > format.quad_nodes)
    throw usage_error(
        quad_nodes == 9 ? "nodes" : "order",
        fmt::format("{}: this format has no quads of {} nodes: {} is for {}", path.string(), quad_nodes,
                    quad_nodes == 9 ? "`nodes` 9" : "`order` 2", endings("and", [&](const Format& other) {
                      return other.write != nullptr && other.quad_nodes >= quad_nodes;
                    })));
  const std::size_t name = path.stem().string().size();
  if (format.longest_name > 0 && name > format.longest_name)
    throw usage_error(path.string(),
                      fmt::format("{}: without its ending the file name has {} bytes, and the mesh in a {} "
                                  "file, which has the same name, can have {}: give the file a shorter name",
                                  path.string(), name, format.ending, format.longest_name));
}

void check_element(InpElement element, int order) {
  if (order_of(element) != 0 && order_of(element) != order)
    throw usage_error("element", fmt::format("`element` {} needs order {}, not {}", name_of(element),
                                             order_of(element), order));
}

void write_mesh(const ShellMesh& mesh, const std::filesystem::path& path, const WriteOptions& options) {
  if (mesh.order == 1 && options.quad_nodes == 9)
    throw usage_error("nodes", "`nodes` 9 is for second-order meshes, and this one is first order");
  check_format(path, mesh.order == 1 ? 4 : options.quad_nodes);
  if (lower_ending(path) == ".inp") check_element(options.element, mesh.order);
  AtomicFile file(path);
  WriteOptions titled = options;
  // Solvers would take the text after a line break in the title for a keyword.
  titled.title = options.title.empty() ? "Quadrille mesh" : printable(options.title, "?");
  const auto write = [&](const ShellMesh& lengths) {
    written_format(path).write(
        {lengths, OutputMesh(lengths, options.groups, options.quad_nodes), path, titled}, file);
  };
  if (options.scale == 1)
    write(mesh);
  else
    write(scaled(mesh, options.scale));
  file.commit();
}

void write_picture(const ShellMesh& mesh, const std::filesystem::path& path, int width, int height) {
  write_file(path, vtk_picture(mesh, quad_qualities(mesh), width, height));
}

void write_sizes_vtu(const SizeMap& map, const std::filesystem::path& path) {
  write_file(path, vtu_sizes(map));
}

ShellMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  const Format* format = format_of(path);
  if (format == nullptr || format->read == nullptr)
    throw failure(
        path.string(),
        fmt::format("{}: unknown mesh format (known are {}): Gmsh and meshio convert others to .msh",
                    path.string(), read_endings("and")));
  return format->read(path, notes);
}

}  // namespace quadrille
