/// POSIX terminal output. docs/porting.md describes what replaces it on other systems.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "geometry/base/error.hpp"
#include "mesher/command/command.hpp"

namespace quadrille::command {

void write_to_stdout(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw failure("stdout", fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

bool stderr_is_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace quadrille::command
