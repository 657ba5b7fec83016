#pragma once
/// Files in memory, for readers that want a path.

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace quadrille::fuzz {

/// One file that holds the last input; its path ends as asked for.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& ending) : path_(folder() / ("input" + ending)) {}
  ~MemoryFile() { std::filesystem::remove_all(path_.parent_path()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void fill(const std::uint8_t* data, std::size_t size) {
    const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
    ::close(file);
  }

 private:
  static std::filesystem::path folder() {
    std::string name = "/dev/shm/quadrille-fuzz-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    return name;
  }

  std::filesystem::path path_;
};

}  // namespace quadrille::fuzz
