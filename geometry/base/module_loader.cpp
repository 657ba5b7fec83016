/// Looks for a module in one folder after the other, opens it, and checks its version.

#include "geometry/base/module_loader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "geometry/base/shared_library.hpp"

namespace quadrille {

namespace {

void* open_module(const std::string& name) {
  const std::filesystem::path own = own_folder();
  if (!own.is_absolute())
    throw failure(name, fmt::format("{} cannot be searched for, since the folder of this program is unknown "
                                    "(is /proc mounted?)",
                                    name));
  std::vector<std::string> looked_in;
  for (const std::filesystem::path& folder : module_folders(own)) {
    const std::filesystem::path candidate = (folder / name).lexically_normal();
    looked_in.push_back(candidate.parent_path().string());
    std::error_code ignored;
    if (std::filesystem::exists(candidate, ignored)) return open_library(candidate);
  }
  throw failure(name, fmt::format("{}, which this format needs, is in none of the folders {}", name,
                                  fmt::join(looked_in, ", ")));
}

}  // namespace

Module::Module(const std::string& prefix) : prefix_(prefix), file_(library_name(prefix)) {
  handle_ = open_module(file_);
  // C++ types cross the interface, so both sides must be of the same version.
  if (std::string(function<ModuleVersionFunction>("_version")()) != QUADRILLE_VERSION) throw mismatch();
}

void* Module::symbol(const std::string& name) const {
  void* result = find_symbol(handle_, prefix_ + name);
  if (result == nullptr) throw mismatch();
  return result;
}

Error Module::mismatch() const {
  return failure(file_, fmt::format("{} has another version than Quadrille {}", file_, QUADRILLE_VERSION));
}

}  // namespace quadrille
