#pragma once
/// Files that appear whole or not at all.

#include <filesystem>
#include <string_view>

namespace quadrille {

/// The file that writing to `name` changes: symbolic links are followed, including those whose target does
/// not exist yet. Throws Error (failure) when the links form a loop.
std::filesystem::path written_file(const std::filesystem::path& name);

/// A file that is written without a name in the target's folder and put in place by commit(). On file systems
/// that lack unnamed files it is written under a random name. Without commit() (because of an exception or a
/// kill) an older file of the same name stays as it was. Targets that are not regular files (a named pipe, a
/// device) are written in place.
class AtomicFile {
 public:
  /// Opens the file. Throws Error (failure) with one sentence when the folder does not allow it.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Throws Error (failure) when the disk is full, when the file exceeds the size limit of the
  /// process (where SIGXFSZ is ignored), or when the reader of the pipe has closed it.
  void write(std::string_view bytes);

  /// Makes the file appear under its name, once its contents are on the disk; the name is too at the end.
  /// Throws as write() does, also for what the disk reports only then.
  void commit();

 private:
  bool open_unnamed();
  /// Calls `attempt` with random names in the folder until one succeeds; the file then has that name.
  template <class Attempt>
  void with_random_name(Attempt&& attempt);
  void put_in_place();
  void close();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path target_;  // as the caller gave it, for messages
  std::filesystem::path final_;   // with symbolic links followed
  std::filesystem::path folder_;
  std::filesystem::path temporary_;  // name of the file until it is put in place; empty = unnamed
  bool in_place_ = false;
  int descriptor_ = -1, folder_descriptor_ = -1;
};

/// Removes the temporary files of all files not yet committed. Safe in a signal handler; for a process about
/// to end.
void remove_unfinished_files() noexcept;

/// Writes a whole file. Throws as AtomicFile does.
void write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace quadrille
