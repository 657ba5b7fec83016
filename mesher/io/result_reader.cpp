#include "mesher/io/result_reader.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "mesher/io/modules.hpp"

namespace quadrille {

SolverResult read_result(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (path.extension() == ".vtu") {
    try {
      return vtk_result(name);
    } catch (const Error& problem) {
      throw failure(name, fmt::format("{}: {}", name, problem.what()));
    }
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw failure(name, fmt::format("{} cannot be read", name));
  return read_frd(std::string(std::istreambuf_iterator<char>(file), {}), name);
}

}  // namespace quadrille
