/// Opens each module once, and writes .med files in a child process.

#include "mesher/io/modules.hpp"

#include <exception>
#include <map>
#include <mutex>
#include <string>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/isolated_work.hpp"

namespace quadrille {

void require_library(Library library, std::string_view ending) {
  constexpr bool has[] = {true, QUADRILLE_HAS_VTK, QUADRILLE_HAS_PICTURES, QUADRILLE_HAS_MED};
  if (has[static_cast<int>(library)]) return;
  throw usage_error(std::string(ending), fmt::format("{} files need {}, which this build of Quadrille lacks",
                                                     ending, library == Library::med ? "libmed" : "VTK"));
}

const Module& module_of(Library library) {
  constexpr const char* names[] = {"", "quadrille_vtk", "quadrille_picture", "quadrille_med"};
  constexpr const char* endings[] = {"", ".vtu", ".png", ".med"};
  require_library(library, endings[static_cast<int>(library)]);
  static std::mutex opening;
  static std::map<Library, Module> open;
  const std::lock_guard lock(opening);
  return open.try_emplace(library, names[static_cast<int>(library)]).first->second;
}

void open_med_module() noexcept try {
  module_of(Library::med);
} catch (const std::exception&) {  // reported by med_file()
}

std::string med_file(const OutputMesh& mesh, const std::string& name, const std::string& description,
                     const std::string& unit) {
  module_of(Library::med);  // opened here, not in the child
  IsolatedWork options;
  options.subject = name;
  options.crashed = name + ".med: libmed crashed while writing the mesh, probably out of memory";
  // libmed prints lines of its own when it fails; the output of a child process is not shown.
  constexpr ModuleFunction<std::string, const OutputMesh&, const std::string&, const std::string&,
                           const std::string&>
      write{Library::med, "_file"};
  return run_isolated(options, [&](std::ostream& out) { out << write(mesh, name, description, unit); });
}

}  // namespace quadrille
