/// Looks for a module in one folder after the other, opens it by dlopen(3), and checks its version.

#include "geometry/base/module_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace quadrille {

namespace {

/// The folder of the program or shared library that contains this code; empty if not known. Only the kernel
/// knows it for sure: the name that the loader keeps may be relative and match another file in the current
/// folder.
std::filesystem::path own_folder() {
  static const char anchor = 0;
  const auto address = reinterpret_cast<std::uintptr_t>(&anchor);
  // Each line: begin-end permissions offset device inode /path
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    const char* const last = line.data() + line.size();
    const char* const dash = std::from_chars(line.data(), last, begin, 16).ptr;
    if (dash == last || std::from_chars(dash + 1, last, end, 16).ec != std::errc()) continue;
    const std::size_t path = line.find('/');
    if (address < begin || address >= end || path == std::string::npos) continue;
    return std::filesystem::path(line.substr(path)).parent_path();
  }
  return {};
}

/// The folders in which modules are searched for, in order.
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own) {
  // Programs that lie elsewhere and link the library name the folder. secure_getenv ignores the variable in
  // programs that run with more rights than their user has.
  if (const char* named = ::secure_getenv("QUADRILLE_MODULES"); named != nullptr && named[0] == '/')
    return {named};
  // In the build tree and in bundles: beside the program or library. Installed: below the library's folder.
  return {own, own / "quadrille", QUADRILLE_MODULES_FOLDER};
}

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
    if (!std::filesystem::exists(candidate, ignored)) continue;
    if (void* library = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
    throw failure(name, fmt::format("{} cannot be loaded: {}", candidate.string(), ::dlerror()));
  }
  throw failure(name, fmt::format("{}, which this format needs, is in none of the folders {}", name,
                                  fmt::join(looked_in, ", ")));
}

}  // namespace

Module::Module(const std::string& prefix) : prefix_(prefix), file_("lib" + prefix + ".so") {
  handle_ = open_module(file_);
  // C++ types cross the interface, so both sides must be of the same version.
  if (std::string(function<ModuleVersionFunction>("_version")()) != QUADRILLE_VERSION) throw mismatch();
}

void* Module::symbol(const std::string& name) const {
  void* result = ::dlsym(handle_, (prefix_ + name).c_str());
  if (result == nullptr) throw mismatch();
  return result;
}

Error Module::mismatch() const {
  return failure(file_, fmt::format("{} has another version than Quadrille {}", file_, QUADRILLE_VERSION));
}

}  // namespace quadrille
