#include "geometry/base/module_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

namespace quadrille {

namespace {

/// The folder of the program or shared library that holds this code.
std::filesystem::path own_folder() {
  Dl_info info{};
  static const char anchor = 0;
  if (::dladdr(&anchor, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  // A program started by name alone has no path here; the kernel knows it.
  std::filesystem::path file(info.dli_fname);
  if (!file.is_absolute() && !std::filesystem::exists(file, ignored)) file = "/proc/self/exe";
  file = std::filesystem::canonical(file, ignored);
  return ignored ? std::filesystem::path() : file.parent_path();
}

void* open_library(const std::string& name) {
  const std::filesystem::path own = own_folder();
  // Beside the program, installed (bin/ and lib/), in the build folder (python/quadrille/ and tests/ lie
  // below).
  for (const char* place : {".", "../lib", "../lib/" QUADRILLE_MULTIARCH, "..", "../.."}) {
    const std::filesystem::path candidate = own / place / name;
    std::error_code ignored;
    if (!std::filesystem::exists(candidate, ignored)) continue;
    if (void* handle = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
    throw failure(name, fmt::format("{} cannot be loaded: {}", candidate.string(), ::dlerror()));
  }
  throw failure(
      name, fmt::format("{}, which this format needs, is neither in {} nor in the lib folder beside it", name,
                        own.string()));
}

}  // namespace

Module::Module(const std::string& prefix) : prefix_(prefix), file_("lib" + prefix + ".so") {
  handle_ = open_library(file_);
  // C++ types cross the border: both sides must come from one build.
  if (std::string(function<ModuleVersionFunction>("_version")()) != QUADRILLE_VERSION) throw mismatch();
}

void* Module::symbol(const std::string& name) const {
  void* result = ::dlsym(handle_, (prefix_ + name).c_str());
  if (result == nullptr) throw mismatch();
  return result;
}

Error Module::mismatch() const {
  return failure(file_, fmt::format("{} is of another version than Quadrille {}", file_, QUADRILLE_VERSION));
}

}  // namespace quadrille
