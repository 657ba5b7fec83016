#pragma once
/// Files that appear whole or not at all.

#include <filesystem>
#include <string_view>

namespace quadrille {

/// A file written under a temporary name in the target's folder and renamed by commit(). Without commit() (an
/// exception on the way) the temporary is removed and an older file of the same name stays as it was. Targets
/// that are not regular files (a named pipe, a device) are written in place.
class AtomicFile {
 public:
  /// Creates the temporary. Throws Error (failure) with one sentence when the folder does not allow it.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Throws Error (failure) when the disk is full or the pipe's reader has gone.
  void write(std::string_view bytes);

  /// Makes the file appear under its name.
  void commit();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path target_;     // as the caller named it, for messages
  std::filesystem::path final_;      // target_ with symbolic links followed
  std::filesystem::path temporary_;  // empty: written in place
  int descriptor_ = -1;
};

/// Removes the temporaries of all files not yet committed. Safe in a signal handler; for a process about to
/// end.
void remove_unfinished_files() noexcept;

/// Writes a whole file at once. Throws as AtomicFile does.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace quadrille
