/// Opens the file, or makes one in the folder: on Windows, permissions do not show it, since access lists
/// decide.

#include <windows.h>

#include <fmt/format.h>

#include "geometry/base/file_access.hpp"
#include "geometry/base/windows_text.hpp"

namespace quadrille {

namespace {

std::string problem_of(HANDLE opened) {
  if (opened == INVALID_HANDLE_VALUE) return windows_message(::GetLastError());
  ::CloseHandle(opened);
  return {};
}

}  // namespace

std::string why_unreadable(const std::filesystem::path& path) {
  // The flag lets folders be opened, too.
  return problem_of(::CreateFileW(path.c_str(), GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                  OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
}

std::string why_unwritable(const std::filesystem::path& folder) {
  const std::filesystem::path trial =
      folder / fmt::format(".quadrille-{}-{}.tmp", ::GetCurrentProcessId(), ::GetTickCount64());
  return problem_of(::CreateFileW(trial.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW,
                                  FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
}

}  // namespace quadrille
