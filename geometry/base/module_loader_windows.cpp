/// Finds modules beside this code, by the handle of the program or library that it lies in, and opens them
/// after a check of their version.

#include <windows.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/base/module_loader.hpp"
#include "geometry/base/windows_text.hpp"

namespace quadrille {

std::filesystem::path own_folder() {
  static const char anchor = 0;
  HMODULE self = nullptr;
  if (!::GetModuleHandleExW(
          GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
          reinterpret_cast<const wchar_t*>(&anchor), &self))
    return {};
  std::wstring name(1 << 15, L'\0');  // the longest path that Windows has
  name.resize(::GetModuleFileNameW(self, name.data(), static_cast<DWORD>(name.size())));
  return std::filesystem::path(name).parent_path();
}

namespace {

/// The folders in which modules are searched for, in order.
std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own) {
  if (const wchar_t* named = ::_wgetenv(L"QUADRILLE_MODULES");
      named != nullptr && std::filesystem::path(named).is_absolute())
    return {named};
  return {own, own / "quadrille"};
}

void* open_library(const std::string& name) {
  const std::filesystem::path own = own_folder();
  std::vector<std::string> looked_in;
  for (const std::filesystem::path& folder : module_folders(own)) {
    const std::filesystem::path candidate = (folder / name).lexically_normal();
    looked_in.push_back(candidate.parent_path().string());
    std::error_code ignored;
    if (!std::filesystem::exists(candidate, ignored)) continue;
    // What the module needs is looked for beside it and beside the program, never in the current folder.
    if (HMODULE handle = ::LoadLibraryExW(
            candidate.c_str(), nullptr, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS))
      return handle;
    throw failure(
        name, fmt::format("{} cannot be loaded: {}", candidate.string(), windows_message(::GetLastError())));
  }
  throw failure(name, fmt::format("{}, which this format needs, is in none of the folders {}", name,
                                  fmt::join(looked_in, ", ")));
}

}  // namespace

Module::Module(const std::string& prefix) : prefix_(prefix), file_(prefix + ".dll") {
  handle_ = open_library(file_);
  // C++ types cross the interface, so both sides must be of the same version.
  if (std::string(function<ModuleVersionFunction>("_version")()) != QUADRILLE_VERSION) throw mismatch();
}

void* Module::symbol(const std::string& name) const {
  const FARPROC result = ::GetProcAddress(static_cast<HMODULE>(handle_), (prefix_ + name).c_str());
  if (result == nullptr) throw mismatch();
  return reinterpret_cast<void*>(result);
}

Error Module::mismatch() const {
  return failure(file_, fmt::format("{} has another version than Quadrille {}", file_, QUADRILLE_VERSION));
}

}  // namespace quadrille
