/// Uses the display that there is, or starts an Xvfb of its own that ends with this process.

#include "mesher/io/x_display.hpp"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace quadrille {

namespace {

bool can_open(const char* name) {
  Display* display = ::XOpenDisplay(name);
  if (display == nullptr) return false;
  ::XCloseDisplay(display);
  return true;
}

/// Turns this process into Xvfb, which picks a free display and writes its number to the pipe when ready.
[[noreturn]] void become_server(int pipe_end, pid_t parent) {
  // Ctrl-C in the terminal must reach only the parent. The server must end when the parent does.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  ::signal(SIGPIPE, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (int standard = 0; standard < 3; ++standard) ::dup2(nowhere, standard);
  // The pipe end must be open in Xvfb under the number in its argument.
  constexpr int number = 3;
  if (pipe_end != number) ::dup2(pipe_end, number);
  ::fcntl(number, F_SETFD, 0);
  ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "640x480x24", "-nolisten", "tcp", "-noreset",
           static_cast<char*>(nullptr));
  ::_exit(127);
}

/// The digits from the pipe up to the end of the line; empty if they do not come in time.
std::string read_number(int pipe_end) {
  constexpr int patience_milliseconds = 10000;
  std::string digits;
  pollfd waited{pipe_end, POLLIN, 0};
  while (::poll(&waited, 1, patience_milliseconds) > 0) {
    char character = 0;
    if (::read(pipe_end, &character, 1) != 1) return {};
    if (character == '\n') return digits;
    digits += character;
  }
  return {};
}

}  // namespace

bool XDisplay::start_server() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return false;
  const pid_t parent = ::getpid();
  server_ = ::fork();
  if (server_ == 0) become_server(ends[1], parent);
  ::close(ends[1]);
  const std::string number = server_ > 0 ? read_number(ends[0]) : std::string();
  ::close(ends[0]);
  if (number.empty()) return false;
  const std::string name = ":" + number;
  ::setenv("DISPLAY", name.c_str(), 1);
  return can_open(name.c_str());
}

XDisplay::XDisplay() {
  if (const char* old = std::getenv("DISPLAY")) old_display_ = old;
  if (start_server()) return;
  if (old_display_) ::setenv("DISPLAY", old_display_->c_str(), 1);
  if (!old_display_ || !can_open(old_display_->c_str()))
    problem_ = "there is no display, and Xvfb (package xvfb) cannot be started";
}

XDisplay::~XDisplay() {
  if (old_display_)
    ::setenv("DISPLAY", old_display_->c_str(), 1);
  else
    ::unsetenv("DISPLAY");
  if (server_ <= 0) return;
  ::kill(server_, SIGTERM);
  ::waitpid(server_, nullptr, 0);
}

}  // namespace quadrille
