#include "mesher/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// Names of the files being written, for signal handlers: no locks, no allocation.
std::array<std::atomic<const char*>, 8> unfinished{};

void note_unfinished(const char* name) {
  for (auto& entry : unfinished) {
    const char* none = nullptr;
    if (entry.compare_exchange_strong(none, name)) return;
  }
}

void forget_unfinished(const char* name) {
  for (auto& entry : unfinished) {
    const char* expected = name;
    if (entry.compare_exchange_strong(expected, nullptr)) return;
  }
}

std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  // Independent of the target's name, which may already be as long as the file system allows.
  static std::atomic<int> counter{0};
  return target.parent_path() / fmt::format(".quadrille-{}-{}.tmp", ::getpid(), counter++);
}

std::filesystem::path followed(const std::filesystem::path& target) {
  std::error_code ignored;
  if (!std::filesystem::is_symlink(target, ignored)) return target;
  std::filesystem::path end = std::filesystem::weakly_canonical(target, ignored);
  return ignored ? target : end;
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target), final_(followed(target)) {
  struct stat status {};
  const bool exists = ::stat(final_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(final_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  const std::filesystem::path temporary = temporary_beside(final_);
  descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  temporary_ = temporary;
  note_unfinished(temporary_.c_str());
  // An overwritten file keeps its permissions; where that is refused the usual ones do.
  if (exists && ::fchmod(descriptor_, status.st_mode & 07777) != 0) errno = 0;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (temporary_.empty()) return;
  forget_unfinished(temporary_.c_str());
  ::unlink(temporary_.c_str());
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
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Network file systems report a full disk only here.
  if (::close(descriptor) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  forget_unfinished(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(int error_number) const {
  throw failure(target_.string(),
                fmt::format("{}: cannot be written: {}", target_.string(), std::strerror(error_number)));
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
