/// Asks faccessat(2), as the kernel will judge this process, about a file, or about the folder that a file is
/// to be written to.

#include "geometry/base/file_access.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace quadrille {

namespace {

std::string why_not(const std::filesystem::path& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0 ? std::string() : std::strerror(errno);
}

}  // namespace

std::string why_unreadable(const std::filesystem::path& path) {
  return why_not(path, R_OK);
}

std::string why_unwritable(const std::filesystem::path& folder) {
  return why_not(folder, W_OK | X_OK);
}

}  // namespace quadrille
