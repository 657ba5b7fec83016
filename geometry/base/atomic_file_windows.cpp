/// Writes under a random name, in a file that the system deletes if this process is killed, and renames it
/// over the target, which Windows does in one step on NTFS.

#include <windows.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <string>

#include <fmt/format.h>

#include "geometry/base/atomic_file.hpp"
#include "geometry/base/error.hpp"
#include "geometry/base/windows_text.hpp"

namespace quadrille {

namespace {

/// Names of the temporary files being written.
std::array<std::atomic<const wchar_t*>, 8> unfinished{};

void note_unfinished(const wchar_t* name) {
  for (auto& entry : unfinished) {
    const wchar_t* none = nullptr;
    if (entry.compare_exchange_strong(none, name)) return;
  }
}

void forget_unfinished(const wchar_t* name) {
  for (auto& entry : unfinished) {
    const wchar_t* expected = name;
    if (entry.compare_exchange_strong(expected, nullptr)) return;
  }
}

Error cannot_write(const std::filesystem::path& target, DWORD number) {
  return failure(target.string(),
                 fmt::format("{}: cannot be written: {}", target.string(), windows_message(number)));
}

/// Whether the system deletes the file when its last handle is closed, thus also when this process is killed.
bool mark_for_deletion(HANDLE file, bool deleted) {
  FILE_DISPOSITION_INFO information{};
  information.DeleteFile = deleted ? TRUE : FALSE;
  return ::SetFileInformationByHandle(file, FileDispositionInfo, &information, sizeof information) != 0;
}

}  // namespace

std::filesystem::path written_file(const std::filesystem::path& name) {
  constexpr int most_links = 40;
  std::filesystem::path file = name;
  for (int links = 0; links < most_links; ++links) {
    std::error_code none;
    if (!std::filesystem::is_symlink(file, none)) return file;
    file = file.parent_path() / std::filesystem::read_symlink(file, none);
    if (none) throw cannot_write(name, static_cast<DWORD>(none.value()));
  }
  throw cannot_write(name, ERROR_CANT_RESOLVE_FILENAME);
}

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target), final_(written_file(target)) {
  const DWORD attributes = ::GetFileAttributesW(final_.c_str());
  const bool exists = attributes != INVALID_FILE_ATTRIBUTES;
  if (exists && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0)
    throw failure(target.string(), fmt::format("{}: cannot be written: it is a folder", target.string()));
  if (exists && (attributes & FILE_ATTRIBUTE_READONLY) != 0) fail(ERROR_ACCESS_DENIED);
  constexpr int attempts = 100;
  std::random_device random;
  const std::filesystem::path folder = final_.has_parent_path() ? final_.parent_path() : ".";
  for (int i = 0; i < attempts && file_ == nullptr; ++i) {
    temporary_ =
        folder / fmt::format(".quadrille-{:08x}{:08x}.tmp", std::uint32_t{random()}, std::uint32_t{random()});
    const HANDLE file = ::CreateFileW(temporary_.c_str(), GENERIC_WRITE | DELETE, 0, nullptr, CREATE_NEW,
                                      FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file != INVALID_HANDLE_VALUE) file_ = file;
    if (file_ == nullptr && ::GetLastError() != ERROR_FILE_EXISTS) break;
  }
  if (file_ == nullptr) fail(::GetLastError());
  mark_for_deletion(file_, true);
  note_unfinished(temporary_.c_str());
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) ::CloseHandle(file_);
  if (temporary_.empty()) return;
  forget_unfinished(temporary_.c_str());
  ::DeleteFileW(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  constexpr std::size_t bytes_at_once = std::size_t{1} << 30;
  while (!bytes.empty()) {
    DWORD written = 0;
    if (!::WriteFile(file_, bytes.data(), static_cast<DWORD>(std::min(bytes.size(), bytes_at_once)), &written,
                     nullptr))
      fail(::GetLastError());
    bytes.remove_prefix(written);
  }
}

void AtomicFile::commit() {
  if (!::FlushFileBuffers(file_)) fail(::GetLastError());
  if (!mark_for_deletion(file_, false)) fail(::GetLastError());
  close();
  if (!::MoveFileExW(temporary_.c_str(), final_.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
    fail(::GetLastError());
  forget_unfinished(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::close() {
  const HANDLE file = file_;
  file_ = nullptr;
  if (!::CloseHandle(file)) fail(::GetLastError());
}

void AtomicFile::fail(int error_number) const {
  throw cannot_write(target_, static_cast<DWORD>(error_number));
}

void remove_unfinished_files() noexcept {
  for (auto& entry : unfinished) {
    if (const wchar_t* name = entry.exchange(nullptr)) ::DeleteFileW(name);
  }
}

void write_file(const std::filesystem::path& target, std::string_view bytes) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace quadrille
