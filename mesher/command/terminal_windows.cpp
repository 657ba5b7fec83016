/// Output to the console or a pipe, as bytes of UTF-8. mesher/command/terminal.cpp does the same for POSIX.
#include <fmt/format.h>
#include <io.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "geometry/base/error.hpp"
#include "mesher/command/command.hpp"

namespace quadrille::command {

void write_to_stdout(std::string_view text) {
  constexpr std::size_t bytes_at_once = 1 << 14;  // consoles refuse more at once
  while (!text.empty()) {
    const unsigned count = static_cast<unsigned>(std::min(text.size(), bytes_at_once));
    const int written = ::_write(::_fileno(stdout), text.data(), count);
    if (written < 0)
      throw failure("stdout", fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

bool stderr_is_terminal() {
  return ::_isatty(::_fileno(stderr)) != 0;
}

}  // namespace quadrille::command
