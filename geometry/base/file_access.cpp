/// Asks faccessat(2), as the kernel will judge this process, about a file, or about the folder that a file is
/// to be written to. Refuses inputs without end before memory is taken for them.

#include "geometry/base/file_access.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>

#include "geometry/base/error.hpp"
#include "geometry/base/process_usage.hpp"

namespace quadrille {

namespace {

std::string why_not(const std::filesystem::path& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0 ? std::string() : std::strerror(errno);
}

/// Why a path that the system lets this process read is no input; empty if it is one.
std::string why_no_input(const std::filesystem::path& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (std::filesystem::is_directory(status)) return "it is a folder, not a file";
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    return "it is a device, not a file";
  if (!std::filesystem::is_regular_file(status)) return {};  // a pipe, which ends with its writer
  // What is made of the bytes takes at least as much memory as they do.
  const double needed = 2 * static_cast<double>(std::filesystem::file_size(path, problem));
  const double free = free_memory();
  if (problem || !(needed > free)) return {};
  return fmt::format("it takes {:.3g} GB of memory, and {:.3g} GB are free", needed / 1e9, free / 1e9);
}

}  // namespace

void require_readable(const std::filesystem::path& path) {
  std::string why = why_not(path, R_OK);
  if (why.empty()) why = why_no_input(path);
  if (!why.empty()) throw failure(path.string(), fmt::format("{}: cannot be read: {}", path.string(), why));
}

std::string why_unwritable(const std::filesystem::path& folder) {
  return why_not(folder, W_OK | X_OK);
}

std::string lower_ending(const std::filesystem::path& path) {
  return boost::algorithm::to_lower_copy(path.extension().string());
}

}  // namespace quadrille
