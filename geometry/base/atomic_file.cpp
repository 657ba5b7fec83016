/// Writes to an unnamed file (O_TMPFILE), or one under a random name, that gets its name by linkat or rename.

#include "geometry/base/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// Names of the temporary files being written. Signal handlers read them: no locks, no allocation.
std::array<std::atomic<const char*>, 8> unfinished{};

/// Puts a name in the place of another; null = no name.
void replace_unfinished(const char* old_name, const char* name) {
  for (auto& entry : unfinished) {
    const char* expected = old_name;
    if (entry.compare_exchange_strong(expected, name)) return;
  }
}

Error cannot_write(const std::filesystem::path& target, int error_number) {
  const char* why = error_number == EFBIG ? "it would be larger than this process may write (ulimit -f)"
                                          : std::strerror(error_number);
  return failure(target.string(), fmt::format("{}: cannot be written: {}", target.string(), why));
}

std::string own_descriptor(int descriptor) {
  return fmt::format("/proc/self/fd/{}", descriptor);
}

}  // namespace

std::filesystem::path written_file(const std::filesystem::path& name) {
  constexpr int most_links = 40;  // the kernel's limit
  std::filesystem::path file = name;
  for (int links = 0; links < most_links; ++links) {
    std::error_code none;
    if (!std::filesystem::is_symlink(file, none)) return file;
    file = file.parent_path() / std::filesystem::read_symlink(file, none);
    if (none) throw cannot_write(name, none.value());
  }
  throw cannot_write(name, ELOOP);
}

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target), final_(written_file(target)) {
  struct stat status {};
  const bool exists = ::stat(final_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  in_place_ = exists && !S_ISREG(status.st_mode);
  if (in_place_) {
    descriptor_ = ::open(final_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  folder_ = final_.has_parent_path() ? final_.parent_path() : ".";
  if (!open_unnamed()) {
    with_random_name([&](const char* name) {
      descriptor_ = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      return descriptor_ >= 0;
    });
  }
  // An overwritten file keeps its permissions. Where that is refused, it gets the default ones. The right to
  // act as the file's owner was given to other contents.
  constexpr mode_t permissions = S_IRWXU | S_IRWXG | S_IRWXO;
  if (exists && ::fchmod(descriptor_, status.st_mode & permissions) != 0) errno = 0;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (folder_descriptor_ >= 0) ::close(folder_descriptor_);
  if (temporary_.empty()) return;
  replace_unfinished(temporary_.c_str(), nullptr);
  ::unlink(temporary_.c_str());
}

/// False where the file system has no unnamed files, or cannot give them a name later.
bool AtomicFile::open_unnamed() {
  descriptor_ = ::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return false;
  if (::access(own_descriptor(descriptor_).c_str(), F_OK) == 0) return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

template <class Attempt>
void AtomicFile::with_random_name(Attempt&& attempt) {
  // The name does not contain the target's name, which may already be as long as the file system allows. Nor
  // does it contain the process ID, which processes in other containers may share.
  constexpr int attempts = 100;
  std::random_device random;
  for (int i = 0; i < attempts; ++i) {
    std::filesystem::path name = folder_ / fmt::format(".quadrille-{:08x}{:08x}.tmp", std::uint32_t{random()},
                                                       std::uint32_t{random()});
    if (attempt(name.c_str())) {
      temporary_ = std::move(name);
      replace_unfinished(nullptr, temporary_.c_str());
      return;
    }
    if (errno != EEXIST) break;
  }
  fail(errno);
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (in_place_) return close();
  // The contents must reach the disk before the name: after a power failure the file would be empty.
  if (::fsync(descriptor_) != 0) fail(errno);
  folder_descriptor_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_descriptor_ < 0 && errno != EACCES) fail(errno);  // a folder may be writable but not readable
  put_in_place();
  // The name outlasts a power failure too. Some file systems cannot do this for folders (EINVAL).
  if (folder_descriptor_ >= 0 && ::fsync(folder_descriptor_) != 0 && errno != EINVAL) fail(errno);
}

void AtomicFile::put_in_place() {
  if (temporary_.empty()) {
    // Network file systems report a full disk only when a descriptor is closed.
    const int other = ::dup(descriptor_);
    if (other < 0 || ::close(other) != 0) fail(errno);
    const std::string source = own_descriptor(descriptor_);
    const auto link_to = [&](const char* name) {
      return ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    };
    if (link_to(final_.c_str())) return close();
    // Only a file with a name can replace the existing file.
    if (errno != EEXIST) fail(errno);
    with_random_name(link_to);
  }
  close();
  if (std::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  replace_unfinished(temporary_.c_str(), nullptr);
  temporary_.clear();
}

void AtomicFile::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail(errno);
}

void AtomicFile::fail(int error_number) const {
  throw cannot_write(target_, error_number);
}

void remove_unfinished_files() noexcept {
  for (auto& entry : unfinished) {
    if (const char* name = entry.exchange(nullptr)) ::unlink(name);
  }
}

void write_file(const std::filesystem::path& target, std::string_view bytes) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace quadrille
