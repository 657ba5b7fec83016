/// Chooses the reader by the ending: .vtu goes to VTK's module, everything else is read as .frd.

#include "mesher/io/result_reader.hpp"

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/file_ending.hpp"
#include "mesher/io/modules.hpp"
#include "mesher/io/readers.hpp"

namespace quadrille {

SolverResult read_result(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (lower_ending(path) == ".vtu") {
    try {
      return vtk_result(name);
    } catch (const Error& problem) {
      throw failure(name, fmt::format("{}: {}", name, problem.what()));
    }
  }
  return read_frd(whole_file(path), name);
}

}  // namespace quadrille
