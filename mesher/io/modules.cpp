/// Calls the functions of each module by their symbols and turns the problems that they return into errors.

#include "mesher/io/modules.hpp"

#include <exception>
#include <string>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"
#include "geometry/base/module_loader.hpp"
#include "mesher/mesh/quality.hpp"

namespace quadrille {

namespace {

const Module& vtk_module(std::string_view ending = ".vtu") {
  require_library(Library::vtk, ending);
  static const Module module("quadrille_vtk");
  return module;
}

const Module& picture_module() {
  require_library(Library::pictures, ".png");
  static const Module module("quadrille_picture");
  return module;
}

const Module& med_module() {
  require_library(Library::med, ".med");
  static const Module module("quadrille_med");
  return module;
}

void check(const std::string& problem) {
  if (!problem.empty()) throw failure("", problem);
}

}  // namespace

void require_library(Library library, std::string_view ending) {
  constexpr bool has[] = {true, QUADRILLE_HAS_VTK, QUADRILLE_HAS_PICTURES, QUADRILLE_HAS_MED};
  if (has[static_cast<int>(library)]) return;
  throw usage_error(std::string(ending), fmt::format("{} files need {}, which this build of Quadrille lacks",
                                                     ending, library == Library::med ? "libmed" : "VTK"));
}

std::string vtu_file(const OutputMesh& mesh, const std::vector<double>& qualities) {
  std::string bytes;
  check(vtk_module().function<VtkFileFunction>("_file")(mesh, qualities, bytes));
  return bytes;
}

std::string vtk_picture(const ShellMesh& mesh, int width, int height) {
  std::string bytes;
  check(
      picture_module().function<PictureFunction>("_draw")(mesh, quad_qualities(mesh), width, height, bytes));
  return bytes;
}

std::string vtu_sizes(const SizeMap& map) {
  std::string bytes;
  check(vtk_module().function<VtkSizesFunction>("_sizes")(map, bytes));
  return bytes;
}

std::string size_picture(const SizeMap& map, int width, int height) {
  std::string bytes;
  check(picture_module().function<SizePictureFunction>("_sizes")(map, width, height, bytes));
  return bytes;
}

ImportedMesh vtk_mesh(const std::string& path, const std::string& ending) {
  ImportedMesh mesh;
  check(vtk_module(ending).function<VtkReadFunction>("_read")(path, ending, mesh));
  return mesh;
}

SolverResult vtk_result(const std::string& path) {
  SolverResult result;
  check(vtk_module().function<VtkResultFunction>("_result")(path, result));
  return result;
}

void open_med_module() noexcept {
  try {
    med_module();
  } catch (const std::exception&) {
    return;
  }
}

std::string med_file(const OutputMesh& mesh, const std::string& name, const std::string& description) {
  const auto write = med_module().function<MedFileFunction>("_file");
  IsolatedWork options;
  options.subject = name;
  options.crashed = name + ".med: libmed crashed while writing the mesh, probably out of memory";
  // libmed prints lines of its own when it fails; the output of a child process is not shown.
  return isolated_bytes(options, [&] {
    std::string bytes;
    check(write(mesh, name, description, bytes));
    return bytes;
  });
}

}  // namespace quadrille
