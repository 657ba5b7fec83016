/// Finds the folder of this code by /proc/self/maps, and opens libraries by dlopen(3).

#include "geometry/base/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"

namespace quadrille {

// Only the kernel knows it for sure: the name that the loader keeps may be relative and match another file in
// the current folder.
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

std::string library_name(const std::string& prefix) {
  return "lib" + prefix + ".so";
}

std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own) {
  // Programs that lie elsewhere and link the library name the folder. secure_getenv ignores the variable in
  // programs that run with more rights than their user has.
  if (const char* named = ::secure_getenv("QUADRILLE_MODULES"); named != nullptr && named[0] == '/')
    return {named};
  // In the build tree and in bundles: beside the program or library. Installed: below the library's folder.
  return {own, own / "quadrille", QUADRILLE_MODULES_FOLDER};
}

void* open_library(const std::filesystem::path& file) {
  if (void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
  throw failure(file.filename().string(), fmt::format("{} cannot be loaded: {}", file.string(), ::dlerror()));
}

void* find_symbol(void* library, const std::string& name) {
  return ::dlsym(library, name.c_str());
}

}  // namespace quadrille
