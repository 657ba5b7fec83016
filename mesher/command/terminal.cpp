/// What the command tells: results on stdout, lines on stderr, and progress, which is drawn on a terminal.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "geometry/base/error.hpp"
#include "geometry/base/printable.hpp"
#include "mesher/command/command.hpp"

namespace quadrille::command {

void print(std::string_view text) {
  const std::string shown = printable(text, {}, '\n');
  for (std::string_view left = shown; !left.empty();) {
    const ssize_t written = ::write(STDOUT_FILENO, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      throw failure("stdout", fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    left.remove_prefix(static_cast<std::size_t>(written));
  }
}

void say_line(std::string_view line) {
  const std::string text = printable(line) + '\n';
  std::fwrite(text.data(), 1, text.size(), stderr);  // nobody can be told that this fails
}

ProgressDisplay::ProgressDisplay()
    : terminal_(::isatty(STDERR_FILENO) == 1), last_(std::chrono::steady_clock::now()) {}

ProgressDisplay::~ProgressDisplay() {
  if (drawn_ && terminal_) fmt::print(stderr, "\r\033[K");
}

bool ProgressDisplay::show(std::string_view stage, double fraction) {
  const auto interval = std::chrono::milliseconds(terminal_ ? 100 : 500);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < interval) return true;
  last_ = now;
  const int percent = static_cast<int>(100 * std::min(std::max(fraction, 0.0), 1.0));
  if (terminal_) {
    draw_bar(stage, percent);
    return true;
  }
  std::string text = fmt::format("progress: {} {} %\n", stage, percent);
  if (text == last_text_) return true;
  std::fputs(text.c_str(), stderr);
  last_text_ = std::move(text);
  return true;
}

void ProgressDisplay::draw_bar(std::string_view stage, int percent) {
  constexpr int width = 30;
  const int full = percent * width / 100;
  fmt::print(stderr, "\r\033[K{:<12} [{:#<{}}{:.<{}}] {:3} %", stage, "", full, "", width - full, percent);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace quadrille::command
