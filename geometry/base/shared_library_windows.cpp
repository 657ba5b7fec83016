/// Finds the folder of this code by the handle of the program or library that it lies in, and opens
/// libraries by LoadLibraryEx.

#include <windows.h>

#include <cstdlib>

#include <fmt/format.h>

#include "geometry/base/error.hpp"
#include "geometry/base/module_loader.hpp"
#include "geometry/base/shared_library.hpp"
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

std::string library_name(const std::string& prefix) {
  return prefix + ".dll";
}

std::vector<std::filesystem::path> module_folders(const std::filesystem::path& own) {
  if (const wchar_t* named = ::_wgetenv(L"QUADRILLE_MODULES");
      named != nullptr && std::filesystem::path(named).is_absolute())
    return {named};
  return {own, own / "quadrille"};
}

void* open_library(const std::filesystem::path& file) {
  // What the module needs is looked for beside it and beside the program, never in the current folder.
  if (HMODULE library = ::LoadLibraryExW(file.c_str(), nullptr,
                                         LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_DEFAULT_DIRS))
    return library;
  throw failure(file.filename().string(),
                fmt::format("{} cannot be loaded: {}", file.string(), windows_message(::GetLastError())));
}

void* find_symbol(void* library, const std::string& name) {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name.c_str()));
}

}  // namespace quadrille
