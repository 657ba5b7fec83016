#pragma once
/// Files that appear whole or not at all.

#include <filesystem>
#include <string_view>

namespace quadrille {

/// The file that writing to a name changes: symbolic links followed, also those that lead to no file yet.
/// Throws Error (failure) when they lead nowhere, in a circle.
std::filesystem::path written_file(const std::filesystem::path& name);

/// A file written without a name in the target's folder, or under a random one where the file system lacks
/// unnamed files, and put in its place by commit(). Without commit() (an exception on the way, a kill) an
/// older file of the same name stays as it was. Targets that are not regular files (a named pipe, a device)
/// are written in place.
class AtomicFile {
 public:
  /// Opens the file. Throws Error (failure) with one sentence when the folder does not allow it.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Throws Error (failure) when the disk is full, the file too large for the limit of the
  /// process (where SIGXFSZ is ignored), or the pipe's reader has gone.
  void write(std::string_view bytes);

  /// Makes the file appear under its name.
  void commit();

 private:
  bool open_unnamed(const std::filesystem::path& folder);
  /// Calls `attempt` with random names in the folder until one was free; it then names the file.
  template <class Attempt>
  void with_random_name(const std::filesystem::path& folder, Attempt&& attempt);
  void close();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path target_;     // as the caller named it, for messages
  std::filesystem::path final_;      // the file that it means
  std::filesystem::path temporary_;  // name of the file until it is in its place; empty: none
  bool in_place_ = false;
  int descriptor_ = -1;
};

/// Removes the temporaries of all files not yet committed. Safe in a signal handler; for a process about to
/// end.
void remove_unfinished_files() noexcept;

/// Writes a whole file at once. Throws as AtomicFile does.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace quadrille
