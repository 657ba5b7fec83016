/// Maps endings to the reader or writer of a format; modules are opened only for formats that need them.

#include "mesher/io/io.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/file_access.hpp"
#include "geometry/base/file_ending.hpp"
#include "geometry/base/printable.hpp"
#include "geometry/base/threads.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/plane_mesh.hpp"
#include "mesher/io/readers.hpp"
#include "mesher/io/writers.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

void write_text(const OutputMesh& mesh, const std::string& ending, const WriteOptions& options,
                const std::vector<double>& qualities, TextWriter& out) {
  if (ending == ".unv")
    write_unv(mesh, out);
  else if (ending == ".bdf")
    write_bdf(mesh, options, out);
  else if (ending == ".vtk")
    write_vtk(mesh, options, qualities, out);
  else if (options.msh_version == MshVersion::v4_1)
    write_msh4(mesh, out);
  else
    write_msh2(mesh, out);
}

/// \param output the mesh in the coordinates of the model.
void write_inp_text(const ShellMesh& mesh, const OutputMesh& output, const std::string& name,
                    const WriteOptions& options, TextWriter& out) {
  if (!lies_in_plane(options.element)) {
    write_inp(output, options, "", out);
  } else {
    const PlaneMesh plane = in_plane(mesh, options.element, name);
    write_inp(OutputMesh(plane.mesh, options.groups), options, plane.turn, out);
  }
}

void write_format(const ShellMesh& mesh, const std::filesystem::path& path, WriteOptions options,
                  AtomicFile& file) {
  const std::string ending = lower_ending(path);
  // Solvers would take the text after a line break in the title for a keyword.
  options.title = options.title.empty() ? "Quadrille mesh" : printable(options.title, "?");
  const OutputMesh output(mesh, options.groups, options.quad_nodes);
  const bool tells_quality = ending == ".vtu" || ending == ".vtk";
  const std::vector<double> qualities = tells_quality ? quad_qualities(mesh) : std::vector<double>();
  if (ending == ".med") {
    file.write(med_file(output, printable(path.stem().string(), "?"), options.title));
  } else if (ending == ".vtu") {
    file.write(vtu_file(output, qualities));
  } else {
    TextWriter out(file);
    on_threads(options.threads, [&] {
      if (ending == ".inp")
        write_inp_text(mesh, output, path.string(), options, out);
      else
        write_text(output, ending, options, qualities, out);
    });
    out.flush();
  }
}

constexpr std::string_view readable[] = {".msh", ".inp", ".unv", ".bdf", ".nas", ".dat",
                                         ".stl", ".obj", ".ply", ".vtk", ".vtu", ".vtp"};

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

bool is_mesh_format(const std::filesystem::path& path) {
  constexpr std::string_view known[] = {".msh", ".inp", ".unv", ".bdf", ".med", ".vtu", ".vtk"};
  return std::find(std::begin(known), std::end(known), lower_ending(path)) != std::end(known);
}

bool is_solver_format(const std::filesystem::path& path) {
  constexpr std::string_view read_by_solvers[] = {".inp", ".unv", ".med", ".bdf"};
  return std::find(std::begin(read_by_solvers), std::end(read_by_solvers), lower_ending(path)) !=
         std::end(read_by_solvers);
}

void check_format(const std::filesystem::path& path, int quad_nodes) {
  if (!is_mesh_format(path))
    throw usage_error(path.string(),
                      fmt::format("{}: unknown mesh format (known are .msh, .inp, .unv, .bdf, .med, "
                                  ".vtu and .vtk)",
                                  path.string()));
  const std::string ending = lower_ending(path);
  require_module(ending);
  if (quad_nodes == 9 && (ending == ".inp" || ending == ".unv" || ending == ".bdf"))
    throw usage_error(
        "nodes",
        fmt::format("{}: this format has no nine-node quads: `nodes` 9 is for .msh, .med, .vtu and .vtk",
                    path.string()));
  constexpr std::size_t longest_name = 64;  // bytes of a mesh name in MED
  const std::size_t name = path.stem().string().size();
  if (ending == ".med" && name > longest_name)
    throw usage_error(path.string(),
                      fmt::format("{}: without its ending the file name has {} bytes, and the mesh in a .med "
                                  "file, which has the same name, can have {}: give the file a shorter name",
                                  path.string(), name, longest_name));
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
  write_format(mesh, path, options, file);
  file.commit();
}

void write_picture(const ShellMesh& mesh, const std::filesystem::path& path, int width, int height) {
  write_file(path, vtk_picture(mesh, width, height));
}

void write_sizes_vtu(const SizeMap& map, const std::filesystem::path& path) {
  write_file(path, vtu_sizes(map));
}

void write_size_picture(const SizeMap& map, const std::filesystem::path& path, int width, int height) {
  write_file(path, size_picture(map, width, height));
}

bool is_readable_format(const std::filesystem::path& path) {
  return std::find(std::begin(readable), std::end(readable), lower_ending(path)) != std::end(readable);
}

ShellMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  const std::string ending = lower_ending(path), name = path.string();
  if (!is_readable_format(path))
    throw failure(name,
                  fmt::format("{}: unknown mesh format (known are {})", name, fmt::join(readable, ", ")));
  if (ending == ".msh") return read_msh(whole_file(path), name, notes);
  if (ending == ".inp") return read_inp(whole_file(path), name, notes);
  if (ending == ".unv") return read_unv(whole_file(path), name, notes);
  if (ending == ".bdf" || ending == ".nas" || ending == ".dat")
    return read_bdf(whole_file(path), name, notes);
  return read_by_vtk(path, notes);
}

}  // namespace quadrille
